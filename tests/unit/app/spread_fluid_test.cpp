#include "app/warnings/spread_fluid.hpp"

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

/// Of points that are `apart` spacings of 0.1 m apart, each `volume` large.
template <int D>
double part(const std::array<int, D>& counts, double apart, double volume) {
  const Points<D> points = box_lattice<D>(counts, 0.1 * apart);
  const std::vector<double> volumes(points.size(), volume);
  return filled_part<D>(positions_of(points.position), volumes, 0.1);
}

TEST(FilledPart, IsWhatIsThereOfVolume) {
  EXPECT_NEAR((part<2>({20, 20}, 1.0, 0.01)), 1.0, 0.02);
  EXPECT_NEAR((part<3>({10, 10, 10}, 1.0, 0.001)), 1.0, 0.02);
  EXPECT_NEAR((part<2>({20, 20}, 1.0, 0.008)), 0.8, 0.02);
  EXPECT_NEAR((part<2>({20, 20}, 1.05, 0.01)), 1.0 / (1.05 * 1.05), 0.02);
  EXPECT_NEAR((part<3>({10, 10, 10}, 1.05, 0.001)), 1.0 / (1.05 * 1.05 * 1.05), 0.02);
}

TEST(FilledPart, SaysNothingOfDrops) {
  EXPECT_EQ((part<2>({2, 20}, 1.0, 0.01)), 1.0);
  EXPECT_EQ((part<2>({20, 20}, 4.0, 0.01)), 1.0);
}

}  // namespace
}  // namespace perifrac
