#include "core/time/velocity_verlet.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

/// Masses in a row between two walls, each with a spring of its own stiffness to the next; the
/// first is pushed with `push` cos(t).
struct Chain final : SecondOrderSystem {
  explicit Chain(std::size_t n, double mass = 1.0, double spring = 1.0)
      : masses(n, mass), springs(n + 1, spring) {}

  std::string_view name() const override { return "chain/position"; }
  std::span<const double> mass() const override { return masses; }
  void force(double t, std::span<const double> y, std::span<double> f) override {
    ++forces;
    stiffness_times(y, f);
    for (double& value : f) value = -value;
    f[0] += push * std::cos(t);
    if (t > poisoned_from) f[0] = std::nan("");
  }
  void stiffness_times(std::span<const double> v, std::span<double> product) override {
    ++products;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double left = i > 0 ? v[i - 1] : 0.0;
      const double right = i + 1 < v.size() ? v[i + 1] : 0.0;
      product[i] = springs[i] * (v[i] - left) + springs[i + 1] * (v[i] - right);
    }
  }
  std::uint64_t stiffness_version() const override { return version; }

  double elastic_energy(const std::vector<double>& y) {
    std::vector<double> f(y.size());
    stiffness_times(y, f);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += 0.5 * y[i] * f[i];
    return sum;
  }
  double energy(const Motion& motion) {
    return kinetic_energy(masses, motion.velocity) + elastic_energy(motion.position);
  }
  /// Of equal masses and springs.
  double highest_frequency() const {
    const double n = static_cast<double>(masses.size());
    return 2.0 * std::sqrt(springs[0] / masses[0]) *
           std::sin(0.5 * std::numbers::pi * n / (n + 1.0));
  }

  std::vector<double> masses, springs;
  double push = 0.0;
  double poisoned_from = 1e300;
  std::uint64_t version = 0;
  int forces = 0, products = 0;
};

/// One mass of frequency 1: two springs of 1/2.
Chain oscillator() { return Chain(1, 1.0, 0.5); }

Motion at(VelocityVerlet& verlet, std::vector<double> position, std::vector<double> velocity) {
  Motion motion{std::move(position), std::move(velocity), {}};
  verlet.evaluate(0.0, motion);
  return motion;
}

TEST(VelocityVerlet, IsOfSecondOrderWithAndWithoutDamping) {
  // y'' = cos t - y - c y' from rest: y = e^(-c t / 2) (a cos w t + b sin w t) + sin(t) / c.
  for (const double c : {1e-6, 0.4, 1.5}) {
    Chain system = oscillator();
    system.push = 1.0;
    const double end = 7.0, w = std::sqrt(1.0 - 0.25 * c * c);
    const double exact = std::sin(end) / c - std::exp(-0.5 * c * end) * std::sin(w * end) / (c * w);
    std::vector<double> errors;
    for (const double safety : {0.1, 0.05, 0.025}) {
      VelocityVerlet verlet(system, c, safety);
      Motion motion = at(verlet, {0.0}, {0.0});
      verlet.advance(0.0, end, motion);
      const double steps = static_cast<double>(verlet.steps());
      errors.push_back((motion.position[0] - exact) * steps * steps);
    }
    EXPECT_NEAR(errors[1] / errors[2], 1.0, 0.02) << c;
    EXPECT_NEAR(errors[0] / errors[2], 1.0, 0.08) << c;
  }
}

TEST(VelocityVerlet, KeepsItsEnergyOverAHundredThousandPeriods) {
  Chain system = oscillator();
  VelocityVerlet verlet(system, 0.0, 0.5);
  Motion motion = at(verlet, {1.0}, {0.0});
  const double period = 2.0 * std::numbers::pi;
  const double step = period / static_cast<double>(std::ceil(period / verlet.longest_step(0.0)));
  const auto shadow = [&] {
    return system.energy(motion) -
           step * step / 8.0 * motion.acceleration[0] * motion.acceleration[0];
  };
  const double kept = shadow();
  /// Largest deviation of the plain energy in the next `periods`, looked at once in each.
  const auto deviation = [&](int periods) {
    double largest = 0.0;
    for (int n = 0; n < periods; ++n) {
      verlet.advance(0.0, period, motion);
      largest = std::max(largest, std::abs(system.energy(motion) - 0.5));
    }
    return largest;
  };
  const double early = deviation(1000);
  deviation(98000);
  const double late = deviation(1000);
  EXPECT_LT(early, 0.5 * step * step);
  EXPECT_LT(late, 1.01 * early) << "the energy drifts";
  EXPECT_NEAR(shadow() / kept, 1.0, 1e-10);
}

TEST(VelocityVerlet, RunsBackToWhereItCameFrom) {
  Chain system(20);
  VelocityVerlet verlet(system);
  std::vector<double> start(20), speed(20);
  for (int i = 0; i < 20; ++i) {
    start[i] = std::sin(1.0 + i * i);
    speed[i] = std::cos(3.0 * i);
  }
  Motion motion = at(verlet, start, speed);
  verlet.advance(0.0, 50.0, motion);
  EXPECT_GT(std::abs(motion.position[3] - start[3]), 1e-2);
  for (double& v : motion.velocity) v = -v;
  verlet.advance(0.0, 50.0, motion);
  for (int i = 0; i < 20; ++i) {
    EXPECT_NEAR(motion.position[i], start[i], 1e-12);
    EXPECT_NEAR(motion.velocity[i], -speed[i], 1e-12);
  }
}

