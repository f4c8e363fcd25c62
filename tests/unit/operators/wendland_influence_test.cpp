#include "core/geometry/wendland_influence.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// Wendland's C2 kernel as it is printed, of smoothing length h, half of its reach.
double kernel(int dimension, double h, double r) {
  const double q = r / h;
  const double whole =
      dimension == 2 ? 7.0 / (4.0 * std::numbers::pi) : 21.0 / (16.0 * std::numbers::pi);
  return q < 2.0 ? whole / std::pow(h, dimension) * std::pow(1.0 - 0.5 * q, 4) * (1.0 + 2.0 * q)
                 : 0.0;
}

/// Its slope over r at r = 0.
double curvature(int dimension, double h) { return -5.0 / (h * h) * kernel(dimension, h, 0.0); }

TEST(WendlandInfluence, IsTheSlopeOfTheKernel) {
  for (const int dimension : {2, 3}) {
    for (const double h : {0.5, 1.3}) {
      const WendlandInfluence influence(2.0 * h);
      for (double r = 0.05 * h; r < 2.3 * h; r += 0.05 * h) {
        const double step = 1e-5 * h;
        const double slope =
            (kernel(dimension, h, r + step) - kernel(dimension, h, r - step)) / (2.0 * step);
        EXPECT_NEAR(influence(r * r), slope / r / curvature(dimension, h), 1e-9) << r;
      }
    }
  }
}

/// Integrals over space: of the kernel 1, of omega r^2 the dimension over that of -W' / r.
TEST(WendlandInfluence, IsThatOfAKernelWhoseIntegralIsOne) {
  for (const int dimension : {2, 3}) {
    const double h = 0.7;
    const WendlandInfluence influence(2.0 * h);
    double whole = 0.0, square = 0.0;
    constexpr int cells = 20000;
    const double cell = 2.0 * h / cells;
    for (int n = 0; n < cells; ++n) {
      const double r = (n + 0.5) * cell;
      const double shell =
          dimension == 2 ? 2.0 * std::numbers::pi * r : 4.0 * std::numbers::pi * r * r;
      whole += cell * shell * kernel(dimension, h, r);
      square += cell * shell * influence(r * r) * r * r;
    }
    EXPECT_NEAR(whole, 1.0, 1e-7);
    EXPECT_NEAR(-curvature(dimension, h) * square, dimension, 1e-7);
  }
}

TEST(WendlandInfluence, GivesAPacketTheSameBits) {
  const WendlandInfluence influence(1.0);
  for (double r = 0.0; r < 1.2; r += 0.013) {
    Packet square;
    for (int l = 0; l < packet_size; ++l) square[l] = (r + 0.001 * l) * (r + 0.001 * l);
    const Packet omega = influence(square);
    for (int l = 0; l < packet_size; ++l) {
      const double one = square[l];
      EXPECT_EQ(omega[l], influence(one)) << r;
    }
  }
}

}  // namespace
}  // namespace perifrac
