#include "modules/solid/fracture/stretch_limit.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

constexpr IsotropicElasticity<2> rock{40.0, 40.0};  // E 100, nu 0.25

/// Against sums over the lattice done apart: the Gaussian at 2.5 spacings.
TEST(StretchLimit, CountsTheBondsAcrossAPlane) {
  const double delta = 2.5 * 0.5;
  const auto body = test::box_body<2>({9, 9}, 0.5);
  const CrossingBonds bonds = crossing_bonds(*body->family(0), 0.5);
  EXPECT_NEAR(bonds.single / delta, 0.1614, 5e-5);
  EXPECT_NEAR(bonds.squared / delta, 0.0522, 1.8e-5);
}

/// Towards the integrals for 1/r as the lattice is refined in the horizon; the paper's chi.
TEST(StretchLimit, TendsToTheIntegralsOfTheContinuum) {
  const auto body =
      test::box_body<2>({25, 25}, 1.0, test::Cloud::lattice, 12.0, InfluenceFunction::inverse);
  const CrossingBonds bonds = crossing_bonds(*body->family(0), 1.0);
  EXPECT_NEAR(bonds.single / 12.0, 0.239, 5e-3);
  EXPECT_NEAR(bonds.squared / 12.0, 0.0806, 1.9e-3);
}

TEST(StretchLimit, FollowsFromTheFractureEnergy) {
  const CrossingBonds bonds{0.4, 0.1};
  EXPECT_DOUBLE_EQ(consistent_stretch(rock, 2.0, bonds),
                   std::sqrt(2.0 / ((4.0 * 80.0 - 8.0 * 40.0) * 0.1 + 8.0 * 40.0 * 0.4)));
  EXPECT_DOUBLE_EQ(
      printed_stretch(rock, 2.0, 2.5),
      std::sqrt(2.0 / ((4.0 * 100.0 / 1.5 - 320.0) * 0.804 * 2.5 + 320.0 * 0.239 * 2.5)));
  EXPECT_DOUBLE_EQ(calibrated_stretch(rock, 2.0, 0.5),
                   1.25 * 0.5 * std::sqrt(200.0 / 0.9375) / (100.0 * std::sqrt(M_PI * 0.5)));
}

}  // namespace
}  // namespace perifrac
