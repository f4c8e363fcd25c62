#include "app/references/solutions/plate_solution.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

TEST(UniformStrain, IsHookesLaw) {
  const auto strain = uniform_strain(10e9, 0.25, {4e6, 0.0, 0.0}, 3);
  EXPECT_DOUBLE_EQ(strain[0], 4e-4);
  EXPECT_DOUBLE_EQ(strain[1], -1e-4);
  EXPECT_DOUBLE_EQ(strain[2], -1e-4);
  const auto pressed = uniform_strain(10e9, 0.25, {-1e6, -1e6, -1e6}, 3);
  EXPECT_NEAR(pressed[0] + pressed[1] + pressed[2], -1e6 / (10e9 / 1.5), 1e-18);
}

TEST(UniformStrain, LeavesTheThicknessInPlaneStrain) {
  const auto strain = uniform_strain(10e9, 0.25, {1e6, -2e6, 7e6}, 2);
  EXPECT_NEAR(strain[2], 0.0, 1e-18);
  // By lambda = mu = 4 GPa: stress back from strain.
  EXPECT_NEAR(4e9 * (strain[0] + strain[1]) + 8e9 * strain[0], 1e6, 1e-6);
  EXPECT_NEAR(4e9 * (strain[0] + strain[1]) + 8e9 * strain[1], -2e6, 1e-6);
}

}  // namespace
}  // namespace perifrac
