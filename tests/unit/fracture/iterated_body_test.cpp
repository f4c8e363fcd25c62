#include "modules/solid/equilibrium/iterated_body.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/body/coarse_body.hpp"
#include "core/state/snapshot.hpp"
#include "modules/solid/fracture/condensed_body.hpp"
#include "tests/unit/fracture/rock.hpp"
#include "tests/unit/fracture/round_crack.hpp"
#include "tests/unit/operators/irregular_body.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::square;

constexpr double tolerance = 1e-8;

/// The same body with the same cracks, solved for in both ways.
template <int D>
struct Both {
  std::shared_ptr<const Body<D>> body;
  SolidBoundary<D> boundary;
  std::array<BondState<D>, 2> bonds;
  std::unique_ptr<CondensedBody<D>> condensed;
  std::unique_ptr<IteratedBody<D>> iterated;

  Both(const std::array<int, D>& counts, double horizon_ratio,
       const std::vector<CrackFacet<D>>& seeds, std::optional<InitialStress<D>> stress = {},
       test::Rock rock = test::Rock::linear_exact)
      : Both(test::box_body<D>(counts, 1.0, test::Cloud::lattice, horizon_ratio), seeds, stress,
             rock) {}

  Both(std::shared_ptr<const Body<D>> in, const std::vector<CrackFacet<D>>& seeds,
       std::optional<InitialStress<D>> stress = {}, test::Rock rock = test::Rock::linear_exact)
      : body(std::move(in)), boundary(*body) {
    for (int a = 0; a < D; ++a) boundary.roller(2 * a, 0.0);
    const auto part = [&] {
      auto family = std::make_shared<Family<D>>(*body->family(boundary.mirrored()));
      const auto mirror = boundary.mirror_condition(*family);
      return std::pair(family, test::breakable<D>(rock, family, mirror, {1.0, 1.0}));
    };
    const auto free = boundary.free_unknowns(boundary.mirror_condition(*part().first));
    const auto [family, elastic] = part();
    condensed =
        std::make_unique<CondensedBody<D>>(family, 1.0, elastic, free, bonds[0], stress, seeds);
    const auto [other_family, other_elastic] = part();
    iterated = std::make_unique<IteratedBody<D>>(*body, boundary, other_family, other_elastic, free,
                                                 bonds[1], stress, seeds, tolerance);
    condensed->start();
    iterated->start();
  }

  void expect_same(const Eigen::VectorXd& pressure) {
    const auto exact = condensed->faces(pressure), faces = iterated->faces(pressure);
    const double size = std::max(exact.opening.maxCoeff(), 1e-3 * pressure.cwiseAbs().maxCoeff());
    EXPECT_EQ(faces.closed, exact.closed);
    EXPECT_LT((faces.opening - exact.opening).cwiseAbs().maxCoeff(), 20.0 * tolerance * size);
    const Eigen::VectorXd free = iterated->free_opening(pressure, faces.pressure);
    const Eigen::VectorXd contact = faces.pressure - pressure;
    EXPECT_LT((free + iterated->opening_slope() * contact - exact.opening).cwiseAbs().maxCoeff(),
              20.0 * tolerance * size)
        << "the slope's error must not show where pressures are what they are";
    const auto energies = condensed->energies(exact.pressure);
    const auto own = iterated->energies(faces.pressure);
    const double most = std::abs(energies.elastic) + std::abs(energies.relief);
    EXPECT_NEAR(own.elastic, energies.elastic, 20.0 * tolerance * most);
    EXPECT_NEAR(own.relief, energies.relief, 20.0 * tolerance * most);
    const Eigen::VectorXd u = condensed->unknowns(exact.pressure);
    EXPECT_LT((iterated->unknowns(faces.pressure) - u).norm(), 20.0 * tolerance * u.norm());
    for (Index f = 0; f < pressure.size(); ++f) {
      EXPECT_NEAR(iterated->intensity_at_fixed_volume(f) / condensed->intensity_at_fixed_volume(f),
                  1.0, 1e-5);
    }
  }
};

