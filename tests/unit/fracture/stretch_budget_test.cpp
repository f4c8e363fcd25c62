#include "modules/solid/fracture/stretch_budget.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/fracture/breaking_solid.hpp"

namespace perifrac {
namespace {

/// Length of a bond less what it is allowed, at most over a block's bonds [m].
template <int D>
double least_left(const Family<D>& family, const StretchBudget<D>& budget, Index block,
                  const std::vector<double>& u, double limit) {
  double least = INFINITY;
  for (const Index i : budget.points(block)) {
    for (Index k = 0; k < budget.real_bonds(i); ++k) {
      const Index j = family.bonds(i).other(k);
      double before = 0.0, after = 0.0;
      for (int a = 0; a < D; ++a) {
        const double xi = family.position[a][j] - family.position[a][i];
        const std::size_t axis = static_cast<std::size_t>(a) * family.point_count;
        before += xi * xi;
        after += std::pow(xi + u[axis + j] - u[axis + i], 2);
      }
      least = std::min(least, (1.0 + limit) * std::sqrt(before) - std::sqrt(after));
    }
  }
  return least;
}

/// Waves of many lengths, down to that of a bond, and a drift, the larger `size`, the more.
template <int D>
struct Waves {
  std::mt19937 random{7};
  std::vector<std::array<double, D + 2>> modes;

  Waves() {
    std::normal_distribution<double> normal;
    for (int n = 0; n < 12; ++n) {
      std::array<double, D + 2> mode;
      for (double& value : mode) value = normal(random);
      modes.push_back(mode);
    }
  }
  std::vector<double> at(const Family<D>& family, double t, double size) const {
    std::vector<double> u(static_cast<std::size_t>(D) * family.point_count);
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Index i = static_cast<Index>(k % family.point_count);
      u[k] = 3.0 * t;
      for (std::size_t n = 0; n < modes.size(); ++n) {
        double phase = modes[n][D] * t + static_cast<double>(k / family.point_count);
        for (int a = 0; a < D; ++a) phase += 4.0 * modes[n][a] * family.position[a][i];
        u[k] += size * modes[n][D + 1] * std::sin(phase);
      }
    }
    return u;
  }
};

/// Nothing is left alone that is beyond the limit, and most of what is not is: of all blocks no
/// more than `most` are looked at.
template <int D>
void misses_nothing(std::array<Index, D> points, double most) {
  test::Breaking<D> solid(points);
  const Family<D> family = *solid.body->family(0);
  StretchBudget<D> budget(family);
  const double limit = 0.05;
  const Waves<D> waves;
  std::size_t beyond = 0, due_in_all = 0, blocks_in_all = 0;
  for (int step = 0; step < 400; ++step) {
    const std::vector<double> u = waves.at(family, 0.004 * step, 1.2e-3 * (1.0 + 0.005 * step));
    const std::span<const Index> due = budget.due(u);
    const Index blocks = (family.point_count + budget.block_size - 1) / budget.block_size;
    blocks_in_all += blocks;
    due_in_all += due.size();
    for (Index block = 0; block < blocks; ++block) {
      const double left = least_left(family, budget, block, u, limit);
      const bool is_due = std::ranges::binary_search(due, block);
      if (is_due) budget.set_left(block, left);
      if (left > 0.0) continue;
      ++beyond;
      ASSERT_TRUE(is_due) << "block " << block << " in step " << step;
    }
  }
  EXPECT_GT(beyond, 20u);
  EXPECT_LT(static_cast<double>(due_in_all), most * static_cast<double>(blocks_in_all));
}

TEST(StretchBudget, MissesNothingAndLeavesQuietPlacesAlone) {
  misses_nothing<2>({60, 30}, 0.5);
  misses_nothing<3>({16, 10, 10}, 0.9);  // a neighbourhood is half of it
}

TEST(StretchBudget, LooksOnlyWhereSomethingMoves) {
  test::Breaking<2> solid({100, 20});
  const Family<2> family = *solid.body->family(0);
  StretchBudget<2> budget(family);
  std::vector<double> u(2 * family.point_count, 0.0);
  const std::size_t all = budget.due(u).size();
  for (std::size_t block = 0; block < all; ++block) budget.set_left(block, 1e-3);
  EXPECT_TRUE(budget.due(u).empty());
  std::ranges::fill(u, 5.0);  // as a rigid body, farther than any bond may part
  EXPECT_TRUE(budget.due(u).empty());
  u[0] += 2e-3;
  const std::size_t few = budget.due(u).size();
  EXPECT_GE(few, 1u);
  EXPECT_LE(few, all / 5);
  budget.forget();
  EXPECT_EQ(budget.due(u).size(), all);
}

TEST(StretchBudget, TrustsNoRoundingFarAway) {
  test::Breaking<2> solid({20, 10});
  const Family<2> family = *solid.body->family(0);
  StretchBudget<2> budget(family);
  std::vector<double> u(2 * family.point_count, 1e9);
  const std::size_t all = budget.due(u).size();
  for (std::size_t block = 0; block < all; ++block) budget.set_left(block, 1.0);
  EXPECT_EQ(budget.due(u).size(), all);
}

}  // namespace
}  // namespace perifrac
