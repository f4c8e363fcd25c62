#include "modules/solid/dynamic_fracture.hpp"

#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/unit/fracture/breaking_solid.hpp"
#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

/// A dynamic solid with a crack, whose fluid a test is.
struct Cracking : Moving<2> {
  std::vector<CrackFacet<2>> seeds;
  double fracture_energy = std::numeric_limits<double>::infinity();
  std::optional<InitialStress<2>> initial_stress{};

  Cracking(const std::array<int, 2>& counts, std::vector<CrackFacet<2>> crack)
      : Moving<2>(counts, 1.0), seeds(std::move(crack)) {}

  void start() {
    const Breakable<2> parts(*body, boundary, law);
    module = std::make_unique<DynamicFracture>(body, parts.family, parts.elastic, boundary, density,
                                               damping, safety, initial_stress, seeds,
                                               FractureEnergy<2>{{fracture_energy}});
    module->initialize(0.0);
  }
  double step() const { return module->stable_time_step(); }
  Eigen::Map<Eigen::VectorXd> vector(std::span<double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
  }
  Eigen::VectorXd opening() { return vector(port("crack_opening").value); }
  Eigen::VectorXd forecast() { return vector(port("free_crack_opening").forecast); }
  Eigen::MatrixXd slope() {
    const PortView out = port("free_crack_opening");
    const auto count = static_cast<Eigen::Index>(out.value.size());
    return Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(out.slope.data(), count,
                                                                      count);
  }
  void press(const Eigen::VectorXd& pressure) {
    vector(port("crack_pressure").value) = pressure;
    const TimeWindow window{time, time + step()};
    module->prepare(window);
    module->advance(window);
    module->conclude(window);
    time = window.end;
  }
  double plane_strain_modulus() const { return 4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu); }
};

TEST(DynamicFracture, ForetellsTheOpeningAfterAStep) {
  Cracking solid({24, 20}, straight_crack({12.0, 10.0}, 0.3, 8));
  solid.damping = 0.2;
  solid.start();
  for (int n = 0; n < 40; ++n) {
    const Eigen::VectorXd pressure =
        Eigen::VectorXd::LinSpaced(8, 0.1 * n, 1.0) * (1.5 + std::sin(0.3 * n));
    solid.module->prepare({solid.time, solid.time + solid.step()});
    const Eigen::VectorXd told = solid.forecast() + solid.slope() * pressure;
    solid.press(pressure);
    EXPECT_LE((solid.opening() - told).cwiseAbs().maxCoeff(), 1e-13 + 1e-12 * largest(told)) << n;
  }
  EXPECT_GT(largest(solid.opening()), 0.1);
}

/// A fluid that gives way to nothing: whatever keeps the openings as they are is bounded and
/// smooth, from the suddenly loaded body on.
TEST(DynamicFracture, IsStableAroundAnIncompressibleFluid) {
  Cracking solid({24, 20}, straight_crack({12.0, 10.0}, 0.0, 8));
  solid.boundary.traction(3, {0.0, -1.0}, Schedule::ramp(60.0));
  solid.boundary.fixed(2, {});
  solid.start();
  Eigen::VectorXd before = Eigen::VectorXd::Zero(8);
  double largest_pressure = 0.0, largest_change = 0.0;
  for (int n = 0; n < 3000; ++n) {
    solid.module->prepare({solid.time, solid.time + solid.step()});
    const Eigen::VectorXd pressure = solid.slope().partialPivLu().solve(-solid.forecast());
    solid.press(pressure);
    largest_pressure = std::max(largest_pressure, largest(pressure));
    largest_change = std::max(largest_change, largest(Eigen::VectorXd(pressure - before)));
    before = pressure;
  }
  EXPECT_LE(largest(solid.opening()), 1e-11);
  EXPECT_LE(largest_pressure, 2.6);
  EXPECT_LE(largest_change, 0.045);
  EXPECT_LE(std::abs(solid.energy_error()), 9e-5 * solid.value("external_work"));
}

TEST(DynamicFracture, RestsClosedUnderItsInitialStressUntilFluidExceedsIt) {
  for (const double angle : {0.0, 0.3}) {
    Cracking solid({24, 20}, straight_crack({12.0, 10.0}, angle, 8));
    solid.initial_stress = InitialStress<2>{{-0.2, -0.2}};
    solid.start();
    for (int n = 0; n < 50; ++n) solid.press(Eigen::VectorXd::Constant(8, 0.004 * n));
    EXPECT_LE(largest(solid.field("displacement")), 1e-13) << angle;
    for (int n = 0; n < 50; ++n) solid.press(Eigen::VectorXd::Constant(8, 0.4));
    EXPECT_GT(solid.opening().minCoeff(), 0.1) << angle;
  }
}

