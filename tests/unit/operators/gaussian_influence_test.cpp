#include "core/geometry/gaussian_influence.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/packet.hpp"

namespace perifrac {
namespace {

TEST(GaussianInfluence, IsTheExponentialWithinTheHorizon) {
  for (const double horizon : {1.0, 2.5e-3, 40.0}) {
    const GaussianInfluence influence(horizon);
    for (double part = 0.0; part < 1.0; part += 1e-3) {
      const double r = part * horizon;
      const double expected = std::exp(-std::pow(r / (0.4 * horizon), 2));
      ASSERT_NEAR(influence(r * r), expected, 1e-12 * expected) << "at " << part << " horizons";
    }
  }
}

TEST(GaussianInfluence, EndsAtTheHorizon) {
  const GaussianInfluence influence(2.5);
  EXPECT_GT(influence(2.5 * 2.5 * (1.0 + 1e-14)), 0.0);
  EXPECT_EQ(influence(2.5001 * 2.5001), 0.0);
  EXPECT_EQ(influence(1e300), 0.0);
}

TEST(GaussianInfluence, GivesAPacketTheSameBits) {
  const GaussianInfluence influence(1.0);
  Packet r_square;
  for (int l = 0; l < packet_size; ++l) r_square[l] = 0.17 * l;
  const Packet omega = influence(r_square);
  for (int l = 0; l < packet_size; ++l) EXPECT_EQ(omega[l], influence(r_square[l])) << l;
}

}  // namespace
}  // namespace perifrac
