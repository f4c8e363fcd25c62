#include "modules/solid/fracture/crack_plane.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fracture/round_crack.hpp"

namespace perifrac::test {
namespace {

/// A grid whose rock is a square of so many squares about the origin.
CrackPlane plane_of(const std::vector<CrackFacet<3>>& facets, double half) {
  CrackPlane plane(facets.front(), [=](const CrackFacet<3>& facet) {
    const Vector<3> at = middle<3>(facet);
    return std::abs(at[0]) < half && std::abs(at[1]) < half;
  });
  for (std::size_t f = 0; f < facets.size(); ++f) plane.add(facets[f], static_cast<Index>(f));
  return plane;
}

/// Of a straight front the distance; also near a face that it meets at a right angle.
TEST(CrackPlane, MeasuresFromAStraightFront) {
  std::vector<CrackFacet<3>> facets;
  for (int i = -20; i < 3; ++i) {
    for (int j = -20; j < 20; ++j) facets.push_back(square(i, j, 0.0));
  }
  const CrackPlane plane = plane_of(facets, 20.0);
  const auto first = *plane.cell_of(square(0, 0, 0.0));
  for (const int j : {0, 17, 19}) {
    for (const int i : {1, 2, 3, 4}) {
      // The strip is long: what its front would bend by as a circle of its area is small.
      const double bend = 0.5 * 1.25 * 1.25 / plane.radius();
      EXPECT_NEAR(plane.behind_front({first[0] + i, first[1] + j}) - bend, 2.5 - i, 0.05) << i;
    }
  }
}

TEST(CrackPlane, MeasuresFromARoundFront) {
  for (const double radius : {4.0, 6.0, 10.0}) {
    std::vector<CrackFacet<3>> facets;
    for (int i = -11; i < 11; ++i) {
      for (int j = -11; j < 11; ++j) {
        if (std::hypot(i + 0.5, j + 0.5) <= radius) facets.push_back(square(i, j, 0.0));
      }
    }
    const CrackPlane plane = plane_of(facets, 20.0);
    const double even = std::sqrt(static_cast<double>(facets.size()) / M_PI);
    EXPECT_NEAR(plane.radius(), even, 0.024 * even);
    double mean = 0.0;
    int count = 0;
    for (const auto& facet : facets) {
      const Vector<3> at = middle<3>(facet);
      const double behind = even - std::hypot(at[0], at[1]);
      if (behind > 2.5) continue;
      const double error = plane.behind_front(*plane.cell_of(facet)) - behind;
      EXPECT_NEAR(error, 0.0, 0.17) << radius;
      mean += error;
      ++count;
    }
    EXPECT_NEAR(mean / count, 0.0, 0.04) << radius;
  }
}

TEST(CrackPlane, GrowsBesideItsFacetsWithinTheRock) {
  CrackPlane plane = plane_of({square(0, 0, 0.0)}, 1.0);
  EXPECT_EQ(plane.ahead().size(), 2u);  // to the other sides rock ends
  const CrackFacet<3> beside = plane.facet(plane.ahead().front());
  plane.add(beside, 1);
  int shared = 0;
  for (const auto& corner : beside) {
    for (const auto& other : square(0, 0, 0.0)) shared += corner == other ? 1 : 0;
  }
  EXPECT_EQ(shared, 2) << "to the bit";
  EXPECT_EQ(plane.ahead().size(), 2u);
}

TEST(CrackPlane, KnowsItsOwnGrid) {
  const CrackPlane plane = plane_of({square(0, 0, 0.0)}, 5.0);
  EXPECT_EQ(*plane.cell_of(square(2, -3, 0.0)), (CrackPlane::Cell{2, -3}));
  EXPECT_FALSE(plane.cell_of(square(0, 0, 1.0)).has_value());
  CrackFacet<3> shifted = square(0, 0, 0.0);
  for (auto& corner : shifted) corner[0] += 0.5;
  EXPECT_FALSE(plane.cell_of(shifted).has_value());
}

}  // namespace
}  // namespace perifrac::test
