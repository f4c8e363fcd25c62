#include "modules/solid/fracture/crack_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "modules/solid/fracture/crack_tips.hpp"
#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

constexpr double stress = 2e-3;  // that presses the faces together, of E' = 1
constexpr std::array angles = {0.0, 0.3, M_PI / 4.0};

/// A closed crack in an infinite plate under shear, of which its faces bear a part.
struct SlidingCrack {
  ExactCrack sheared;  ///< by what the faces do not bear
  double borne;        ///< by them [Pa]
  double pressure = 0.0;

  Vector<2> displacement(const Vector<2>& at) const {
    Vector<2> u = sheared.displacement(at);
    const double c = std::cos(sheared.angle), s = std::sin(sheared.angle);
    const double dx = at[0] - sheared.centre[0], dy = at[1] - sheared.centre[1];
    const double strain = 0.5 * borne / sheared.shear_modulus;
    const double along = strain * (-s * dx + c * dy), across = strain * (c * dx + s * dy);
    return {u[0] + c * along - s * across, u[1] + s * along + c * across};
  }
};

/// A crack under an even initial stress in a plate that a shear far away loads.
struct ShearedPlate {
  double angle;
  int half;
  CrackedPlate plate;
  CrackFriction friction{0.0};
  CrackedBody<2>::Faces faces;
  Eigen::VectorXd u;

  ShearedPlate(double at, int half_length)
      : angle(at),
        half(half_length),
        plate(2 * half + 40, straight_crack({half + 20.0, half + 20.0}, at, 2 * half), 0.25,
              nullptr, InitialStress<2>{{-stress, -stress}}) {}

  SlidingCrack exact(double shear, double borne) const {
    const double length = half, mu = plate.shear_modulus();
    return {{plate.middle(), angle, length, 0.0, 0.0, shear - borne, 0.0, mu, 0.25}, borne};
  }
  /// The faces ought to bear so much of the shear.
  void load(double shear, double borne, double pressure = 0.0) {
    plate.solve(exact(shear, borne));
    plate.pressure.setConstant(pressure);
    faces = friction.faces(*plate.cracked, plate.pressure, 0.0);
    u = plate.prescribed + plate.cracked->unknowns(faces.pressure, faces.shear);
  }
  double slip_area() const { return std::accumulate(faces.slip.begin(), faces.slip.end(), 0.0); }
  /// That of the exact crack by the shear that its faces do not bear.
  double slip_area(double drive) const { return 2.0 * M_PI * drive * half * half; }
  /// At the end of the crack.
  double energy_release() const {
    return EnergyRelease(*plate.cracked, 1.0)
        .at(plate.tip(exact(0.0, 0.0).sheared, 1), {u.data(), std::size_t(u.size())},
            faces.pressure, {}, {}, faces.shear)
        .energy_release;
  }
};

/// slip = 4 (tau - mu sigma) / E' sqrt(a^2 - x^2), as far as slip without friction is that, with 20
/// points per half length.
TEST(CrackFriction, LetsFacesSlideByWhatTheyDoNotBear) {
  const double coefficient = 0.4, shear = 1.5e-3, drive = shear - coefficient * stress;
  for (const double angle : angles) {
    ShearedPlate sheared(angle, 20);
    sheared.load(drive, 0.0);
    const double smooth = sheared.slip_area();
    sheared.friction = CrackFriction(coefficient);
    sheared.load(shear, coefficient * stress);
    const double area = sheared.slip_area(drive), middle = 4.0 * drive * sheared.half;
    EXPECT_NEAR(sheared.slip_area(), area, 0.09 * area) << angle;
    EXPECT_NEAR(sheared.slip_area(), smooth, 0.015 * area) << angle;
    EXPECT_NEAR(sheared.faces.slip[sheared.half], middle, 0.07 * middle) << angle;
    for (std::size_t f = 0; f < sheared.faces.slip.size(); ++f) {
      EXPECT_NEAR(sheared.faces.shear[f], -coefficient * sheared.faces.pressure[f], 1e-15) << f;
      EXPECT_EQ(sheared.faces.opening[f], 0.0) << f;
    }
    if (angle != 0.0) continue;
    // A tip sees what the faces do not bear. Off the lattice's axes contact is too uneven for that.
    const double mode_two = drive * std::sqrt(M_PI * sheared.half);
    EXPECT_NEAR(std::sqrt(sheared.energy_release()), mode_two, 0.019 * mode_two);
  }
}