TEST(VelocityVerlet, FindsTheStableLimitOfAChainFromBelow) {
  for (const std::size_t n : {1, 3, 30, 100}) {
    Chain system(n, 3.0, 7.0);
    VelocityVerlet verlet(system);
    const double exact = 2.0 / system.highest_frequency();
    EXPECT_LE(verlet.stable_step(0.0), exact * (1.0 + 1e-12)) << n;
    EXPECT_GE(verlet.stable_step(0.0), 0.97 * exact) << n;
  }
}

TEST(VelocityVerlet, FindsTheLimitOncePerStiffness) {
  Chain system(20);
  VelocityVerlet verlet(system);
  const double limit = verlet.stable_step(0.0);
  const int products = system.products;
  verlet.stable_step(1.0);
  EXPECT_EQ(system.products, products);
  for (double& spring : system.springs) spring *= 4.0;
  ++system.version;
  EXPECT_DOUBLE_EQ(verlet.stable_step(1.0), 0.5 * limit);
}

/// However strong the damping: it takes nothing from the stable step, and gives nothing to it.
TEST(VelocityVerlet, StaysBoundedBelowTheLimitAndGrowsAboveItAtAnyDamping) {
  for (const double damping : {0.0, 1.0, 100.0}) {
    for (const double ratio : {0.99, 1.01}) {
      Chain system(30);
      VelocityVerlet verlet(system, damping, 3.0);
      const double step = ratio * 2.0 / system.highest_frequency();
      std::vector<double> start(30);
      for (int i = 0; i < 30; ++i) start[i] = i % 2 == 0 ? 1e-3 : -1e-3;
      Motion motion = at(verlet, start, std::vector<double>(30, 0.0));
      const int steps = ratio < 1.0 ? 3000 : 400;
      for (int n = 0; n < steps; ++n) verlet.advance(0.0, step, motion);
      EXPECT_EQ(verlet.steps(), steps);
      if (ratio < 1.0)
        EXPECT_LT(std::abs(motion.position[15]), 0.1) << damping;
      else
        EXPECT_GT(std::abs(motion.position[15]), 10.0) << damping;
    }
  }
}

TEST(VelocityVerlet, DampsAFreeMassExactlyAndBooksTheEnergy) {
  Chain system(1, 2.0, 0.0);
  VelocityVerlet verlet(system, 3.0);
  Motion motion = at(verlet, {0.0}, {5.0});
  verlet.advance(0.0, 0.7, motion);
  EXPECT_NEAR(motion.velocity[0], 5.0 * std::exp(-2.1), 1e-14);
  EXPECT_NEAR(motion.damped_energy, 25.0 * (1.0 - std::exp(-4.2)), 1e-13);
}

/// Kinetic - h^2/8 sum m a^2 + elastic + damped stays what it was to rounding, step by step
/// between the dampings; what is left is what these do to h^2/8 sum m a^2, of order h^2.
TEST(VelocityVerlet, EnergyOfADampedChainClosesWithTheSquareOfTheStep) {
  std::vector<double> errors;
  for (const double safety : {0.2, 0.1, 0.05}) {
    Chain system(10);
    VelocityVerlet verlet(system, 0.3, safety);
    Motion motion = at(verlet, {0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, std::vector<double>(10, 0.0));
    const double before = system.energy(motion);
    verlet.advance(0.0, 5.0, motion);
    EXPECT_GT(motion.damped_energy, 0.5 * before);
    const double steps = static_cast<double>(verlet.steps());
    errors.push_back((system.energy(motion) + motion.damped_energy - before) * steps * steps);
  }
  EXPECT_NEAR(errors[1] / errors[2], 1.0, 0.1);
  EXPECT_NEAR(errors[0] / errors[2], 1.0, 0.3);
}

TEST(VelocityVerlet, TakesTheFewestEqualStepsWithOneForceEach) {
  Chain system(5);
  VelocityVerlet verlet(system, 0.0, 0.8);
  Motion motion = at(verlet, std::vector<double>(5, 1.0), std::vector<double>(5, 0.0));
  const double longest = verlet.longest_step(0.0);
  EXPECT_DOUBLE_EQ(longest, 0.8 * verlet.stable_step(0.0));
  verlet.advance(1.0, 1.0 + 6.5 * longest, motion);
  EXPECT_EQ(verlet.steps(), 7);
  verlet.advance(1.0, 1.0 + longest, motion);
  EXPECT_EQ(verlet.steps(), 8) << "rounding made another step";
  EXPECT_EQ(system.forces, 9);
}

TEST(VelocityVerlet, NamesFieldEntryAndTimeOfANumberThatIsNotFinite) {
  Chain system(5);
  system.poisoned_from = 0.5;
  VelocityVerlet verlet(system);
  Motion motion = at(verlet, std::vector<double>(5, 1.0), std::vector<double>(5, 0.0));
  try {
    verlet.advance(0.0, 10.0, motion);
    FAIL() << "no exception";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.field(), "chain/position");
    EXPECT_EQ(error.time(), 10.0);
    EXPECT_THAT(error.what(), testing::HasSubstr("not finite"));
  }
}

}  // namespace
}  // namespace perifrac
