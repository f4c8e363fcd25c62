#include "app/warnings/mean_dissipation.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

/// Of points at (n + 1/2) that move so.
template <int D>
double dissipation(const std::array<int, D>& counts,
                   const std::function<Vector<D>(const Vector<D>&)>& velocity) {
  const Points<D> points = box_lattice<D>(counts, 1.0);
  const auto count = static_cast<std::size_t>(points.size());
  std::vector<double> blocks(D * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector<D> v = velocity(points.at(static_cast<Index>(i)));
    for (int a = 0; a < D; ++a) blocks[a * count + i] = v[a];
  }
  return mean_dissipation<D>(positions_of(points.position), blocks, 2.0);
}

TEST(MeanDissipation, IsThatOfFlowAlongAChannel) {
  // u = 4 U y (h - y) / h^2: the pressure's fall, 8 U / h^2 a length, times the mean speed, 2/3 U.
  constexpr double high = 40.0, fastest = 3.0;
  const auto parabola = [&](double y) { return 4.0 * fastest * y * (high - y) / (high * high); };
  const double exact = 16.0 / 3.0 * fastest * fastest / (high * high);
  EXPECT_NEAR((dissipation<2>({10, 40},
                              [&](const Vector<2>& x) {
                                return Vector<2>{parabola(x[1]), 0.0};
                              })),
              exact, 0.05 * exact);
  EXPECT_NEAR((dissipation<3>({8, 8, 40},
                              [&](const Vector<3>& x) {
                                return Vector<3>{0.0, parabola(x[2]), 0.0};
                              })),
              exact, 0.05 * exact);
}

TEST(MeanDissipation, IsNoneWhereFluidRestsOrMovesAsOne) {
  EXPECT_EQ((dissipation<2>({9, 9}, [](const Vector<2>&) { return Vector<2>{}; })), 0.0);
  EXPECT_NEAR((dissipation<2>({9, 9},
                              [](const Vector<2>&) {
                                return Vector<2>{1.0, 2.0};
                              })),
              0.0, 1e-14);
  EXPECT_NEAR((dissipation<2>({9, 9},
                              [](const Vector<2>& x) {
                                return Vector<2>{-x[1], x[0]};
                              })),
              0.0, 1e-14);
}

}  // namespace
}  // namespace perifrac
