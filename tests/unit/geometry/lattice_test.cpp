#include "core/geometry/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

template <int D>
void expect_box(const std::array<int, D>& counts, double spacing) {
  const Points<D> points = box_lattice<D>(counts, spacing);
  double size = 1.0;
  std::size_t count = 1;
  for (const int n : counts) {
    size *= n * spacing;
    count *= n;
  }
  ASSERT_EQ(points.volume.size(), count);
  EXPECT_NEAR(std::accumulate(points.volume.begin(), points.volume.end(), 0.0), size, 1e-13 * size);
  std::set<std::array<long, D>> cells;
  for (Index i = 0; i < points.size(); ++i) {
    std::array<long, D> cell;
    for (int a = 0; a < D; ++a) {
      const double place = points.position[a][i] / spacing - 0.5;
      cell[a] = std::lround(place);
      EXPECT_NEAR(place, cell[a], 1e-12);
    }
    cells.insert(cell);
  }
  EXPECT_EQ(cells.size(), count) << "a cell is taken twice";
  for (int a = 0; a < D; ++a) {
    const auto [low, high] = std::ranges::minmax_element(points.position[a]);
    EXPECT_NEAR(*low, 0.5 * spacing, 1e-13) << "face half a spacing outside";
    EXPECT_NEAR(*high, (counts[a] - 0.5) * spacing, 1e-12);
  }
}

TEST(BoxLattice, FillsTheBoxWithFacesHalfASpacingOutside) {
  expect_box<2>({7, 12}, 0.3);
  expect_box<3>({3, 5, 4}, 0.25);
}

/// Row by row along the first axis, so that points of a row have neighbours that are as far on.
template <int D>
void expect_rows(const Points<D>& points) {
  for (Index i = 1; i < points.size(); ++i) {
    int last = D - 1;
    while (last > 0 && points.position[last][i] == points.position[last][i - 1]) --last;
    ASSERT_GT(points.position[last][i], points.position[last][i - 1]) << "point " << i;
  }
}

TEST(Lattice, GoesRowByRow) {
  expect_rows<2>(box_lattice<2>({7, 5}, 0.5));
  expect_rows<3>(box_lattice<3>({4, 5, 3}, 0.5));
  expect_rows<2>(ball_lattice<2>(4.0, 0.5));
  expect_rows<3>(ball_lattice<3>(3.0, 0.5));
  expect_rows<3>(ball_lattice<3>(3.0, 0.5, true));
}

template <int D>
void expect_ball(double radius, double spacing, double volume) {
  const Points<D> points = ball_lattice<D>(radius, spacing);
  EXPECT_NEAR(std::accumulate(points.volume.begin(), points.volume.end(), 0.0), volume,
              1e-12 * volume);
  EXPECT_NEAR(points.size() * std::pow(spacing, D), volume, 0.05 * volume) << "count";
  for (int a = 0; a < D; ++a) {
    EXPECT_NEAR(std::accumulate(points.position[a].begin(), points.position[a].end(), 0.0), 0.0,
                1e-9)
        << "centred";
  }
  for (Index i = 0; i < points.size(); ++i) {
    double r2 = 0.0;
    for (const double x : points.at(i)) r2 += x * x;
    EXPECT_LT(r2, radius * radius);
  }
}

/// The second moment of the volumes: that of a ball, to the accuracy of the sampled surface.
template <int D>
double moment_error(double cells) {
  const Points<D> points = ball_lattice<D>(1.0, 1.0 / cells);
  double sum = 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    for (const double x : points.at(i))
      sum += points.volume[i] * (x * x + 1.0 / (12 * cells * cells));
  }
  const double exact = D == 2 ? std::numbers::pi / 2.0 : 0.8 * std::numbers::pi;
  return std::abs(sum / exact - 1.0);
}

TEST(BallLattice, FollowsTheSurfaceWithItsVolumes) {
  for (const double cells : {8.0, 12.0, 16.0, 24.0}) {
    EXPECT_LT(moment_error<2>(cells), 0.5 / (cells * cells));
    EXPECT_LT(moment_error<3>(cells), 0.5 / (cells * cells));
  }
}

TEST(BallLattice, IsTheSameInEveryOctant) {
  const Points<3> whole = ball_lattice<3>(1.0, 0.13), octant = ball_lattice<3>(1.0, 0.13, true);
  std::map<Vector<3>, double> volume;
  for (Index i = 0; i < octant.size(); ++i) volume[octant.at(i)] = octant.volume[i];
  ASSERT_EQ(whole.size(), 8 * octant.size());
  for (Index i = 0; i < whole.size(); ++i) {
    Vector<3> x = whole.at(i);
    for (double& component : x) component = std::abs(component);
    EXPECT_EQ(whole.volume[i], volume.at(x));
    std::swap(x[0], x[2]);
    EXPECT_NEAR(whole.volume[i], volume.at(x), 1e-12 * whole.volume[i]);
  }
}

TEST(BallLattice, HoldsTheBallsVolumeAboutTheOrigin) {
  expect_ball<2>(1.0, 0.07, std::numbers::pi);
  expect_ball<3>(2.0, 0.21, 4.0 / 3.0 * std::numbers::pi * 8.0);
}

}  // namespace
}  // namespace perifrac