std::vector<CrackFacet<2>> straight_crack(const Vector<2>& from, double angle, int count) {
  std::vector<CrackFacet<2>> facets;
  const auto at = [&](int k) -> Vector<2> {
    return {from[0] + k * std::cos(angle), from[1] + k * std::sin(angle)};
  };
  for (int k = 0; k < count; ++k) facets.push_back({at(k), at(k + 1)});
  return facets;
}

std::vector<CrackFacet<3>> disc(double radius, double height) {
  std::vector<CrackFacet<3>> facets;
  for (int i = 0; i < radius; ++i) {
    for (int j = 0; j < radius; ++j) {
      if (std::hypot(i + 0.5, j + 0.5) <= radius) facets.push_back(square(i, j, height));
    }
  }
  return facets;
}

/// Pressure that falls along the crack.
Eigen::VectorXd falling(std::size_t count) {
  return Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(count), 2.0, 0.5);
}

TEST(IteratedBody, IsWhatTheFactorSaysIn2D) {
  for (const double angle : {0.0, 0.4}) {
    Both<2> both({48, 40}, 2.5, straight_crack({20.0, 20.0}, angle, 12));
    both.expect_same(falling(12));
    const CrackFacet<2> next = straight_crack({20.0, 20.0}, angle, 13).back();
    ASSERT_TRUE(both.condensed->cut(next));
    ASSERT_TRUE(both.iterated->cut(next));
    both.expect_same(falling(13));
  }
}

TEST(IteratedBody, IsWhatTheFactorSaysIn3D) {
  Both<3> both({12, 12, 12}, 2.0, disc(4.0, 6.0));
  both.expect_same(falling(both.condensed->jumps().size()));
  for (const auto& next : {square(4, 0, 6.0), square(0, 4, 6.0)}) {
    ASSERT_TRUE(both.condensed->cut(next));
    ASSERT_TRUE(both.iterated->cut(next));
  }
  both.expect_same(falling(both.condensed->jumps().size()));
}

TEST(IteratedBody, IsWhatTheFactorSaysOfIrregularClouds) {
  Both<2> plane(test::irregular_box<2>({48, 40}, 1.0, 3), straight_crack({20.0, 20.0}, 0.4, 12));
  plane.expect_same(falling(12));
  Both<3> box(
      test::irregular_box<3>({12, 12, 12}, 1.0, 3, test::Volumes::voronoi, test::Weights::plain),
      disc(4.0, 6.0));
  box.expect_same(falling(box.condensed->jumps().size()));
}

TEST(IteratedBody, SolvesForTheLinearPeridynamicSolid) {
  Both<2> both({48, 40}, 3.0, straight_crack({20.0, 20.0}, 0.0, 12), {}, test::Rock::lps);
  both.expect_same(falling(12));
}

/// Coarse levels see no farther than four of their spacings, which their answer bears.
TEST(IteratedBody, SolvesWithWideHorizons) {
  const auto body = test::box_body<2>({48, 40}, 1.0, test::Cloud::lattice, 6.0);
  EXPECT_EQ(coarsen<2>(*body, low_corner(*body)).body->horizon(), 8.0);
  Both<2> both({48, 40}, 6.0, straight_crack({20.0, 20.0}, 0.4, 12));
  both.expect_same(falling(12));
  EXPECT_LT(both.iterated->iterations(), 40);
}

/// Two thirds of the crack are pressed shut. Off the lattice's axes the slope of a body without end
/// is farther from what the lattice says.
TEST(IteratedBody, FindsContact) {
  for (const double angle : {0.0, 0.6, 1.2}) {
    Eigen::VectorXd pressure = Eigen::VectorXd::Constant(24, -1.0);
    pressure.head(8).setConstant(1.0);
    Both<2> both({48, 40}, 2.5, straight_crack({12.0, 10.0}, angle, 24));
    both.expect_same(pressure);
    EXPECT_GT(std::ranges::count(both.iterated->faces(pressure).closed, true), 2) << angle;
  }
  Both<3> box({12, 12, 12}, 2.0, disc(4.0, 6.0));
  Eigen::VectorXd part =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(box.condensed->jumps().size()), -1.0);
  part.head(4).setConstant(1.0);
  box.expect_same(part);
  EXPECT_GT(std::ranges::count(box.iterated->faces(part).closed, true), 2);
}

