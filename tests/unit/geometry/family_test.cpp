#include "core/bonds/family.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/operators/brute_force.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

double omega(InfluenceFunction function, double r, double horizon) {
  if (function == InfluenceFunction::constant) return 1.0;
  if (function == InfluenceFunction::inverse) return horizon / r;
  return std::exp(-std::pow(r / (0.4 * horizon), 2));
}

/// A bond by what it joins: source of the other end, faces that it is mirrored at.
using Bond = std::tuple<Index, FaceSet>;

template <int D>
void expect_all_bonds(const Points<D>& points, const std::vector<Face>& faces, double horizon,
                      FaceSet mirrored, InfluenceFunction influence) {
  const Family<D> family = build_family<D>(points, faces, mirrored, horizon, influence);
  const auto nodes = test::all_images<D>(points, faces, mirrored);
  ASSERT_EQ(family.point_count, points.size());
  for (Index i = 0; i < points.size(); ++i) {
    std::vector<std::pair<Bond, const test::Node<D>*>> expected;
    for (const auto& node : nodes) {
      const double r = test::distance<D>(points.at(i), node.x);
      if ((node.faces == 0 && node.source == i) || r > horizon * (1.0 + 1e-9)) continue;
      expected.push_back({{node.source, node.faces}, &node});
    }
    std::ranges::sort(expected);
    std::vector<std::pair<Bond, Index>> found;
    const PointBonds bonds = family.bonds(i);
    for (Index b = 0; b < bonds.count(); ++b) {
      const Index j = bonds.other(b);
      const Index ghost = j - points.size();
      found.push_back(
          {ghost < 0 ? Bond(j, 0u) : Bond(family.ghost_source[ghost], family.ghost_faces[ghost]),
           b});
    }
    std::ranges::sort(found);
    ASSERT_EQ(found.size(), expected.size()) << "point " << i;
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].first, expected[k].first) << "point " << i;
      const auto& node = *expected[k].second;
      const Index b = found[k].second;
      const double r = test::distance<D>(points.at(i), node.x);
      EXPECT_NEAR(bonds.weight(b), omega(influence, r, horizon) * node.volume, 1e-12 * node.volume);
      for (int a = 0; a < D; ++a) {
        EXPECT_NEAR(family.position[a][bonds.other(b)], node.x[a], 1e-12);
      }
    }
    EXPECT_TRUE(std::ranges::is_sorted(family.steps[i]));
  }
}

template <int D>
void expect_all_bonds(const std::array<int, D>& counts, double spacing, double horizon,
                      FaceSet mirrored, Cloud cloud, InfluenceFunction influence) {
  expect_all_bonds<D>(test::box_points<D>(counts, spacing, cloud),
                      test::box_faces<D>(counts, spacing), horizon, mirrored, influence);
}

TEST(Family, HoldsExactlyTheBondsWithinTheHorizon) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_all_bonds<2>({9, 7}, 0.1, 0.25, 0, cloud, InfluenceFunction::gaussian);
    expect_all_bonds<3>({5, 4, 6}, 0.1, 0.3, 0, cloud, InfluenceFunction::inverse);
  }
}

TEST(Family, MirrorsPointsAtFacesEdgesAndCorners) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_all_bonds<2>({9, 7}, 0.1, 0.25, 0b1111, cloud, InfluenceFunction::constant);
    expect_all_bonds<2>({3, 3}, 0.1, 0.3, 0b1111, cloud, InfluenceFunction::gaussian);
    expect_all_bonds<2>({9, 7}, 0.1, 0.25, 0b0101, cloud, InfluenceFunction::gaussian);
    expect_all_bonds<3>({4, 3, 4}, 0.1, 0.25, 0b111111, cloud, InfluenceFunction::gaussian);
    expect_all_bonds<3>({4, 3, 4}, 0.1, 0.25, 0b100110, cloud, InfluenceFunction::gaussian);
  }
}

// Behind a sphere, and behind a sphere and planes, every image is there once.
TEST(Family, MirrorsPointsAtASphere) {
  const auto gaussian = InfluenceFunction::gaussian;
  for (const FaceSet mirrored : {0b100u, 0b101u, 0b111u}) {
    expect_all_bonds<2>(ball_lattice<2>(0.8, 0.1, true), ball_faces<2>(0.8, true), 0.25, mirrored,
                        gaussian);
  }
  for (const FaceSet mirrored : {0b1000u, 0b1100u, 0b1111u}) {
    expect_all_bonds<3>(ball_lattice<3>(0.5, 0.1, true), ball_faces<3>(0.5, true), 0.25, mirrored,
                        gaussian);
  }
  expect_all_bonds<2>(ball_lattice<2>(0.7, 0.1), ball_faces<2>(0.7, false), 0.25, 0b1, gaussian);
  expect_all_bonds<3>(ball_lattice<3>(0.4, 0.1), ball_faces<3>(0.4, false), 0.25, 0b1, gaussian);
}

// A lattice distance that equals the horizon is a bond at every spacing, whatever rounding does.
TEST(Family, CountsLatticeBondsAtTheHorizonAlike) {
  for (const double spacing : {1.0, 0.1, 1.0 / 3.0, 7e-4}) {
    const auto body = test::box_body<2>({9, 9}, spacing, Cloud::lattice, 3.0);
    const auto family = body->family(0);
    const Index centre = body->nearest_point({4.5 * spacing, 4.5 * spacing});
    EXPECT_EQ(family->bond_count(centre), 28) << spacing;
  }
}

// 87 bonds a point take no more than what tells rows apart; those of a cloud a number each, and one
// for the weight.
TEST(Family, SharesListsOfBondsOnALattice) {
  const auto bytes_a_point = [](Cloud cloud) {
    const auto family = test::box_body<3>({16, 16, 16}, 0.1, cloud, 3.0)->family(0);
    EXPECT_GT(family->steps.total() / family->point_count, 80u);
    return static_cast<double>(family->bytes()) / family->point_count;
  };
  EXPECT_LT(bytes_a_point(Cloud::lattice), 120.0);
  EXPECT_GT(bytes_a_point(Cloud::jittered), 80 * 12.0);
}

// A part of a family is the one that would have been built.
TEST(Family, IsTheSameAsAPartOfOneWithMoreGhosts) {
  const auto points = test::box_points<3>({5, 4, 5}, 1.0, Cloud::jittered);
  const auto faces = test::box_faces<3>({5, 4, 5}, 1.0);
  const auto build = [&](FaceSet mirrored) {
    return build_family<3>(points, faces, mirrored, 2.5, InfluenceFunction::gaussian);
  };
  for (const FaceSet mirrored : {0b000000u, 0b100110u, 0b111111u}) {
    const Family<3> built = build(mirrored);
    const Family<3> part = without_other_ghosts(build(0b111111), mirrored);
    EXPECT_EQ(part.position, built.position);
    EXPECT_EQ(part.volume, built.volume);
    EXPECT_EQ(part.ghost_source, built.ghost_source);
    EXPECT_EQ(part.ghost_faces, built.ghost_faces);
    EXPECT_EQ(part.steps, built.steps);
    EXPECT_EQ(part.weight, built.weight);
  }
}

TEST(Family, RefusesABodyThinnerThanTheHorizonBetweenMirroredFaces) {
  const auto body = test::box_body<2>({8, 2}, 1.0);
  EXPECT_NO_THROW(body->family(0b0011));
  try {
    body->family(0b1100);
    FAIL() << "accepted";
  } catch (const BodyError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("2 m between faces 'bottom' and 'top'"));
  }
}

}  // namespace
}  // namespace perifrac
