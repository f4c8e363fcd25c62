#include "core/geometry/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

template <int D>
using Coordinates = std::array<std::vector<double>, D>;

template <int D>
Coordinates<D> random_points(Index count, double size, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> place(-0.3 * size, 0.7 * size);
  Coordinates<D> x;
  for (Index i = 0; i < count; ++i) {
    for (int a = 0; a < D; ++a) x[a].push_back(place(bits));
  }
  return x;
}

std::vector<Index> neighbours_of(const Neighbours& found, Index i) {
  return {found.other.begin() + found.offset[i], found.other.begin() + found.offset[i + 1]};
}

template <int D>
double distance(const Coordinates<D>& x, Index i, const Coordinates<D>& y, Index j) {
  double r2 = 0.0;
  for (int a = 0; a < D; ++a) r2 += std::pow(x[a][i] - y[a][j], 2);
  return std::sqrt(r2);
}

/// Both searches against a look at every pair.
template <int D>
void expect_all_pairs(const Coordinates<D>& points, const Coordinates<D>& targets, double cell,
                      double reach) {
  const auto count = static_cast<Index>(points[0].size());
  CellGrid<D> grid;
  grid.build(positions_of(points), cell);
  Neighbours near, others;
  grid.find(positions_of(targets), reach, near);
  grid.find_others(count, reach, others);
  ASSERT_EQ(near.target_count(), static_cast<Index>(targets[0].size()));
  ASSERT_EQ(others.target_count(), count);
  for (Index i = 0; i < near.target_count(); ++i) {
    std::vector<Index> expected;
    for (Index j = 0; j < count; ++j) {
      if (distance<D>(targets, i, points, j) < reach) expected.push_back(j);
    }
    ASSERT_THAT(neighbours_of(near, i), ElementsAreArray(expected)) << "of target " << i;
  }
  for (Index i = 0; i < count; ++i) {
    std::vector<Index> expected;
    for (Index j = 0; j < count; ++j) {
      if (j != i && distance<D>(points, i, points, j) < reach) expected.push_back(j);
    }
    ASSERT_THAT(neighbours_of(others, i), ElementsAreArray(expected)) << "of point " << i;
  }
}

TEST(CellGrid, FindsTheNeighboursThatAllPairsGive) {
  expect_all_pairs<2>(random_points<2>(700, 10.0, 1), random_points<2>(200, 12.0, 2), 1.0, 1.0);
  expect_all_pairs<2>(random_points<2>(300, 10.0, 3), random_points<2>(200, 30.0, 4), 1.7, 1.1);
  expect_all_pairs<3>(random_points<3>(700, 5.0, 5), random_points<3>(200, 6.0, 6), 1.0, 1.0);
}

// Fewer cells than the box of the points would take: cells are shared by points far apart.
TEST(CellGrid, FindsThemWhereCellsWrapAround) {
  expect_all_pairs<2>(random_points<2>(200, 100.0, 7), random_points<2>(100, 150.0, 8), 3.0, 3.0);
  expect_all_pairs<3>(random_points<3>(300, 30.0, 9), random_points<3>(100, 50.0, 10), 3.0, 3.0);
  expect_all_pairs<2>(random_points<2>(2, 1e-3, 11), random_points<2>(50, 20.0, 12), 1.0, 1.0);
}

// Distances that equal the reach are left out; rounding must not decide on those just below it.
TEST(CellGrid, HoldsOnALatticeOfTheCellsEdge) {
  const Points<2> lattice = box_lattice<2>({9, 8}, 0.1);
  expect_all_pairs<2>(lattice.position, lattice.position, 0.1 * (1.0 + 1e-12), 0.1 * (1.0 + 1e-12));
  expect_all_pairs<2>(lattice.position, lattice.position, 0.2, 0.2);
}

TEST(CellGrid, FindsCoincidentPoints) {
  const Coordinates<2> x = {{{0.5, 0.5, 0.5, 3.0}, {0.25, 0.25, 0.25, 0.0}}};
  CellGrid<2> grid;
  grid.build(positions_of(x), 1.0);
  Neighbours found;
  grid.find_others(4, 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0, 2, 4, 6, 6));
  EXPECT_THAT(found.other, ElementsAre(1, 2, 0, 2, 0, 1));
}