/// Below its limit a closed crack leaves the plate as if it were not there, but for the points
/// beside it: jumps over one spacing of rock there are 1.2 to 1.3 times what even shear strains it.
TEST(CrackFriction, BearsAllShearBelowItsLimit) {
  const double shear = 0.8e-3;
  for (const double angle : angles) {
    ShearedPlate stuck(angle, 10);
    stuck.friction = CrackFriction(1.0);
    stuck.load(shear, shear);
    for (const double slip : stuck.faces.slip) EXPECT_EQ(slip, 0.0) << angle;
    const double borne = -std::accumulate(stuck.faces.shear.begin(), stuck.faces.shear.end(), 0.0);
    EXPECT_NEAR(borne / (2 * stuck.half), shear, 0.03 * shear) << angle;
    const double smooth = std::pow(shear, 2) * M_PI * stuck.half;
    EXPECT_NEAR(stuck.energy_release(), 0.0, 0.04 * smooth) << angle;
    const Index points = stuck.plate.family->point_count;
    double worst = 0.0;
    for (Index i = 0; i < points; ++i) {
      const Vector<2> x = stuck.plate.body->points().at(i);
      const Vector<2> intact = stuck.exact(shear, shear).displacement(x), m = stuck.plate.middle();
      if (std::abs(std::cos(angle) * (x[1] - m[1]) - std::sin(angle) * (x[0] - m[0])) < 2.5)
        continue;
      for (int a = 0; a < 2; ++a) {
        worst = std::max(worst, std::abs(stuck.u[a * points + i] - intact[a]));
      }
    }
    EXPECT_LE(worst, 0.02 * 4.0 * shear * stuck.half) << angle;  // of slip without friction
  }
}

/// What counts is what the faces press on each other beyond the fluid; faces apart bear nothing.
TEST(CrackFriction, FeelsThePressureBeyondTheFluids) {
  const double coefficient = 0.5, shear = 1e-3;
  ShearedPlate wet(0.0, 10);
  wet.friction = CrackFriction(coefficient);
  wet.load(shear, 0.5 * coefficient * stress, 0.5 * stress);
  for (const double borne : wet.faces.shear) EXPECT_NEAR(borne, -0.25 * stress, 1e-12);
  for (const double pressure : wet.faces.pressure) EXPECT_NEAR(pressure, stress, 1e-12);
  wet.load(shear, 0.0, 1.5 * stress);
  for (const double borne : wet.faces.shear) EXPECT_EQ(borne, 0.0);
  EXPECT_GT(wet.faces.opening.minCoeff(), 0.0);
}

TEST(CrackFriction, OfNoneIsContactAsItWas) {
  for (const double angle : angles) {
    ShearedPlate none(angle, 10);
    none.load(1e-3, 0.0, 0.9 * stress);
    const auto smooth = none.plate.cracked->faces(none.plate.pressure);
    const Eigen::VectorXd u = none.plate.prescribed + none.plate.cracked->unknowns(smooth.pressure);
    EXPECT_LE((none.u - u).cwiseAbs().maxCoeff(), 1e-13 * u.cwiseAbs().maxCoeff()) << angle;
    EXPECT_LE((none.faces.pressure - smooth.pressure).cwiseAbs().maxCoeff(), 1e-12 * stress);
    EXPECT_EQ(none.faces.closed, smooth.closed);
  }
}

/// Shear that goes to and fro between -T and T: a crack that bears f = mu sigma and slips by c for
/// what it does not bear, c = 2 pi a^2 / E', dissipates f c (T - f) on the way to the first T, then
/// 4 f c (T - f) a cycle.
TEST(CrackFriction, TakesWhatACycleOfSlipDissipates) {
  const double coefficient = 0.3, borne = coefficient * stress, most = 1.5e-3;
  const int steps = 10;
  ShearedPlate sheared(0.0, 20);
  sheared.friction = CrackFriction(coefficient);
  sheared.friction.start(*sheared.plate.cracked);
  const auto book = [&] {
    sheared.friction.book(*sheared.plate.cracked, sheared.faces, sheared.plate.pressure);
  };
  double first = 0.0, drive = 0.0, slipped = 0.0;
  for (int step = 1; step <= 5 * steps; ++step) {
    const double phase = static_cast<double>(step) / steps;
    const double shear = most * (phase <= 1.0 ? phase : phase <= 3.0 ? 2.0 - phase : phase - 4.0);
    drive = std::clamp(drive, shear - borne, shear + borne);
    const double before = step == 1 ? 0.0 : sheared.slip_area();
    sheared.load(shear, shear - drive);
    EXPECT_NEAR(sheared.slip_area(), sheared.slip_area(drive),
                0.09 * sheared.slip_area(most - borne))
        << step;
    slipped += std::abs(sheared.slip_area() - before);
    book();
    if (step == steps) first = sheared.friction.dissipation();
  }
  const double exact = borne * sheared.slip_area(most - borne);
  const double cycle = sheared.friction.dissipation() - first;
  EXPECT_NEAR(first, exact, 0.09 * exact);
  EXPECT_NEAR(cycle, 4.0 * first, 1e-3 * cycle);
  EXPECT_NEAR(sheared.friction.dissipation(), borne * slipped, 1e-9 * borne * slipped);
}

