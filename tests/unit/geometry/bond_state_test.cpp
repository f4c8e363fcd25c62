#include "core/bonds/bond_state.hpp"

#include <gtest/gtest.h>

#include "core/state/snapshot.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using Bonds = std::vector<std::pair<Index, Index>>;

BondState<2> some_broken() {
  BondState<2> bonds;
  bonds.add_facet({{{1.0, 2.0}, {3.0, 2.0}}}, Bonds{{0, 4}, {1, 5}});
  bonds.break_bonds(Bonds{{2, 3}});
  return bonds;
}

TEST(BondState, KeepsFacetsWithWhatTheyCut) {
  const BondState<2> bonds = some_broken();
  ASSERT_EQ(bonds.broken().size(), 3u);
  EXPECT_EQ(bonds.broken()[1].j, 5);
  EXPECT_EQ(bonds.broken()[1].facet, 0);
  EXPECT_EQ(bonds.broken()[2].facet, no_facet);
  EXPECT_EQ(bonds.facet_points().count, 1u);
  EXPECT_EQ(bonds.facet_points().position[0][0], 2.0);
  EXPECT_EQ(bonds.facet_points().position[1][0], 2.0);
}

TEST(BondState, HasAnotherVersionAfterEveryBreakAndRestoredStateOnly) {
  BondState<2> bonds;
  Snapshot nothing, some;
  const StateWalk walk = [&](StateVisitor& visitor) { bonds.visit_state(visitor); };
  nothing.save(walk);
  const auto start = bonds.version();
  bonds = some_broken();
  const auto broken = bonds.version();
  EXPECT_NE(broken, start);
  some.save(walk);
  some.restore(walk);
  EXPECT_EQ(bonds.version(), broken) << "the same state";
  nothing.restore(walk);
  EXPECT_NE(bonds.version(), broken);
  EXPECT_TRUE(bonds.broken().empty());
  EXPECT_EQ(bonds.facet_points().count, 0u);
  some.restore(walk);
  EXPECT_EQ(bonds.broken()[2].i, 2);
  EXPECT_EQ(bonds.facets()[0][1][0], 3.0);
  EXPECT_EQ(bonds.facet_points().count, 1u);
}

/// A bond to a ghost breaks with that to the ghost's source, from both ends; nothing else does.
TEST(BondState, BreaksBondsInAFamilyAndToItsGhosts) {
  const auto body = test::box_body<2>({8, 8}, 1.0);
  const Family<2> family = *body->family(face_bit(0) | face_bit(2));
  const Bonds broken = {{0, 1}, {9, 18}};
  Family<2> silenced = family;
  for (const auto& [i, j] : broken) silence(silenced, i, j);
  std::vector<double> damage(family.point_count);
  find_damage<2>(silenced, damage);
  Index ghosts = 0;
  for (Index i = 0; i < family.point_count; ++i) {
    double whole = 0.0, lost = 0.0;
    const PointBonds bonds = family.bonds(i);
    for (Index k = 0; k < bonds.count(); ++k) {
      const Index end = bonds.other(k);
      const bool ghost = end >= family.point_count;
      const Index j = ghost ? family.ghost_source[end - family.point_count] : end;
      const bool is_broken =
          std::ranges::count(broken, std::pair(std::min(i, j), std::max(i, j))) > 0;
      ghosts += is_broken && ghost;
      EXPECT_EQ(silenced.weight(i, k), is_broken ? 0.0 : bonds.weight(k));
      whole += family.volume[end];
      if (is_broken) lost += family.volume[end];
    }
    EXPECT_DOUBLE_EQ(damage[i], lost / whole);
  }
  EXPECT_GT(ghosts, 0);
}

TEST(BondState, KeepsEveryEndOfBondsOnceAndInOrder) {
  std::vector<Index> points = {7, 2, 7, 3, 2, 7};
  keep_each_once(points);
  EXPECT_EQ(points, (std::vector<Index>{2, 3, 7}));
}

}  // namespace
}  // namespace perifrac
