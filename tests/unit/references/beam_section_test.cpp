#include "app/references/solutions/beam_section.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

TEST(BeamSection, ClampedDeflectionIsThatOfTheUnitLoad) {
  const BeamSection section(100e6, 0.3, 0.1);
  const double length = 0.8, load = 3e3;
  // Virtual work by the midpoint rule; moments at the clamps from rotations that vanish there.
  constexpr int parts = 20000;
  double deflection = 0.0;
  double rotation = 0.0;
  for (int n = 0; n < parts; ++n) {
    const double dx = 0.5 * length / parts;
    const double x = (n + 0.5) * dx;
    const double moment = load * (0.5 * x * (length - x) - length * length / 12.0);
    const double shear = load * (0.5 * length - x);
    const double unit_moment = 0.5 * x - length / 8.0;
    const double unit_shear = 0.5;
    rotation += moment * dx;
    deflection +=
        2.0 * dx * (moment * unit_moment / section.bending + shear * unit_shear / section.shear);
  }
  EXPECT_NEAR(rotation, 0.0, 1e-6) << "the slope in the middle";
  EXPECT_NEAR(section.clamped_deflection(length, load), deflection, 1e-7 * deflection);
}

TEST(BeamSection, HasThePlaneStrainStiffness) {
  const BeamSection section(100e6, 0.3, 0.1);
  EXPECT_NEAR(section.bending, 100e6 / 0.91 * 1e-3 / 12.0, 1e-6);
  EXPECT_NEAR(section.shear, 100e6 / 2.6 * 0.1 * 5.0 / 6.0, 1e-6);
}

}  // namespace
}  // namespace perifrac
