#include "core/bonds/crack_cut.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/bonds/bond_lengths.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

/// A plane across the whole body, point by point: cut are the bonds whose ends lie on two sides.
TEST(CrackCut, ALongFacetCutsWhatLiesOnTwoSides) {
  const auto body = test::box_body<2>({10, 10}, 1.0, test::Cloud::jittered);
  const auto family = body->family(0);
  const CrackFacet<2> facet = {{{-20.0, -12.0}, {30.0, 24.0}}};
  const auto side = [&](Index i) {
    const Vector<2> x = body->points().at(i);
    return 36.0 * (x[0] + 20.0) - 50.0 * (x[1] + 12.0) < 0.0;
  };
  std::vector<std::pair<Index, Index>> expected;
  for (Index i = 0; i < family->point_count; ++i) {
    for (const auto& bond : family->bonds(i)) {
      const Index j = bond.other;
      if (i < j && side(i) != side(j)) expected.emplace_back(i, j);
    }
  }
  EXPECT_GT(expected.size(), 30u);
  EXPECT_EQ(bonds_cut_by<2>(facet, *family, INFINITY), expected);
  EXPECT_EQ(bonds_cut_by<2>(facet, *family, bond_lengths(*family).longest), expected);
}

/// Pieces cut together what the whole cuts, although bonds pass through where they join; each
/// passes over what is cut already.
TEST(CrackCut, PiecesCutWhatTheWholeCuts) {
  const auto body = test::box_body<2>({10, 10}, 1.0);
  Family<2> family = *body->family(0);
  const auto whole = bonds_cut_by<2>({{{2.0, 5.0}, {6.0, 5.0}}}, family, INFINITY);
  std::vector<std::pair<Index, Index>> pieces;
  for (double x = 2.0; x < 6.0; x += 0.5) {  // ends where rows of bonds pass through
    for (const auto& [i, j] : bonds_cut_by<2>({{{x, 5.0}, {x + 0.5, 5.0}}}, family, INFINITY)) {
      pieces.emplace_back(i, j);
      silence(family, i, j);
    }
  }
  std::ranges::sort(pieces);
  EXPECT_EQ(pieces, whole);
  EXPECT_TRUE(bonds_cut_by<2>({{{2.0, 5.0}, {6.0, 5.0}}}, family, INFINITY).empty());
}

/// The four bonds of a 2 x 2 neighbourhood: those that end on the facet's edge count as cut, those
/// beyond it do not.
TEST(CrackCut, CountsABondThroughTheEndAsCut) {
  const auto body = test::box_body<2>({6, 6}, 1.0, test::Cloud::lattice, 1.1);
  const auto family = body->family(0);
  EXPECT_EQ(bonds_cut_by<2>({{{1.5, 3.0}, {3.5, 3.0}}}, *family, INFINITY).size(), 3u);
  EXPECT_EQ(bonds_cut_by<2>({{{1.6, 3.0}, {3.4, 3.0}}}, *family, INFINITY).size(), 1u);
}

/// A point in the facet's plane lies on the side of its normal, so that one row is parted from the
/// next and not both of its sides from it.
TEST(CrackCut, PutsAPointInThePlaneOnOneSide) {
  const auto body = test::box_body<2>({6, 6}, 1.0, test::Cloud::lattice, 1.1);
  const auto cut = bonds_cut_by<2>({{{-1.0, 2.5}, {7.0, 2.5}}}, *body->family(0), INFINITY);
  EXPECT_EQ(cut.size(), 6u);
  for (const auto& [i, j] : cut) EXPECT_EQ(body->points().at(i)[1] + body->points().at(j)[1], 4.0);
}

/// A square parts a body of 4^3 points along itself, wherever it is begun and whichever way round.
TEST(CrackCut, ASquareCutsTheRowsItSpans) {
  const auto body = test::box_body<3>({4, 4, 4}, 1.0, test::Cloud::lattice, 1.1);
  const Vector<3> a = {1.0, 1.0, 2.0}, b = {3.0, 1.0, 2.0}, c = {3.0, 3.0, 2.0},
                  d = {1.0, 3.0, 2.0};
  for (const CrackFacet<3>& facet : {CrackFacet<3>{a, b, c, d}, CrackFacet<3>{c, b, a, d}}) {
    const auto cut = bonds_cut_by<3>(facet, *body->family(0), INFINITY);
    EXPECT_EQ(cut.size(), 4u);
    for (const auto& [i, j] : cut) {
      EXPECT_EQ(body->points().at(i)[2] + body->points().at(j)[2], 4.0);
    }
  }
}

}  // namespace
}  // namespace perifrac
