#include "modules/solid/fracture/partial_cuts.hpp"

#include <array>

#include <gtest/gtest.h>

#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

constexpr int rows_of_plate = 40, whole = 10;

struct CutPlate : CrackedPlate {
  explicit CutPlate(int count, double angle = 0.3, std::optional<InitialStress<2>> stress = {})
      : CrackedPlate(rows_of_plate, first(count, angle), 0.25, nullptr, stress) {
    cracked->set_load(Eigen::VectorXd::LinSpaced(free_count(), -1e-3, 1e-3));
  }

  static std::vector<CrackFacet<2>> first(int count, double angle) {
    const auto all = straight_crack({0.5 * rows_of_plate, 0.5 * rows_of_plate}, angle, whole);
    return {all.begin(), all.begin() + count};
  }
};

Eigen::VectorXd pressures(Eigen::Index count) {
  return Eigen::VectorXd::LinSpaced(count, 2e-3, 1e-3);
}

/// Openings and slips of all facets, one after the other.
Eigen::VectorXd jumps_of(CrackedBody<2>& body, const Eigen::VectorXd& pressure) {
  const auto jumps = body.jumps_under(pressure);
  Eigen::VectorXd all(2 * std::ssize(jumps));
  for (std::size_t f = 0; f < jumps.size(); ++f) {
    all[static_cast<Eigen::Index>(2 * f)] = jumps[f][0];
    all[static_cast<Eigen::Index>(2 * f + 1)] = jumps[f][1];
  }
  return all;
}

/// A facet that is cut in part: the body answers as between that without and with it, however the
/// crack runs across the lattice and whatever its faces are relieved of.
TEST(PartialCuts, AnswerBetweenTheBodyWithoutAndWithTheCut) {
  const InitialStress<2> stress{{-1e-3, -2e-3}};
  for (const double angle : {0.0, 0.3, 0.785}) {
    CutPlate without(whole - 1, angle, stress), with(whole - 1, angle, stress),
        part(whole - 1, angle, stress);
    const CrackFacet<2> last = CutPlate::first(whole, angle).back();
    ASSERT_TRUE(with.cracked->cut(last));
    ASSERT_TRUE(part.cracked->cut(last));
    const Eigen::VectorXd pressure = pressures(whole);
    const Eigen::VectorXd cut = jumps_of(*with.cracked, pressure);
    const Eigen::VectorXd moved = with.cracked->unknowns(pressure);
    const Eigen::VectorXd unmoved = without.cracked->unknowns(pressure.head(whole - 1));
    Eigen::VectorXd uncut = Eigen::VectorXd::Zero(2 * whole);
    uncut.head(2 * whole - 2) = jumps_of(*without.cracked, pressure.head(whole - 1));
    const Eigen::MatrixXd& c = with.cracked->compliance();
    Eigen::MatrixXd held = Eigen::MatrixXd::Zero(whole, whole);
    held.topLeftCorner(whole - 1, whole - 1) = without.cracked->compliance();
    for (const double opened : {0.0, 0.3, 1.0, 1.2}) {
      part.cracked->set_partial(std::array{PartialCut{whole - 1, opened}});
      const auto blend = [&](const auto& one, const auto& other) -> Eigen::MatrixXd {
        return opened * one + (1.0 - opened) * other;
      };
      EXPECT_LE((jumps_of(*part.cracked, pressure) - blend(cut, uncut)).cwiseAbs().maxCoeff(),
                1e-9 * cut.cwiseAbs().maxCoeff());
      EXPECT_LE((part.cracked->compliance() - blend(c, held)).cwiseAbs().maxCoeff(),
                1e-9 * c.maxCoeff());
      EXPECT_LE((part.cracked->unknowns(pressure) - blend(moved, unmoved)).cwiseAbs().maxCoeff(),
                1e-9 * moved.cwiseAbs().maxCoeff());
    }
  }
}

