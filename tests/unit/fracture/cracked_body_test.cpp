#include "modules/solid/fracture/cracked_body.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "modules/solid/fracture/loose_piece.hpp"
#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

ExactCrack crack_in(const CrackedPlate& plate, double angle, double half_length) {
  return {plate.middle(),     angle, half_length, 0.0, 0.0, 0.0, 0.0, plate.shear_modulus(),
          plate.poisson_ratio};
}

/// A crack that grows is the crack that was there from the start.
void expect_growth_to_a_fresh_body(Rock rock) {
  const int n = 40, half = 6;
  const Vector<2> middle = {0.5 * n, 0.5 * n};
  const auto all = straight_crack(middle, 0.3, 2 * half);
  CrackedPlate fresh(n, all, 0.25, nullptr, {}, rock);
  CrackedPlate grown(n, {all.begin(), all.begin() + 5}, 0.25, nullptr, {}, rock);
  for (std::size_t f = 5; f < all.size(); ++f) ASSERT_TRUE(grown.cracked->cut(all[f]));
  ExactCrack exact = crack_in(fresh, 0.3, half);
  exact.normal = exact.shear = exact.pressure = 1e-3;
  const Eigen::VectorXd u = fresh.solve(exact), v = grown.solve(exact);
  EXPECT_LE((u - v).cwiseAbs().maxCoeff(), 1e-10 * u.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd& c = fresh.cracked->compliance();
  EXPECT_LE((c - grown.cracked->compliance()).cwiseAbs().maxCoeff(), 1e-9 * c.maxCoeff());
}

/// The sides of a square of `side` spacings in the middle of a plate of 40.
std::vector<CrackFacet<2>> box_around_middle(double side) {
  const double a = 20.0 - 0.5 * side, b = 20.0 + 0.5 * side;
  const std::array<Vector<2>, 5> corners = {{{a, a}, {b, a}, {b, b}, {a, b}, {a, a}}};
  std::vector<CrackFacet<2>> facets;
  for (int leg = 0; leg < 4; ++leg) {
    for (int k = 0; k < side; ++k) {
      const auto at = [&](int n) {
        const double share = n / side;
        return Vector<2>{(1.0 - share) * corners[leg][0] + share * corners[leg + 1][0],
                         (1.0 - share) * corners[leg][1] + share * corners[leg + 1][1]};
      };
      facets.push_back({at(k), at(k + 1)});
    }
  }
  return facets;
}

/// All or nothing: what cannot be cut leaves the body as it was, to the bit.
TEST(CrackedBody, IsAsItWasWhereACutWouldSetAPieceFree) {
  for (const int side : {1, 2, 4}) {
    const auto facets = box_around_middle(side);
    CrackedPlate plate(40, {facets.front()});
    CrackedPlate untouched(40, {facets.front()});
    const auto load = Eigen::VectorXd::LinSpaced(plate.free_count(), -1.0, 1.0);
    for (CrackedPlate* each : {&plate, &untouched}) {
      each->cracked->set_load(load);
      for (std::size_t f = 1; f + 1 < facets.size(); ++f) each->cracked->cut(facets[f]);
    }
    EXPECT_THROW(plate.cracked->cut(facets.back()), PieceCutFree);
    ASSERT_EQ(plate.cracked->facets().size(), facets.size() - 1);
    EXPECT_EQ(plate.family->weight, untouched.family->weight);
    const Eigen::VectorXd pressure = Eigen::VectorXd::Constant(std::ssize(facets) - 1, 1e-3);
    EXPECT_EQ(plate.cracked->unknowns(pressure), untouched.cracked->unknowns(pressure));
    EXPECT_EQ(plate.cracked->faces(pressure).opening, untouched.cracked->faces(pressure).opening);
    const CrackFacet<2> next = {{{30.5, 10.5}, {31.5, 10.5}}};
    EXPECT_TRUE(plate.cracked->cut(next));
    EXPECT_EQ(plate.cracked->jumps().size(), facets.size());
  }
}

TEST(CrackedBody, NamesThePieceThatComesFree) {
  const auto facets = box_around_middle(4);
  CrackedPlate plate(40, {facets.front()});
  for (std::size_t f = 1; f + 1 < facets.size(); ++f) plate.cracked->cut(facets[f]);
  try {
    plate.cracked->cut(facets.back());
    FAIL() << "a piece that nothing holds is in balance";
  } catch (const PieceCutFree& piece) {
    EXPECT_STREQ(piece.what(), "a piece of 16 points, from (18.5, 18.5) to (21.5, 21.5) m");
  }
}

/// The outer rows of the plate hold both halves.
TEST(CrackedBody, MayBeParted) {
  std::vector<CrackFacet<2>> facets = straight_crack({20.0, 20.0}, 0.0, 40);
  CrackedPlate plate(40, {facets.front()});
  for (std::size_t f = 1; f < facets.size(); ++f) EXPECT_TRUE(plate.cracked->cut(facets[f]));
  EXPECT_TRUE(plate.cracked->loose_pieces().empty());
}

TEST(CrackedBody, GrowsToWhatAFreshBodyIs) {
  for (const Rock rock : rocks) expect_growth_to_a_fresh_body(rock);
}

void expect_symmetric_compliance(Rock rock) {
  CrackedPlate plate(40, straight_crack({20.0, 20.0}, 0.3, 10), 0.25, nullptr, {}, rock);
  const Eigen::MatrixXd& c = plate.cracked->compliance();
  for (Eigen::Index f = 0; f < c.rows(); ++f) {
    for (Eigen::Index g = 0; g < f; ++g) {
      EXPECT_NEAR(c(f, g) * plate.cracked->jumps()[f].area,
                  c(g, f) * plate.cracked->jumps()[g].area, 1e-10 * c.maxCoeff());
    }
  }
}

TEST(CrackedBody, HasASymmetricCompliance) {
  for (const Rock rock : rocks) expect_symmetric_compliance(rock);
}

/// Sneddon: w = 4 p / E' sqrt(a^2 - x^2), with 20 points per half length.
TEST(CrackedBody, OpensUnderPressureAsSneddonSays) {
  const int half = 20;
  for (const double angle : {0.0, quarter}) {
    CrackedPlate plate(2 * half + 40, straight_crack({40.0, 40.0}, angle, 2 * half));
    ExactCrack exact = crack_in(plate, angle, half);
    exact.pressure = 1e-3;
    plate.solve(exact);
    const auto faces = plate.cracked->faces(plate.pressure);
    double volume = 0.0;
    for (int f = 0; f < 2 * half; ++f) {
      const double x = f + 0.5 - half;
      const double opening = 4e-3 * std::sqrt(half * half - x * x);
      if (std::abs(x) < 0.8 * half) {
        EXPECT_NEAR(faces.opening[f], opening, 0.05 * opening) << x;
      }
      volume += faces.opening[f];
    }
    EXPECT_NEAR(volume, 2e-3 * M_PI * half * half, 0.017 * volume) << angle;
  }
}

/// The rock that the jump is taken over is pressed together: 1.7 and 3.4 % here, if it counted.
TEST(CrackedBody, OpensInItsMiddleAsSneddonSaysAtAnySpacing) {
  for (const int half : {5, 10}) {
    CrackedPlate plate(2 * half + 40, straight_crack({half + 20.0, half + 20.0}, 0.0, 2 * half));
    ExactCrack exact = crack_in(plate, 0.0, half);
    exact.pressure = 1e-3;
    plate.solve(exact);
    const double opening = 4e-3 * std::sqrt(half * half - 0.25);
    EXPECT_NEAR(plate.cracked->faces(plate.pressure).opening[half], opening, 3e-3 * opening);
  }
}

/// A closed crack without friction slides as an open one does, and does not open by that.
TEST(CrackedBody, SlidesWhereItIsClosed) {
  const int half = 20;
  for (const double angle : {0.0, quarter}) {
    CrackedPlate plate(2 * half + 40, straight_crack({40.0, 40.0}, angle, 2 * half));
    ExactCrack sheared = crack_in(plate, angle, half);
    sheared.shear = 1e-3;
    plate.solve(sheared);
    const auto faces = plate.cracked->faces(Eigen::VectorXd::Zero(2 * half));
    const Eigen::VectorXd u = plate.prescribed + plate.cracked->unknowns(faces.pressure);
    double slip = 0.0;
    for (int f = 0; f < 2 * half; ++f) {
      slip += std::abs(plate.cracked->jump(f, {u.data(), static_cast<std::size_t>(u.size())})[1]);
    }
    const double middle =
        std::abs(plate.cracked->jump(half, {u.data(), static_cast<std::size_t>(u.size())})[1]);
    EXPECT_NEAR(middle, 4e-3 * half, 0.045 * 4e-3 * half) << angle;
    plate.pressure = faces.pressure;
    EXPECT_NEAR(std::sqrt(plate.tip_load(sheared, 1, u).energy_release), sheared.mode_two(),
                0.027 * sheared.mode_two())
        << angle;
    EXPECT_LE(faces.opening.sum(), 0.0062 * slip) << angle;
  }
}

/// At rest under stress the contact bears just that stress, and the body stays where it is.
void expect_initial_stress_borne(Rock rock) {
  const double angle = 0.3;
  CrackedPlate plate(40, straight_crack({20.0, 20.0}, angle, 10), 0.25, nullptr,
                     InitialStress<2>{{-2e-3, -2e-3}}, rock);
  plate.solve(crack_in(plate, angle, 5));
  const auto faces = plate.cracked->faces(Eigen::VectorXd::Zero(10));
  EXPECT_EQ(faces.opening.maxCoeff(), 0.0);
  for (int f = 0; f < 10; ++f) EXPECT_NEAR(faces.pressure[f], 2e-3, 1e-12) << f;
  EXPECT_TRUE(std::ranges::all_of(faces.closed, std::identity()));
  EXPECT_LE(plate.cracked->unknowns(faces.pressure).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CrackedBody, BearsItsInitialStressWhereItIsClosed) {
  for (const Rock rock : rocks) expect_initial_stress_borne(rock);
}

/// Energies from the condensed unknowns are those of the displacements, and what a pressure does to
/// openings is what it does to displacements.
void expect_energies_of_the_displacements(Rock rock) {
  CrackedPlate plate(40, straight_crack({20.0, 20.0}, 0.3, 6), 0.25, nullptr, {}, rock);
  plate.cracked->cut(straight_crack({20.0, 20.0}, 0.3, 8).back());
  const Eigen::VectorXd load =
      Eigen::VectorXd::LinSpaced(plate.prescribed.size() - 2 * std::ssize(plate.told), -1.0, 2.0);
  plate.cracked->set_load(load);
  const Eigen::VectorXd pressure =
      Eigen::VectorXd::Constant(std::ssize(plate.cracked->jumps()), 0.5);
  const Eigen::VectorXd u = plate.cracked->unknowns(pressure);
  std::vector<double> force(u.size()), theta(plate.family->point_count);
  plate.elastic->apply({u.data(), static_cast<std::size_t>(u.size())}, {}, force, theta);
  const Eigen::Map<const Eigen::VectorXd> inner(force.data(), u.size());
  const auto energies = plate.cracked->energies(pressure);
  const double pressed = plate.cracked->pressed_energies(pressure).elastic;
  EXPECT_GT(pressed, 0.0);
  EXPECT_NEAR(energies.elastic, 0.5 * u.dot(inner) + pressed, 1e-9 * energies.elastic);
  EXPECT_NEAR(energies.load, u.dot(inner - plate.cracked->face_force(pressure)),
              1e-9 * energies.elastic);
  double by_openings = 0.0;
  for (Index f = 0; f < std::ssize(plate.cracked->jumps()); ++f) {
    const double opening = plate.cracked->jump(f, {u.data(), std::size_t(u.size())})[0];
    by_openings += pressure[f] * plate.cracked->jumps()[f].area * opening;
  }
  EXPECT_NEAR(by_openings, u.dot(plate.cracked->face_force(pressure)), 1e-12 * by_openings);
}

TEST(CrackedBody, KnowsItsEnergiesWithoutDisplacements) {
  for (const Rock rock : rocks) expect_energies_of_the_displacements(rock);
}

/// Near a tip displacements are found without those of the rest, which J then must not see: also
/// at a side that is told where it is, and where the crack was cut facet by facet.
void expect_displacements_near_a_tip(Rock rock) {
  for (const double off : {20.0, 36.5}) {
    CrackedPlate plate(40, straight_crack({off - 2.0, 20.0}, 0.3, 4), 0.25, nullptr, {}, rock);
    ExactCrack exact = crack_in(plate, 0.3, 2.0);
    exact.centre = {off - 2.0, 20.0};
    for (int k = 0; k < 3; ++k) {
      const CrackTip tip = plate.tip(exact, 1);
      const Vector<2> next = {tip.place[0] + tip.direction[0], tip.place[1] + tip.direction[1]};
      ASSERT_TRUE(plate.cracked->cut({tip.place, next}));
      for (int a = 0; a < 2; ++a) exact.centre[a] += 0.5 * tip.direction[a];
      exact.half_length += 0.5;
    }
    const Eigen::Index free = plate.prescribed.size() - 2 * std::ssize(plate.told);
    plate.cracked->set_load(Eigen::VectorXd::LinSpaced(free, -1.0, 2.0));
    plate.pressure = Eigen::VectorXd::LinSpaced(std::ssize(plate.cracked->jumps()), 0.5, 1.5);
    const Eigen::VectorXd u = plate.cracked->unknowns(plate.pressure);
    const CrackTip tip = plate.tip(exact, 1);
    const std::vector<Index> named = EnergyRelease(*plate.cracked, 1.0).looks_at(tip);
    EXPECT_LT(std::ssize(named), u.size() / 3);
    Eigen::VectorXd near = Eigen::VectorXd::Constant(u.size(), std::nan(""));
    plate.cracked->find_unknowns(plate.pressure, named, {near.data(), std::size_t(near.size())});
    for (const Index k : named) ASSERT_NEAR(near[k], u[k], 1e-12 * u.cwiseAbs().maxCoeff()) << k;
    const double j = plate.tip_load(exact, 1, u).energy_release;
    EXPECT_NEAR(plate.tip_load(exact, 1, near).energy_release, j, 1e-10 * std::abs(j));
    EXPECT_NEAR(kink_angle(modes_of(plate.tip_load(exact, 1, near))),
                kink_angle(modes_of(plate.tip_load(exact, 1, u))), 1e-10);
  }
}

TEST(CrackedBody, FindsDisplacementsNearATipAlone) {
  for (const Rock rock : rocks) expect_displacements_near_a_tip(rock);
}

/// Fluid that lags the tip: the energy that growth sets free is the mean of J before and after.
TEST(EnergyRelease, IsThatOfGrowthWhereFluidEndsShortOfTheTip) {
  const int wet = 12;
  const auto state = [&](int count, double& energy) {
    CrackedPlate plate(60, straight_crack({30.0, 30.0}, 0.0, count));
    ExactCrack exact = crack_in(plate, 0.0, 0.5 * count);
    plate.pressure = Eigen::VectorXd::Zero(count);
    plate.pressure.segment((count - wet) / 2, wet).setOnes();
    energy = 0.5 * plate.pressure.dot(plate.cracked->compliance() * plate.pressure);
    return plate.tip_load(exact, 1, plate.cracked->unknowns(plate.pressure)).energy_release;
  };
  for (const int count : {16, 20}) {
    double before = 0.0, after = 0.0;
    const double j = 0.5 * (state(count, before) + state(count + 2, after));
    EXPECT_NEAR(j, 0.5 * (after - before), 0.03 * j) << count;
  }
}

/// Mixed load: J is (K_I^2 + K_II^2) / E', and the crack turns to its right under positive K_II.
TEST(EnergyRelease, HoldsForBothModes) {
  const int half = 10;
  CrackedPlate plate(70, straight_crack({35.0, 35.0}, 0.0, 2 * half));
  ExactCrack exact = crack_in(plate, 0.0, half);
  exact.normal = 1e-3;
  exact.shear = 0.3e-3;
  const Eigen::VectorXd u = plate.solve(exact);
  const TipLoad load = plate.tip_load(exact, 1, u);
  const double j = std::pow(exact.mode_one(), 2) + std::pow(exact.mode_two(), 2);
  EXPECT_NEAR(load.energy_release, j, 0.016 * j);
  EXPECT_NEAR(kink_angle(modes_of(load)) * 180.0 / M_PI, -29.0, 0.34);
  EXPECT_NEAR(kink_angle(modes_of(plate.tip_load(exact, 0, u))) * 180.0 / M_PI, -29.0, 0.34);
}

}  // namespace
}  // namespace perifrac::test
