#include "modules/fluid/points/split_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"
#include "tests/port_named.hpp"
#include "tests/unit/fluid/fluid_run.hpp"

namespace perifrac {
namespace {

constexpr double water_dx = 0.1;

/// A lattice of `counts` points, of which one is heavy, between wall points.
template <int D>
struct Heavy {
  explicit Heavy(const std::array<int, D>& counts, const std::vector<Vector<D>>& wall = {})
      : neighbours(2.5 * water_dx, 0.25 * water_dx, {}) {
    const Points<D> lattice = box_lattice<D>(counts, water_dx);
    for (Index i = 0; i < lattice.size(); ++i) {
      points.add(lattice.at(i), velocity(i), 1000.0, 1000.0 * lattice.volume[i]);
    }
    std::array<std::vector<double>, D> cloud;
    for (const Vector<D>& x : wall) {
      for (int a = 0; a < D; ++a) cloud[a].push_back(x[a]);
    }
    neighbours.find(points, cloud, walls);
  }

  static Vector<D> velocity(Index i) {
    Vector<D> v;
    for (int a = 0; a < D; ++a) v[a] = std::sin(1.0 + i + 3.0 * a);
    return v;
  }

  Index nearest(const Vector<D>& x) const {
    Index best = 0;
    double least = 1e300;
    for (Index i = 0; i < points.count; ++i) {
      double square = 0.0;
      for (int a = 0; a < D; ++a) square += std::pow(points.position[a][i] - x[a], 2);
      if (square < least) least = square, best = i;
    }
    return best;
  }

  Index split(double most) { return split_points<D>(points, walls, neighbours, most); }

  /// Mass, momentum, moment of mass.
  std::array<double, 1 + 2 * D> totals() const {
    std::array<double, 1 + 2 * D> sum{};
    for (Index i = 0; i < points.count; ++i) {
      sum[0] += points.mass[i];
      for (int a = 0; a < D; ++a) {
        sum[1 + a] += points.mass[i] * points.velocity[a][i];
        sum[1 + D + a] += points.mass[i] * points.position[a][i];
      }
    }
    return sum;
  }

  FluidPoints<D> points;
  FluidNeighbours<D> neighbours;
  NearWalls<D> walls;
};

template <int D>
void expect_totals_kept() {
  std::array<int, D> counts;
  counts.fill(6);
  Heavy<D> fluid(counts);
  const double one = 1000.0 * std::pow(water_dx, D);
  for (Index i = 0; i < fluid.points.count; i += 3) fluid.points.mass[i] *= 1.7;
  const Index heavy = (fluid.points.count + 2) / 3;
  const auto before = fluid.totals();
  const Index count = fluid.points.count;
  EXPECT_EQ(fluid.split(1.5 * one), heavy);
  EXPECT_EQ(fluid.points.count, count + heavy);
  const auto after = fluid.totals();
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_NEAR(after[k], before[k], 1e-14 * before[0]) << k;
  }
  std::vector<std::int64_t> ids = fluid.points.id;
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
  EXPECT_EQ(ids.back(), count + heavy - 1);
  EXPECT_EQ(fluid.split(1.5 * one), 0);
}

TEST(SplitPoints, KeepsMassMomentumAndCentreIn2D) { expect_totals_kept<2>(); }
TEST(SplitPoints, KeepsMassMomentumAndCentreIn3D) { expect_totals_kept<3>(); }

TEST(SplitPoints, HalvesLieAsFarApartAsTheirSize) {
  Heavy<2> fluid({5, 5});
  const Index i = fluid.nearest({0.25, 0.25});
  fluid.points.mass[i] *= 1.6;
  ASSERT_EQ(fluid.split(15.0), 1);
  const Index j = fluid.points.count - 1;
  const double apart = std::hypot(fluid.points.position[0][i] - fluid.points.position[0][j],
                                  fluid.points.position[1][i] - fluid.points.position[1][j]);
  EXPECT_NEAR(apart, water_dx * std::sqrt(0.8), 1e-15);
}

/// In a gap one point wide the halves lie along it, whichever way it runs.
TEST(SplitPoints, GoesAlongAGap) {
  for (const int along : {0, 1}) {
    std::vector<Vector<2>> wall;
    for (int k = -3; k < 12; ++k) {
      for (const double across : {-0.5, 1.5}) {
        Vector<2> x;
        x[along] = (k + 0.5) * water_dx;
        x[1 - along] = across * water_dx;
        wall.push_back(x);
      }
    }
    std::array<int, 2> counts{1, 1};
    counts[along] = 9;
    Heavy<2> fluid(counts, wall);
    Vector<2> middle{0.05, 0.05};
    middle[along] = 0.45;
    fluid.points.mass[fluid.nearest(middle)] *= 2.0;
    ASSERT_EQ(fluid.split(15.0), 1);
    for (const double x : fluid.points.position[1 - along]) EXPECT_NEAR(x, 0.05, 1e-15);
  }
}

/// Where a neighbour is missing, there is the room.
TEST(SplitPoints, GoesWhereThereIsRoom) {
  Heavy<2> fluid({5, 3});
  // The middle row alone is left, and a diagonal of others.
  fluid.points.remove_if(
      [&](Index i) { return std::abs(fluid.points.position[1][i] - 0.15) > 0.01; });
  fluid.neighbours.find(fluid.points, {}, fluid.walls);
  const Index i = fluid.nearest({0.25, 0.15});
  fluid.points.mass[i] *= 2.0;
  ASSERT_EQ(fluid.split(15.0), 1);
  EXPECT_NEAR(fluid.points.position[0][i], 0.25, 1e-15);  // across the row
  EXPECT_NEAR(std::abs(fluid.points.position[1][i] - 0.15), 0.05, 1e-15);
}

/// Water that comes out of the rock swells the lowest row of a pool.
TEST(SplitPoints, HappensWhereWaterComesOutOfPores) {
  test::FluidRun run(R"(
dimension: 2
time: {end: 1 s}
body: {shape: box, size: [0.8 m, 0.4 m], spacing: 0.1 m}
pore_flow: {type: darcy, permeability: 1 D, porosity: 0.3, fluid: {bulk_modulus: 1 MPa, viscosity: 1 cP}}
interface: {slip: free}
fluid:
  type: semi_lagrangian
  bulk_modulus: 0.1 MPa
  viscosity: 100 Pa s
  container: {from: [0 m, 0 m], to: [0.8 m, 1 m], faces: {left: periodic, right: periodic, bottom: open, top: open}}
  blocks: [{name: pool, from: [0 m, 0.4 m], to: [0.8 m, 0.8 m]}]
)");
  const auto input = [&](const char* name) { return test::port_named(run.module(), name).value; };
  std::ranges::fill(input("pore_pressure"), 20e3);
  std::ranges::fill(input("pore_mobility"), 1e-5);
  const double before = run.value("free_fluid_mass");
  double given = 0.0;
  for (int window = 0; window < 200; ++window) {
    run.steps(1);
    for (const double mass : run.values("exchanged_mass")) given += mass;
  }
  EXPECT_GT(run.ids().size(), 36u);
  EXPECT_NEAR(run.value("free_fluid_mass") - before, -given, 1e-12 * before);
  for (const double mass : run.field("mass")) EXPECT_LE(mass, 15.0);
}

}  // namespace
}  // namespace perifrac
