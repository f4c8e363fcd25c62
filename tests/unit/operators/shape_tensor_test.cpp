#include "core/bonds/shape_tensor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

// Inside a lattice K = (m / D) I by symmetry, and m is a sum over the offsets of a family.
TEST(ShapeTensor, IsIsotropicInsideALattice) {
  const auto body = test::box_body<3>({7, 7, 7}, 1.0);
  const auto family = body->family(0);
  const auto moments = family_moments(*family);
  double m = 0.0;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        const double r2 = x * x + y * y + z * z;
        if (r2 <= 6.25) m += std::exp(-r2) * r2;  // 0.4 horizons are one spacing
      }
    }
  }
  const Index centre = body->nearest_point({3.5, 3.5, 3.5});
  EXPECT_NEAR(moments.weighted_volume[centre], m, 1e-13 * m);
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(moments.inverse_shape[k][centre], k % 4 == 0 ? 3.0 / m : 0.0, 1e-13);
  }
}

TEST(ShapeTensor, IsThatOfTheInsideNextToMirroredFaces) {
  const auto body = test::box_body<2>({6, 6}, 1.0);
  const auto moments = family_moments(*body->family(0b1111));
  const Index corner = body->nearest_point({0.5, 0.5});
  const Index centre = body->nearest_point({2.5, 2.5});
  EXPECT_NEAR(moments.weighted_volume[corner], moments.weighted_volume[centre], 1e-13);
  EXPECT_NEAR(moments.inverse_shape[1][corner], 0.0, 1e-14);
}

/// A restored run makes moments one by one that the run before it made all at once.
template <int D>
void expect_the_same_bits(const std::array<int, D>& counts) {
  const auto body = test::box_body<D>(counts, 0.3, test::Cloud::jittered);
  const auto family = body->family(0);
  const auto all = family_moments(*family);
  auto anew = all;
  for (Index i = 0; i < family->point_count; ++i) EXPECT_FALSE(set_moments(*family, i, anew));
  EXPECT_EQ(anew.inverse_shape, all.inverse_shape);
  EXPECT_EQ(anew.weighted_volume, all.weighted_volume);
}

TEST(ShapeTensor, MadeAnewHasTheSameBits) {
  expect_the_same_bits<2>({12, 9});
  expect_the_same_bits<3>({6, 7, 8});
}

TEST(ShapeTensor, RefusesAFamilyInALine) {
  const auto body = test::box_body<2>({8, 1}, 1.0);
  try {
    family_moments(*body->family(0));
    FAIL() << "accepted";
  } catch (const BodyError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bonds of the point at (0.5, 0.5) m"));
  }
}

}  // namespace
}  // namespace perifrac
