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

}  // namespace
}  // namespace perifrac
