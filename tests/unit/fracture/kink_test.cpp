#include <cmath>

#include <gtest/gtest.h>

#include "modules/solid/fracture/energy_release.hpp"

namespace perifrac {
namespace {

/// Times the root of the distance: of the modes' near field at an angle to the crack.
double hoop_stress(const TipModes& modes, double angle) {
  const double c = std::cos(0.5 * angle);
  return c * (modes.opening * c * c - 1.5 * modes.sliding * std::sin(angle));
}

TEST(Kink, IsWhereTheHoopStressIsLargest) {
  for (const double sliding : {-3.0, -1.0, -0.2, 0.05, 0.7, 2.0}) {
    const TipModes modes{1.0, sliding};
    double largest = 0.0, at = 0.0;
    for (double angle = -1.3; angle <= 1.3; angle += 1e-4) {
      if (hoop_stress(modes, angle) < largest) continue;
      largest = hoop_stress(modes, angle);
      at = angle;
    }
    EXPECT_NEAR(kink_angle(modes), at, 2e-4) << sliding;
    EXPECT_NEAR(kink_intensity(modes), largest, 1e-7 * largest) << sliding;
  }
}

TEST(Kink, OfOneModeAloneIsTheTextbooks) {
  EXPECT_EQ(kink_angle({2.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(kink_intensity({2.0, 0.0}), 2.0);
  EXPECT_NEAR(kink_intensity({0.0, 1.0}), 2.0 / std::sqrt(3.0), 1e-4);
  EXPECT_LT(kink_angle({0.0, 1.0}), 0.0) << "to the right";
}

/// 4 sqrt(2 s / pi) T is 8 / 3 of T in the unit of the near field: the stress along the crack takes
/// part in the hoop stress.
TEST(Kink, IsHeldBackByAStressAlongTheCrack) {
  for (const double sliding : {-2.0, -0.3, 0.01, 0.5}) {
    for (const double along : {-0.5, -3.0, -20.0}) {
      const TipModes modes{1.0, sliding};
      const auto total = [&](double a) {
        return hoop_stress(modes, a) + 3.0 / 8.0 * along * std::sin(a) * std::sin(a);
      };
      double largest = total(0.0), at = 0.0;
      for (double angle = -1.3; angle <= 1.3; angle += 1e-4) {
        if (total(angle) < largest) continue;
        largest = total(angle);
        at = angle;
      }
      EXPECT_NEAR(kink_angle(modes, along), at, 2e-4) << sliding << ' ' << along;
    }
  }
  // K_II + K_I angle / 2 - 2 sqrt(2 s / pi) T angle = 0
  EXPECT_NEAR(kink_angle({1.0, 1e-3}, -7.0), -1e-3 / (0.5 + 3.5), 1e-8);
  EXPECT_EQ(kink_angle({1.0, 0.4}, 2.0), kink_angle({1.0, 0.4})) << "it does not turn a crack";
}

}  // namespace
}  // namespace perifrac
