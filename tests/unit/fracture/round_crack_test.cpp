#include "tests/unit/fracture/round_crack.hpp"

#include <gtest/gtest.h>

#include "modules/solid/fracture/crack_front.hpp"

namespace perifrac::test {
namespace {

Eigen::VectorXd uniform(const RoundCrack& crack, double pressure) {
  return Eigen::VectorXd::Constant(std::ssize(crack.cracked->jumps()), pressure);
}

/// A crack that grows is the crack that was there from the start.
TEST(RoundCrack, GrowsToWhatAFreshBodyIs) {
  const int n = 10;
  const auto all = RoundCrack::disc(n, 4.0);
  RoundCrack fresh(n, all);
  RoundCrack grown(n, {all.begin(), all.begin() + 4});
  for (std::size_t f = 4; f < all.size(); ++f) ASSERT_TRUE(grown.cracked->cut(all[f]));
  const Eigen::MatrixXd& c = fresh.cracked->compliance();
  EXPECT_LE((c - grown.cracked->compliance()).cwiseAbs().maxCoeff(), 1e-9 * c.maxCoeff());
  EXPECT_LE((c - c.transpose()).cwiseAbs().maxCoeff(), 1e-10 * c.maxCoeff());
}

/// Sneddon: w = 8 / (pi E') p sqrt(R^2 - r^2), R of the circle of as many squares. Rollers on the
/// block's walls make it too stiff, free walls too soft: the mean of both is taken. Of five squares
/// to the radius.
TEST(RoundCrack, OpensUnderPressureAsSneddonSays) {
  const int n = 12;
  const auto disc = RoundCrack::disc(n, 5.0);
  const double pressure = 1e-3, radius = RoundCrack::radius(disc.size());
  Eigen::VectorXd opening = Eigen::VectorXd::Zero(std::ssize(disc));
  for (const bool rollers : {false, true}) {
    RoundCrack crack(n, disc, 2.0, rollers);
    opening += 0.5 * crack.cracked->faces(uniform(crack, pressure)).opening;
  }
  for (std::size_t f = 0; f < disc.size(); ++f) {
    const Vector<3> at = middle<3>(disc[f]);
    const double r = std::hypot(at[0], at[1]);
    const double exact = 8.0 / M_PI * pressure * std::sqrt(radius * radius - r * r);
    if (r < 0.7 * radius) {
      EXPECT_NEAR(opening[f], exact, 0.07 * exact) << r;
    }
  }
  const double volume = 4.0 / 3.0 * pressure * std::pow(radius, 3);  // of the quarter
  EXPECT_NEAR(opening.sum(), volume, 0.022 * volume);
}

/// The force of a pressure on the faces balances, and does the work of the openings.
TEST(RoundCrack, PressureAndOpeningAreConjugate) {
  RoundCrack crack(8, RoundCrack::disc(8, 3.0));
  const Eigen::VectorXd pressure = uniform(crack, 2.0);
  const Eigen::VectorXd force = crack.cracked->face_force(pressure);
  EXPECT_NEAR(force.sum(), 0.0, 1e-12);
  const Eigen::VectorXd move = Eigen::VectorXd::Random(force.size());
  double work = 0.0;
  for (Index f = 0; f < std::ssize(crack.cracked->jumps()); ++f) {
    work += pressure[f] * crack.cracked->jumps()[f].area *
            crack.cracked->jump(f, {move.data(), static_cast<std::size_t>(move.size())})[0];
  }
  EXPECT_NEAR(force.dot(move), work, 1e-12 * force.norm() * move.norm());
}

struct Grown {
  std::vector<double> toughness;  ///< at every square, over what was asked for
  double unevenness;              ///< farthest facet less nearest rock, from the edge [spacing]
};

/// The pressure at which a crack of this radius grows, square by square up to another, as K_I = 2 p
/// sqrt(R / pi) of the circle of as many squares.
Grown grow(int n, double from, double to, bool rollers) {
  RoundCrack crack(n, RoundCrack::disc(n, from), 2.0, rollers);
  CrackFront front(*crack.body, *crack.cracked, {{1.0}});  // K_IC = sqrt(E' Gc) = 1
  front.start(crack.cracked->facets(), 0.0);
  Grown grown;
  while (RoundCrack::radius(crack.cracked->facets().size()) < to) {
    const Eigen::VectorXd opening = crack.cracked->free_opening(uniform(crack, 1.0));
    const auto state = [&](const Eigen::VectorXd& scaled) {
      return CrackState<3>{.t = 0.0,
                           .opening = scaled,
                           .pressure = scaled,
                           .viscosity = {},
                           .leak_off = {},
                           .pore_stress = {},
                           .unknowns = {},
                           .jumps = {}};
    };
    const double critical = 1.0 / front.find_readiness(state(opening));
    const double radius = RoundCrack::radius(crack.cracked->facets().size());
    grown.toughness.push_back(2.0 * critical * std::sqrt(radius / M_PI));
    const Eigen::VectorXd at_growth = critical * opening;
    front.find_readiness(state(at_growth));
    EXPECT_GT(front.grow(state(at_growth)), 0.0);
  }
  double nearest = 1e300, farthest = 0.0;
  for (const auto& facet : crack.cracked->facets()) {
    const Vector<3> at = middle<3>(facet);
    farthest = std::max(farthest, std::hypot(at[0], at[1]));
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto cell = square(i, j, crack.height());
      const bool cut = std::ranges::any_of(crack.cracked->facets(), [&](const auto& facet) {
        return middle<3>(facet) == middle<3>(cell);
      });
      if (!cut) nearest = std::min(nearest, std::hypot(i + 0.5, j + 0.5));
    }
  }
  grown.unevenness = farthest - nearest;
  return grown;
}

/// And stays round. The walls' error is evened out as for the opening.
TEST(RoundCrack, GrowsAtItsToughness) {
  const Grown free = grow(12, 3.5, 4.5, false), held = grow(12, 3.5, 4.5, true);
  ASSERT_EQ(free.toughness.size(), held.toughness.size());
  ASSERT_GE(free.toughness.size(), 5u);
  double mean = 0.0;
  for (std::size_t k = 0; k < free.toughness.size(); ++k) {
    const double toughness = 0.5 * (free.toughness[k] + held.toughness[k]);
    EXPECT_NEAR(toughness, 1.0, 0.09);
    mean += toughness / static_cast<double>(free.toughness.size());
  }
  EXPECT_NEAR(mean, 1.0, 0.06);
  EXPECT_LT(free.unevenness, 1.0);
  EXPECT_LT(held.unevenness, 1.0);
}

}  // namespace
}  // namespace perifrac::test
