#include "modules/solid/fracture/critical_stretch.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <omp.h>

#include "core/solvers/symmetric_spectrum.hpp"
#include "tests/unit/fracture/breaking_solid.hpp"

namespace perifrac {
namespace {

using test::Breakable;
using test::Breaking;

/// A bar held at both ends in uniform strain: bonds along it are stretched by just that.
std::size_t broken_at(double strain, double limit) {
  const double length = 10.0;
  Breaking<2> bar({20, 6});
  bar.limit = limit;
  bar.boundary.roller(0, 0.0);
  bar.boundary.roller(1, strain * length);
  bar.boundary.roller(2, 0.0);
  bar.boundary.roller(3, 0.0);
  bar.start();
  bar.deflect([=](double x) { return strain * x; });
  bar.advance(0.5 * bar.module->stable_time_step());
  return bar.broken();
}

TEST(CriticalStretch, ABarBreaksAtTheStrainOfTheLimit) {
  EXPECT_EQ(broken_at(0.999e-3, 1e-3), 0u);
  EXPECT_EQ(broken_at(1.001e-3, 1e-3),
            6u * (19u + 18u));  // every bond along it, of 1 or 2 spacings
  EXPECT_EQ(broken_at(-1e-2, 1e-3), 0u);
}

/// Held at the left and torn at the right: what is done on it is in motion, strain and broken
/// bonds.
void expect_balance_of_energy(test::Rock rock, double largest, double at_half_the_step) {
  std::vector<double> errors;
  for (const double safety : {0.4, 0.2}) {
    Breaking<2> bar({30, 8});
    bar.rock = rock;
    bar.safety = safety;
    bar.limit = 0.01;
    bar.boundary.roller(0, 0.0);
    bar.boundary.roller(1, 0.0, 0.02);
    bar.start();
    std::size_t before = 0;
    for (int n = 0; n < 40; ++n) {
      bar.advance(1.0);
      ASSERT_GE(bar.broken(), before);
      before = bar.broken();
    }
    EXPECT_GT(before, 20u);
    EXPECT_GT(bar.value("fracture_energy"), 0.0);
    errors.push_back(std::abs(bar.energy_error()) / bar.value("external_work"));
  }
  EXPECT_LT(errors[0], largest);
  EXPECT_LT(errors[1], at_half_the_step);
}

TEST(CriticalStretch, ClosesTheEnergyBalanceAndHealsNoBond) {
  expect_balance_of_energy(test::Rock::linear_exact, 1.1e-3, 7e-4);
}

TEST(CriticalStretch, ClosesTheEnergyBalanceInLpsToo) {
  expect_balance_of_energy(test::Rock::lps, 0.01, 2e-3);
}

TEST(CriticalStretch, ABodyThatFliesApartKeepsItsMomentum) {
  Breaking<3> body({8, 6, 6});
  body.limit = 0.01;
  body.start();
  body.deflect([](double x) { return 0.1 * std::sin(1.3 * x); });
  body.advance(3.0);
  EXPECT_GT(body.broken(), 100u);
  const auto v = body.port("velocity").value;
  const Index n = body.body->points().size();
  for (int a = 0; a < 3; ++a) {
    double momentum = 0.0, size = 0.0;
    for (Index i = 0; i < n; ++i) {
      momentum += body.body->points().volume[i] * v[a * n + i];
      size += body.body->points().volume[i] * std::abs(v[a * n + i]);
    }
    EXPECT_NEAR(momentum, 0.0, 1e-12 * size) << a;
  }
}

/// A plate torn at its right, far enough for cracks: displacements after all that.
Breaking<2> torn_plate(const std::array<int, 2>& counts) {
  Breaking<2> plate(counts);
  plate.limit = 0.01;
  plate.boundary.fixed(0, {0.0, 0.0});
  plate.boundary.traction(1, {0.4, 0.2}, Schedule::ramp(0.3));
  plate.seeds = {{{{1.0, 1.6}, {2.1, 1.6}}}};
  plate.start();
  return plate;
}

TEST(CriticalStretch, HasTheSameBitsAtAnyNumberOfThreads) {
  std::vector<std::vector<double>> found;
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    Breaking<2> plate = torn_plate({100, 90});
    plate.advance(1.0);
    EXPECT_GT(plate.broken(), 100u);
    found.push_back(plate.field("displacement"));
  }
  omp_set_num_threads(omp_get_num_procs());
  EXPECT_EQ(found[0], found[1]);
}

TEST(CriticalStretch, GoesOnFromARestoredStateToTheSameBits) {
  Breaking<2> whole = torn_plate({20, 12}), restarted = torn_plate({20, 12});
  const auto visit = [](Breaking<2>& plate) {
    return [&](StateVisitor& visitor) { plate.module->visit_state(visitor); };
  };
  whole.advance(2.0);
  Snapshot middle;
  middle.save(visit(whole));
  const std::size_t broken = whole.broken();
  whole.advance(2.0);
  EXPECT_GT(broken, 10u);
  EXPECT_GT(whole.broken(), broken);
  middle.restore(visit(restarted));
  restarted.time = 2.0;
  restarted.module->on_restored(2.0);
  restarted.advance(2.0);
  EXPECT_EQ(restarted.field("displacement"), whole.field("displacement"));
  EXPECT_EQ(restarted.value("fracture_energy"), whole.value("fracture_energy"));

  // A step back within one process.
  middle.restore(visit(whole));
  whole.module->on_restored(2.0);
  whole.time = 2.0;
  EXPECT_EQ(whole.broken(), broken);
  whole.advance(2.0);
  EXPECT_EQ(whole.field("displacement"), restarted.field("displacement"));
}

TEST(CriticalStretch, ABodyPressedFromAllSidesNeverBreaks) {
  Breaking<2> body({12, 12});
  body.damping = 1.0;
  for (int face = 0; face < 4; ++face) body.boundary.roller(face, -0.1, 0.0, Schedule::ramp(20.0));
  body.start();
  body.advance(40.0);
  EXPECT_EQ(body.broken(), 0u);
  EXPECT_EQ(test::largest(body.port("damage").value), 0.0);
  EXPECT_LT(body.port("dilatation").value[70], -10.0 * body.limit);
}

TEST(CriticalStretch, ASeedCrackPartsWhatItCuts) {
  Breaking<2> body({12, 6});
  body.limit = INFINITY;
  body.seeds = {{{{3.0, -1.0}, {3.0, 4.0}}}};
  body.boundary.traction(1, {0.1, 0.0});
  body.start();
  body.advance(5.0);
  const auto u = body.port("displacement").value;
  for (Index i = 0; i < body.body->points().size(); ++i) {
    if (body.body->points().position[0][i] < 3.0) {
      EXPECT_EQ(u[i], 0.0);
    } else {
      EXPECT_GT(u[i], 0.0);
    }
  }
  EXPECT_EQ(body.value("fracture_energy"), 0.0);
}

double largest_eigenvalue(const Eigen::SparseMatrix<double>& a) {
  return symmetric_spectrum(Eigen::MatrixXd(a)).values.maxCoeff();
}

/// However bonds break, the stable step that the solid takes is stable; and what breaking sets free
/// is the difference of two energies of the whole body.
void expect_bound_of_stiffness(test::Rock rock) {
  for (const double limit : {0.0, 0.3, 0.45, 0.8}) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
      const auto body = test::box_body<2>({11, 10}, 0.5);
      const SolidBoundary<2> boundary(*body);
      const Breakable<2> parts(*body, boundary, {test::lambda, test::mu}, rock);
      CriticalStretch<2> breaking(parts.family, parts.elastic, body->claim_bond_state(), {}, limit);
      breaking.cut_seeds();
      const double before = largest_eigenvalue(parts.elastic->assemble());
      const std::vector<double> u = test::random_values(parts.elastic->size(), seed);
      std::vector<double> force(u.size()), theta(body->points().size());
      const auto energy = [&] {
        parts.elastic->apply(u, {}, force, theta);
        return 0.5 * test::as_eigen(u).dot(test::as_eigen(force));
      };
      const double whole = energy();
      ASSERT_TRUE(breaking.breaks(u));
      EXPECT_NEAR(breaking.released_energy(), whole - energy(), 1e-12 * whole);
      EXPECT_FALSE(breaking.breaks(u));
      EXPECT_LE(largest_eigenvalue(parts.elastic->assemble()), before * breaking.stiffness_growth())
          << limit << ' ' << seed;
    }
  }
}

TEST(CriticalStretch, BoundsTheStiffnessOfWhatIsLeft) {
  expect_bound_of_stiffness(test::Rock::linear_exact);
}

TEST(CriticalStretch, BoundsTheStiffnessOfLpsToo) { expect_bound_of_stiffness(test::Rock::lps); }

}  // namespace
}  // namespace perifrac
