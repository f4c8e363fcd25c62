#include "core/geometry/space_filling_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/operators/brute_force.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::cube;
using test::distance;

// The defining invariant of a Hilbert curve: a step along it is a step to a neighbouring cell.
template <int D>
void expect_unit_steps(int count) {
  const double spacing = 0.7;
  Points<D> points = box_lattice<D>(cube<D>(count), spacing);
  sort_along_curve(points, spacing);
  for (Index i = 1; i < points.size(); ++i) {
    ASSERT_NEAR(distance<D>(points.at(i - 1), points.at(i)), spacing, 1e-12) << "at point " << i;
  }
}

TEST(SpaceFillingCurve, StepsFromCellToNeighbouringCell) {
  expect_unit_steps<2>(16);
  expect_unit_steps<3>(8);
}

TEST(SpaceFillingCurve, KeepsEveryPointWithItsVolume) {
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> place(0.0, 10.0);
  Points<2> points;
  std::vector<std::array<double, 3>> before;
  for (int n = 0; n < 200; ++n) {
    const Vector<2> x = {place(bits), place(bits)};
    points.add(x, n);
    before.push_back({x[0], x[1], static_cast<double>(n)});
  }
  sort_along_curve<2>(points, 0.5);
  std::vector<std::array<double, 3>> after;
  for (Index i = 0; i < points.size(); ++i) {
    after.push_back({points.position[0][i], points.position[1][i], points.volume[i]});
  }
  EXPECT_NE(before, after);
  std::ranges::sort(before);
  std::ranges::sort(after);
  EXPECT_EQ(before, after);
}

TEST(SpaceFillingCurve, LeavesTiesInTheirOrder) {
  Points<2> points;
  for (int n = 0; n < 5; ++n) points.add({0.1 * n, 0.0}, n);  // all in one cell
  sort_along_curve<2>(points, 10.0);
  EXPECT_TRUE(std::ranges::is_sorted(points.volume));
}

}  // namespace
}  // namespace perifrac