/// Faces that are pressed together do not pass through one another, and rebound.
TEST(DynamicFracture, KeepsClosedFacesApart) {
  Cracking solid({20, 24}, straight_crack({10.0, 12.0}, 0.0, 20));
  solid.boundary.traction(3, {0.0, -0.1}, Schedule::ramp(60.0));
  solid.boundary.fixed(2, {});
  solid.start();
  double most = 0.0;
  for (int n = 0; n < 900; ++n) {
    solid.press(Eigen::VectorXd::Zero(20));
    most = std::max(most, -solid.opening().minCoeff());
  }
  EXPECT_LE(most, 1e-12);
  // What faces under a pressure p give way within a step, p slope p / 4, is beyond the balance.
  const double within_step = 0.25 * 0.1 * 0.1 * solid.slope().sum();
  EXPECT_LE(std::abs(solid.energy_error()), 0.01 * solid.value("external_work") + within_step);
}

/// Where pores swell a free body evenly no total stress comes of it: the crack goes on at the
/// pressure of one in dry rock, whatever its effective stress is.
TEST(DynamicFracture, GrowsAtThePressureOfDryRockUnderAnEvenPoreStress) {
  const auto pressure_at_growth = [](double pore_stress) {
    Cracking solid({32, 32}, straight_crack({16.0, 16.0}, 0.0, 8));
    solid.fracture_energy = 1.0;
    solid.damping = 0.3;
    solid.start();
    double pressure = 0.0;
    for (int n = 0; solid.value("crack_length") < 8.5 && n < 4000; ++n) {
      if (pore_stress != 0.0) {
        std::ranges::fill(solid.port("pore_stress").value, pore_stress * std::min(1.0, n / 400.0));
      }
      pressure = n < 600 ? 0.0 : 5e-4 * (n - 600);
      solid.press(Eigen::VectorXd::Constant(8, pressure));
    }
    return pressure;
  };
  const double dry = pressure_at_growth(0.0);
  ASSERT_GT(dry, 0.0);
  for (const double pore_stress : {0.4, -0.4}) {
    EXPECT_NEAR(pressure_at_growth(pore_stress), dry, 0.017 * dry) << pore_stress;
  }
}

/// Freund (1990), section 2.5: faces of a semi-infinite crack under a sudden uniform pressure,
///   K_I = 2 p / (1 - nu) sqrt(c_d t (1 - 2 nu) / pi)
/// until waves come back. The crack goes on when that has reached the toughness.
TEST(DynamicFracture, BeginsToGrowWhenTheStepResponseSays) {
  const int half = 50;
  std::vector<CrackFacet<2>> crack;
  for (int k = 0; k < half; ++k) {
    crack.push_back({{{1.0 * k, 1.0 * half}, {k + 1.0, 1.0 * half}}});
  }
  const double nu = lambda / (2.0 * (lambda + mu));
  for (const double travelled : {20.0, 30.0, 40.0}) {
    Cracking solid({2 * half, 2 * half}, crack);
    const double toughness = 2.0 / (1.0 - nu) * std::sqrt(travelled * (1.0 - 2.0 * nu) / M_PI);
    solid.fracture_energy = toughness * toughness / solid.plane_strain_modulus();
    solid.start();
    while (solid.value("crack_length") < half + 0.5 && solid.time * speed < 2.0 * travelled) {
      solid.press(Eigen::VectorXd::Ones(half));
    }
    EXPECT_NEAR(solid.time * speed, travelled, 0.026 * travelled);
  }
}

/// What fluid and loads do on the body is what it holds and what growth took. Where new facets stay
/// dry that is the mean of J over the growth: 0.87 Gc here, for it falls by a quarter over a facet.
TEST(DynamicFracture, KeepsItsEnergyWhileItGrows) {
  const int wet = 12;
  Cracking solid({60, 60}, straight_crack({30.0, 30.0}, 0.0, wet));
  solid.fracture_energy = 4.0;
  solid.damping = 0.02;
  solid.start();
  double work = 0.0, energy_at_16 = 0.0;
  while (solid.value("crack_length") < 21.5 && solid.time * speed < 4000.0) {
    const Eigen::VectorXd before = solid.opening();
    Eigen::VectorXd pressure = Eigen::VectorXd::Zero(before.size());
    pressure.head(wet).setConstant(2e-3 * solid.time * speed);
    if (before.size() < 16) energy_at_16 = solid.value("fracture_energy");
    solid.press(pressure);
    work += pressure.dot(solid.opening().head(before.size()) - before);
  }
  EXPECT_EQ(solid.value("crack_length"), 22.0);
  EXPECT_LE(std::abs(solid.energy_error() + solid.value("fracture_energy") - work), 2.2e-3 * work);
  EXPECT_NEAR(solid.value("fracture_energy") - energy_at_16, 0.87 * 4.0 * 6.0, 0.072 * 4.0 * 6.0);
}

}  // namespace
}  // namespace perifrac::test
