#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

/// A vertical crack in a rock whose stress falls upwards by `fall` a spacing, under a pressure that
/// is `net` above the stress at its middle: K = net sqrt(pi a) +- fall a sqrt(pi a) / 2 at its
/// upper and lower tip, and an opening of (4 net + 2 fall y) sqrt(a^2 - y^2) / E'.
struct VerticalCrack {
  static constexpr int half_length = 10, n = 100;
  static constexpr double net = 1e-3, fall = 8e-5, datum = 43.0;
  ExactCrack exact;
  CrackedPlate plate;
  Eigen::VectorXd u;

  VerticalCrack()
      : exact{{50.0, 50.0}, M_PI / 2.0, half_length, 0.0, 0.0, 0.0, net, 0.375, 0.25},
        plate(n, straight_crack(exact.centre, exact.angle, 2 * half_length), 0.25, nullptr,
              InitialStress<2>{{{-5e-3, -9e-3}, {}}, {fall, 3e-4}, datum}) {
    plate.solve(exact);  // far away, where a stress that is linear moves nothing
    const double pressure = net + 5e-3 - fall * (exact.centre[1] - datum);
    plate.pressure = Eigen::VectorXd::Constant(2 * half_length, pressure);
    u = plate.prescribed + plate.cracked->unknowns(plate.pressure);
  }
  double intensity(int end) const {
    return std::sqrt(plate.tip_load(exact, end, u).energy_release);
  }
};

TEST(StressGradient, OpensAVerticalCrackAsInTheClosedForm) {
  const VerticalCrack crack;
  const double a = VerticalCrack::half_length, root = std::sqrt(M_PI * a);
  const double by_net = VerticalCrack::net * root, by_fall = 0.5 * VerticalCrack::fall * a * root;
  EXPECT_NEAR(crack.intensity(1) / (by_net + by_fall), 1.0, 0.0017);  // 0.0012
  EXPECT_NEAR(crack.intensity(0) / (by_net - by_fall), 1.0, 0.02);    // 0.014
  const std::span u(crack.u.data(), static_cast<std::size_t>(crack.u.size()));
  for (Index f = 2; f < 18; ++f) {
    const double y = f + 0.5 - a, load = VerticalCrack::net + VerticalCrack::fall * y;
    const double exact = 2.0 * (VerticalCrack::net + load) * std::sqrt(a * a - y * y);
    const double opening =
        crack.plate.cracked->jump(f, u)[0] + load * crack.plate.cracked->pressed_by(f);
    EXPECT_NEAR(opening, exact, 0.018 * 4.0 * VerticalCrack::net * a) << y;  // 0.013
  }
}

}  // namespace
}  // namespace perifrac::test