TEST(CellGrid, GivesTheFirstTargetsAlone) {
  const Coordinates<2> x = {{{0.0, 2.0, 0.5, 1.5}, {0.0, 0.0, 0.0, 0.0}}};
  CellGrid<2> grid;
  grid.build(positions_of(x), 1.0);
  Neighbours found;
  grid.find_others(2, 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0, 1, 2));
  EXPECT_THAT(found.other, ElementsAre(2, 3));
}

TEST(CellGrid, TakesEmptySets) {
  CellGrid<3> grid;
  Neighbours found;
  grid.build({}, 1.0);
  EXPECT_TRUE(grid.order().empty());
  grid.find_others(0, 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0));
  const auto targets = random_points<3>(2, 1.0, 1);
  grid.find(positions_of(targets), 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0, 0, 0));
  EXPECT_TRUE(found.other.empty());
  grid.build(positions_of(targets), 1.0);
  grid.find({}, 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0));
}

// Far points must neither cost memory nor part neighbours, theirs included.
TEST(CellGrid, KeepsNeighboursWhenAPointFlewFarAway) {
  for (const double far : {1e6, -1e9, 1e17, 1e300}) {
    auto x = random_points<2>(150, 6.0, 13);
    for (const double shift : {0.0, 0.25}) {
      x[0].push_back(far + shift);
      x[1].push_back(-2.0 * far);
    }
    expect_all_pairs<2>(x, random_points<2>(20, 6.0, 14), 1.0, 1.0);
  }
}

TEST(CellGrid, IgnoresPointsThatAreNotFinite) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Coordinates<2> x = {{{0.0, nan, 0.1, inf, -inf, inf}, {0.0, 0.0, 0.1, 0.0, nan, 0.0}}};
  CellGrid<2> grid;
  grid.build(positions_of(x), 1.0);
  Neighbours found;
  grid.find_others(6, 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0, 1, 1, 2, 2, 2, 2));
  EXPECT_THAT(found.other, ElementsAre(2, 0));
  grid.find(positions_of(x), 1.0, found);
  EXPECT_THAT(found.offset, ElementsAre(0, 2, 2, 4, 4, 4, 4));
  const Coordinates<2> none = {{{nan, inf}, {nan, nan}}};
  grid.build(positions_of(none), 1.0);
  grid.find_others(2, 1.0, found);
  EXPECT_TRUE(found.other.empty());
}

TEST(CellGrid, OrdersEveryPointOnceByRowsOfCells) {
  const auto x = random_points<3>(2000, 8.0, 15);
  CellGrid<3> grid;
  grid.build(positions_of(x), 1.0);
  std::vector<Index> order(grid.order().begin(), grid.order().end());
  const auto cell = [&](Index i) {
    return std::array{std::floor(x[2][i]), std::floor(x[1][i]), std::floor(x[0][i])};
  };
  EXPECT_TRUE(std::ranges::is_sorted(order, {}, cell));
  std::ranges::sort(order);
  std::vector<Index> every(2000);
  std::iota(every.begin(), every.end(), 0);
  EXPECT_EQ(order, every);
}

TEST(CellGrid, DoesNotDependOnTheNumberOfThreads) {
  const auto x = random_points<2>(5000, 30.0, 16);
  std::array<Neighbours, 3> found;
  const int threads = omp_get_max_threads();
  for (int t = 0; t < 3; ++t) {
    omp_set_num_threads(t + 1);
    CellGrid<2> grid;
    grid.build(positions_of(x), 1.0);
    grid.find_others(4000, 1.0, found[t]);
  }
  omp_set_num_threads(threads);
  for (int t = 1; t < 3; ++t) {
    EXPECT_EQ(found[t].offset, found[0].offset);
    EXPECT_EQ(found[t].other, found[0].other);
  }
}

TEST(CellGrid, AllocatesNothingWhenRepeated) {
  const auto x = random_points<2>(1000, 10.0, 17);
  CellGrid<2> grid;
  grid.build(positions_of(x), 1.0);
  Neighbours found;
  grid.find_others(1000, 1.0, found);
  const Index *const offset = found.offset.data(), *const other = found.other.data(),
                     *const order = grid.order().data();
  grid.build(positions_of(x), 1.0);
  grid.find_others(1000, 1.0, found);
  EXPECT_EQ(found.offset.data(), offset);
  EXPECT_EQ(found.other.data(), other);
  EXPECT_EQ(grid.order().data(), order);
}

}  // namespace
}  // namespace perifrac
