#include "core/bonds/crack_facet.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// A parallelogram of 2 * 1 m in an oblique plane.
const CrackFacet<3> oblique = {
    {{1.0, 2.0, 3.0}, {3.0, 2.0, 3.0}, {3.0, 2.6, 3.8}, {1.0, 2.6, 3.8}}};

double dot(const Vector<3>& a, const Vector<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

TEST(CrackFacet, HasAFrameOfItsPlane) {
  const auto axes = frame<3>(oblique);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(dot(axes[a], axes[b]), a == b ? 1.0 : 0.0, 1e-15);
  }
  const Vector<3> normal = {0.0, -0.8, 0.6};
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(axes[0][a], normal[a], 1e-15);
  EXPECT_NEAR(area<3>(oblique), 2.0, 1e-15);
  EXPECT_NEAR(area<2>({{{0.0, 0.0}, {3.0, 4.0}}}), 5.0, 1e-15);
}

TEST(CrackFacet, TellsPlacesWithinIt) {
  const Vector<3> at = middle<3>(oblique);
  EXPECT_EQ(at, (Vector<3>{2.0, 2.3, 3.4}));
  const auto place = place_within<3>(oblique, {1.5, 2.45, 3.6});
  EXPECT_NEAR(place[0], 0.25, 1e-15);
  EXPECT_NEAR(place[1], 0.75, 1e-14);
  EXPECT_NEAR((place_within<2>({{{0.0, 0.0}, {2.0, 0.0}}}, {0.5, 0.0})[0]), 0.25, 1e-15);
}

/// From both facets that meet there, whichever way round they go.
TEST(CrackFacet, SharesItsSides) {
  const CrackFacet<3> beside = {oblique[2], oblique[1], {5.0, 2.0, 3.0}, {5.0, 2.6, 3.8}};
  int shared = 0;
  for (const auto& side : sides<3>(oblique)) {
    for (const auto& other : sides<3>(beside)) shared += side == other ? 1 : 0;
  }
  EXPECT_EQ(shared, 1);
}

}  // namespace
}  // namespace perifrac