/// It has borne nothing: seeds alone begin under what presses on them at rest.
TEST(CrackFriction, TakesNothingWhereAFacetThatWasCutSlidesOpen) {
  ShearedPlate sheared(0.0, 10);
  CondensedBody<2>& cracked = *sheared.plate.cracked;
  CrackFriction friction(1.0);
  friction.start(cracked);
  const Vector<2> tip = cracked.facets().back()[1];
  ASSERT_TRUE(cracked.cut({tip, {tip[0] + 1.0, tip[1]}}));
  const std::size_t count = cracked.facets().size();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  CrackedBody<2>::Faces open{none, none, std::vector<bool>(count), std::vector<double>(count),
                             std::vector<double>(count)};
  friction.faces(cracked, none, 0.0);
  open.slip.back() = 1e-3;
  friction.book(cracked, open, none);
  EXPECT_EQ(friction.dissipation(), 0.0);
  open.slip.front() = 1e-3;  // a seed does, up to where it opens; it has opened before
  friction.book(cracked, open, none);
  EXPECT_EQ(friction.dissipation(), 0.0);
  // One that stuck below its limit slides once what presses on it is down to what it bears.
  friction.start(cracked);
  friction.faces(cracked, none, 0.0);
  CrackedBody<2>::Faces stuck = open;
  stuck.pressure.setConstant(stress);
  stuck.shear.front() = 0.25 * stress;
  stuck.slip.front() = 0.0;
  stuck.slip.back() = 0.0;
  friction.book(cracked, stuck, none);
  EXPECT_EQ(friction.dissipation(), 0.0);
  open.slip.back() = 0.0;
  friction.book(cracked, open, none);
  EXPECT_NEAR(friction.dissipation(), 0.125 * stress * 1e-3 * cracked.jumps()[0].area, 1e-18);
}

/// A closed tip goes on by the shear that its faces do not bear, and turns by 70 degrees to where
/// it opens: the wings of a crack under compression. One that sticks stays.
TEST(CrackFriction, LetsWingsGrowFromAClosedCrack) {
  const double coefficient = 0.4, shear = 1.5e-3, fracture_energy = 1e-5;
  ShearedPlate sheared(0.0, 10);
  CrackTips tips(*sheared.plate.body, *sheared.plate.cracked, {{fracture_energy}});
  tips.start(sheared.plate.cracked->facets(), 0.0);
  const auto state = [&]() -> CrackState<2> {
    return {.t = 1.0,
            .opening = sheared.faces.opening,
            .pressure = sheared.faces.pressure,
            .viscosity = {},
            .leak_off = {},
            .pore_stress = {},
            .unknowns =
                [&](auto) { return std::span<const double>(sheared.u.data(), sheared.u.size()); },
            .jumps =
                [&] {
                  return sheared.plate.cracked->jumps_under(sheared.faces.pressure,
                                                            sheared.faces.shear);
                },
            .shear = sheared.faces.shear,
            .slip = sheared.faces.slip};
  };
  sheared.friction = CrackFriction(1.5);
  sheared.load(shear, shear);
  EXPECT_LT(tips.find_readiness(state()), 0.2);
  sheared.friction = CrackFriction(coefficient);
  sheared.load(shear, coefficient * stress);
  const double mode_two = (shear - coefficient * stress) * std::sqrt(M_PI * sheared.half);
  // Of largest hoop stress, at 70 degrees.
  const double ready = 2.0 / std::sqrt(3.0) * mode_two / std::sqrt(fracture_energy);
  EXPECT_NEAR(tips.find_readiness(state()), ready, 0.018 * ready);
  EXPECT_NEAR(tips.grow(state()), 2.0 * fracture_energy, 1e-12 * fracture_energy);
  for (const int wing : {1, 2}) {
    const auto& jump = sheared.plate.cracked->jumps()[sheared.plate.cracked->jumps().size() - wing];
    const double angle = std::atan(jump.tangents[0][1] / jump.tangents[0][0]);
    EXPECT_NEAR(angle * 180.0 / M_PI, -70.0, 1.0);
  }
}

}  // namespace
}  // namespace perifrac::test