/// A body without end, and one solve, know the slope but for a sixth.
TEST(IteratedBody, KnowsTheSlopeOfOpeningsNearly) {
  const auto expect_near = [](auto& both, double bound) {
    const Eigen::MatrixXd exact = both.condensed->compliance();
    const Eigen::MatrixXd error = both.iterated->opening_slope() - exact;
    const double part = error.norm() / exact.norm();
    EXPECT_LT(part, bound);
    const auto one = Eigen::VectorXd::Ones(exact.cols());
    EXPECT_LT((error * one).norm(), 1e-6 * (exact * one).norm());
    EXPECT_LT((both.iterated->compliance(0, 0) - exact).norm(), 1e-6 * exact.norm());
  };
  Both<2> plane({48, 40}, 2.5, straight_crack({20.0, 20.0}, 0.0, 12));
  expect_near(plane, 0.25);
  Both<2> notched({48, 40}, 2.5, straight_crack({0.0, 20.0}, 0.0, 12));
  expect_near(notched, 0.25);
  Both<3> box({12, 12, 12}, 2.0, disc(4.0, 6.0));
  expect_near(box, 0.25);
}

TEST(IteratedBody, TakesFewerIterationsFromTheLastAnswer) {
  const auto seeds = straight_crack({20.0, 20.0}, 0.0, 12);
  Both<2> both({48, 40}, 2.5, seeds);
  IteratedBody<2>& body = *both.iterated;
  body.faces(falling(12));
  const long cold = body.iterations();
  body.faces(1.01 * falling(12));
  const long warm = body.iterations() - cold;
  EXPECT_LT(warm, cold);
}

/// As a coupling asks, pass by pass: pressures close to each other, which no crack has evenly.
TEST(IteratedBody, LearnsTheSlopeFromItsAnswers) {
  Both<2> both({48, 40}, 2.5, straight_crack({20.0, 20.0}, 0.4, 12));
  IteratedBody<2>& body = *both.iterated;
  const Eigen::MatrixXd exact = both.condensed->compliance(), before = body.opening_slope();
  for (int k = 0; k < 12; ++k) {
    Eigen::VectorXd pressure = falling(12);
    pressure[k] += 0.5;
    body.faces(pressure);
  }
  EXPECT_EQ(body.opening_slope(), before) << "one slope from pass to pass";
  body.renew_slope();
  EXPECT_LT((body.opening_slope() - exact).norm(), 0.35 * (before - exact).norm());
}

/// A window that is taken back keeps the answer and what it has learned, but not for another load.
TEST(IteratedBody, SolvesAnewForAnotherLoad) {
  Both<2> both({48, 40}, 2.5, straight_crack({20.0, 20.0}, 0.0, 12));
  const auto expect_same_under = [&](double load) {
    const auto pull = [load](const auto& body) {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(body.free_unknowns().cols());
      force.head(20).setConstant(load);
      return force;
    };
    both.condensed->set_load(pull(*both.condensed));
    both.iterated->set_load(pull(*both.iterated));
    both.expect_same(falling(12));
  };
  expect_same_under(1.0);
  Snapshot begin{false};
  const auto walk = [&](StateVisitor& visitor) { both.iterated->visit_state(visitor, true); };
  begin.save(walk);
  expect_same_under(2.0);
  begin.restore(walk);
  both.iterated->on_restored();
  expect_same_under(1.0);
  begin.restore(walk);
  both.iterated->on_restored();
  expect_same_under(2.0);
}

}  // namespace
}  // namespace perifrac