/// Work of load and faces, from one state to another, is what the body holds more and what the cut
/// has set free; and so the books by displacements say.
TEST(PartialCuts, SetFreeWhatTheyShould) {
  CutPlate plate(whole - 1, 0.3, InitialStress<2>{{-1e-4, -2e-4}});
  CrackedBody<2>& body = *plate.cracked;
  ASSERT_TRUE(body.cut(CutPlate::first(whole, 0.3).back()));
  const Eigen::VectorXd first = pressures(whole), last = 0.5 * first.reverse();
  struct State {
    Eigen::VectorXd opening;
    CutLoad load;
    CrackedBody<2>::Energies energies;
  };
  const auto state = [&](double opened, const Eigen::VectorXd& pressure) {
    body.set_partial(std::array{PartialCut{whole - 1, opened}});
    const Eigen::VectorXd u = body.unknowns(pressure);
    const auto energies = body.energies(pressure);
    const auto held = body.held({u.data(), static_cast<std::size_t>(u.size())}, pressure, {});
    std::vector<double> force(u.size()), dilatation(plate.family->point_count);
    plate.elastic->apply({u.data(), force.size()}, {}, force, dilatation);
    const Eigen::Map<const Eigen::VectorXd> inner(force.data(), u.size());
    EXPECT_NEAR(0.5 * u.dot(inner) + held.elastic + body.pressed_energies(pressure).elastic,
                energies.elastic, 1e-9 * energies.elastic);
    return State{body.free_opening(pressure, pressure), body.cut_loads(pressure, {})[0], energies};
  };
  const State before = state(0.2, first), after = state(0.7, last);
  double work =
      after.energies.load - before.energies.load + after.energies.relief - before.energies.relief;
  for (Eigen::Index f = 0; f < whole; ++f) {
    work +=
        0.5 * body.jumps()[f].area * (first[f] + last[f]) * (after.opening[f] - before.opening[f]);
  }
  const double stored = after.energies.elastic - before.energies.elastic;
  const double released = 0.25 * body.partial().release(0, before.load, after.load);
  EXPECT_GT(released, 0.0);
  EXPECT_NEAR(work, stored + released, 1e-9 * released);
}

/// Several at a time: symmetric, whichever comes first.
TEST(PartialCuts, DoNotDependOnTheirOrder) {
  const auto all = CutPlate::first(whole, 0.0);
  CrackedPlate plate(rows_of_plate, {all.begin() + 1, all.end() - 1}, 0.25);
  ASSERT_TRUE(plate.cracked->cut(all.front()) && plate.cracked->cut(all.back()));
  plate.cracked->set_partial(std::array{PartialCut{whole - 2, 0.4}, PartialCut{whole - 1, 0.4}});
  const Eigen::MatrixXd one = plate.cracked->compliance();
  plate.cracked->set_partial(std::array{PartialCut{whole - 1, 0.4}, PartialCut{whole - 2, 0.4}});
  EXPECT_LE((one - plate.cracked->compliance()).cwiseAbs().maxCoeff(), 1e-12 * one.maxCoeff());
  EXPECT_LE((one - one.transpose()).cwiseAbs().maxCoeff(), 1e-10 * one.maxCoeff());
  EXPECT_NEAR(one(whole - 1, whole - 1), one(whole - 2, whole - 2), 1e-9 * one.maxCoeff());
}

/// What friction solves with: of all axes, told as a change of few columns.
TEST(PartialCuts, ChangeWhatTheCutBodyAnswersByFewColumns) {
  const auto all = CutPlate::first(whole, 0.3);
  CrackedPlate plate(rows_of_plate, {all.begin() + 1, all.end() - 1}, 0.25);
  CrackedBody<2>& body = *plate.cracked;
  ASSERT_TRUE(body.cut(all.front()) && body.cut(all.back()));
  const auto stacked = [&] {
    Eigen::MatrixXd all_axes(2 * whole, 2 * whole);
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        all_axes.block(a * whole, b * whole, whole, whole) = body.compliance(a, b);
      }
    }
    return all_axes;
  };
  const Eigen::MatrixXd cut = stacked();
  EXPECT_EQ(body.compliance_change().right.size(), 0);
  body.set_partial(std::array{PartialCut{whole - 2, 0.4}, PartialCut{whole - 1, 0.9}});
  EXPECT_EQ(body.whole_compliance(), cut);
  const LowRankChange change = body.compliance_change();
  Eigen::MatrixXd left(2 * whole, change.right.cols());
  left << change.basis * change.of_basis, change.left;
  const Eigen::MatrixXd held = stacked();
  EXPECT_GT((held - cut).cwiseAbs().maxCoeff(), 0.1 * cut.maxCoeff());
  EXPECT_LE((cut + left * change.right.transpose() - held).cwiseAbs().maxCoeff(),
            1e-12 * cut.maxCoeff());
}

}  // namespace
}  // namespace perifrac::test
