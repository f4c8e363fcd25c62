#include "modules/fluid/points/merge_points.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

constexpr double lattice_dx = 0.5;

/// Points at random about a lattice, of random masses, velocities and densities.
template <int D>
FluidPoints<D> random_points(int across) {
  std::array<int, D> counts;
  counts.fill(across);
  const Points<D> lattice = box_lattice<D>(counts, lattice_dx);
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  FluidPoints<D> points;
  for (Index i = 0; i < lattice.size(); ++i) {
    Vector<D> x = lattice.at(i), v;
    for (int a = 0; a < D; ++a) {
      x[a] += 0.2 * lattice_dx * value(bits);
      v[a] = value(bits);
    }
    points.add(x, v, 1000.0 + value(bits), 1.01 + value(bits));
  }
  return points;
}

template <int D>
struct Totals {
  double mass = 0.0, volume = 0.0;
  Vector<D> moment{}, momentum{};

  explicit Totals(const FluidPoints<D>& points) {
    for (Index i = 0; i < points.count; ++i) {
      mass += points.mass[i];
      volume += points.mass[i] / points.density[i];
      for (int a = 0; a < D; ++a) {
        moment[a] += points.mass[i] * points.position[a][i];
        momentum[a] += points.mass[i] * points.velocity[a][i];
      }
    }
  }
};

/// Within `horizon`; returns how many points are gone.
template <int D>
Index merge(FluidPoints<D>& points, double horizon, double least, Period<D> period = {}) {
  FluidNeighbours<D> neighbours(horizon, 0.0, std::move(period));
  NearWalls<D> none;
  neighbours.find(points, {}, none);
  points.volume.resize(points.count);
  for (Index i = 0; i < points.count; ++i) points.volume[i] = points.mass[i] / points.density[i];
  const Index gone = merge_points(points, neighbours, GaussianInfluence(horizon), least);
  EXPECT_EQ(points.remove_if([&](Index i) { return points.mass[i] == 0.0; }), gone);
  return gone;
}

template <int D>
void expect_all_kept(int across, Index fewest) {
  FluidPoints<D> points = random_points<D>(across);
  const Totals<D> before(points);
  Index gone = 0;
  for (double least = 0.05; least < 4.0; least *= 1.3)
    gone += merge(points, 2.5 * lattice_dx, least);
  EXPECT_GE(gone, fewest);
  const Totals<D> after(points);
  EXPECT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
  EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
  for (int a = 0; a < D; ++a) {
    EXPECT_NEAR(after.moment[a], before.moment[a], 1e-12 * before.moment[a]);
    EXPECT_NEAR(after.momentum[a], before.momentum[a], 1e-12 * before.mass);
  }
  for (const double mass : points.mass) EXPECT_GE(mass, 0.0);
}

TEST(MergePoints, KeepsMassVolumeMomentumAndCentre) {
  expect_all_kept<2>(24, 300);
  expect_all_kept<3>(8, 300);
}

TEST(MergePoints, SharesInProportionToInfluenceTimesVolume) {
  FluidPoints<2> points;
  points.add({0.0, 0.0}, {3.0, 0.0}, 1000.0, 0.1);
  points.add({1.0, 0.0}, {}, 1000.0, 2.0);
  points.add({0.0, -1.5}, {}, 500.0, 4.0);
  points.add({9.0, 9.0}, {}, 1000.0, 1.0);
  ASSERT_EQ(merge(points, 2.5, 0.2), 1);
  const double near = std::exp(-1.0) * 2.0 / 1000.0, far = std::exp(-2.25) * 4.0 / 500.0;
  const auto with_id = [&](std::int64_t id) {
    return static_cast<Index>(std::ranges::find(points.id, id) - points.id.begin());
  };
  ASSERT_EQ(points.count, 3);
  const Index first = with_id(1), second = with_id(2);
  const double share = 0.1 * near / (near + far);
  EXPECT_DOUBLE_EQ(points.mass[first], 2.0 + share);
  EXPECT_DOUBLE_EQ(points.mass[second], 4.0 + 0.1 - share);
  EXPECT_DOUBLE_EQ(points.position[0][first], 2.0 / (2.0 + share));
  EXPECT_NEAR(points.velocity[0][first], 3.0 * share / (2.0 + share), 1e-15);
  EXPECT_DOUBLE_EQ(points.mass[with_id(3)], 1.0);
}

TEST(MergePoints, KeepsTheCentreAcrossAPeriod) {
  FluidPoints<2> points;
  points.add({0.2, 0.0}, {1.0, 0.0}, 1000.0, 0.1);
  points.add({9.9, 0.0}, {}, 1000.0, 1.0);
  Period<2> period;
  period.ends[0] = {0.0, 10.0};
  ASSERT_EQ(merge(points, 2.5, 0.2, period), 1);
  EXPECT_NEAR(points.position[0][0], (9.9 + 0.1 * 10.2) / 1.1, 1e-14 * 10.0);
  EXPECT_DOUBLE_EQ(points.velocity[0][0], 0.1 / 1.1);
}

TEST(MergePoints, LeavesAPointThatIsAlone) {
  FluidPoints<2> points;
  points.add({0.0, 0.0}, {}, 1000.0, 0.1);
  points.add({5.0, 0.0}, {}, 1000.0, 1.0);
  EXPECT_EQ(merge(points, 2.5, 0.2), 0);
  EXPECT_EQ(points.count, 2);
}

TEST(MergePoints, LeavesTheLastOfManySmallOnes) {
  FluidPoints<2> points;
  for (int k = 0; k < 5; ++k) points.add({0.3 * k, 0.0}, {}, 1000.0, 0.02);
  merge(points, 2.5, 0.2);
  ASSERT_EQ(points.count, 1);
  EXPECT_DOUBLE_EQ(points.mass[0], 0.1);
  EXPECT_NEAR(points.position[0][0], 0.6, 1e-15);
}

}  // namespace
}  // namespace perifrac
