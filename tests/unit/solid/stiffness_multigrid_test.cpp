#include "modules/solid/equilibrium/stiffness_multigrid.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/base/eigen_view.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/equilibrium/stiffness_solver.hpp"
#include "tests/unit/fracture/rock.hpp"
#include "tests/unit/operators/irregular_body.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac {
namespace {

/// A body, its conditions and what its points are made of.
template <int D>
struct Case {
  std::shared_ptr<const Body<D>> body;
  SolidBoundary<D> boundary;
  std::shared_ptr<ElasticOperator<D>> elastic{};
  std::vector<CrackFacet<D>> cracks{};

  explicit Case(const std::array<int, D>& counts, double horizon_ratio = 2.0)
      : Case(test::box_body<D>(counts, 0.5, test::Cloud::lattice, horizon_ratio)) {}
  explicit Case(std::shared_ptr<const Body<D>> on) : body(std::move(on)), boundary(*body) {}

  void make(IsotropicElasticity<D> law = {1.0, 1.0}) {
    elastic = test::elastic<D>(*body, boundary, law);
  }

  /// Of bonds that facets cut.
  void make_cracked(std::vector<CrackFacet<D>> facets, IsotropicElasticity<D> law = {1.0, 1.0}) {
    const auto family = std::make_shared<Family<D>>(*body->family(boundary.mirrored()));
    const auto cracked = test::breakable<D>(test::Rock::linear_exact, family,
                                            boundary.mirror_condition(*family), law);
    for (const CrackFacet<D>& facet : facets) {
      const auto bonds = bonds_cut_by<D>(facet, *family, INFINITY);
      for (const auto& [i, j] : bonds) silence(*family, i, j);
      cracked->update(ends_of(bonds));
    }
    elastic = cracked;
    cracks = std::move(facets);
  }

  /// Rollers at the low faces, the others free.
  void on_rollers() {
    for (int a = 0; a < D; ++a) boundary.roller(2 * a, 0.0);
  }

  struct Answer {
    int iterations;
    double error;  ///< to the factor's displacement, of its norm
  };

  /// Of a force at random on every free unknown.
  Answer solve() {
    const auto family = body->family(boundary.mirrored());
    const auto mirror = boundary.mirror_condition(*family);
    const Eigen::SparseMatrix<double> free = boundary.free_unknowns(mirror);
    EXPECT_EQ(StiffnessMultigrid<D>::obstacle(free), "");
    Eigen::VectorXd load(free.rows());
    std::mt19937 bits(5);
    for (double& force : load) force = std::uniform_real_distribution<double>(-1.0, 1.0)(bits);
    StiffnessMultigrid<D> multigrid(*body, elastic, boundary, free);
    for (const CrackFacet<D>& facet : cracks) multigrid.cut(facet);
    if (!cracks.empty()) multigrid.find_largest();
    Eigen::VectorXd residual = load, u = Eigen::VectorXd::Zero(free.rows());
    multigrid.hold(residual);
    const int iterations = multigrid.correct(residual, u, 1e-10 * residual.norm());
    SparseCholesky factor;
    const Eigen::SparseMatrix<double> equations = free.transpose();
    factor.factor(Eigen::SparseMatrix<double>(equations * elastic->assemble() * free));
    Eigen::VectorXd exact(free.cols());
    factor.solve(equations * load, exact);
    return {iterations, (u - free * exact).norm() / exact.norm()};
  }
};

void expect_agreement(const auto& answer, int most_iterations) {
  EXPECT_LT(answer.error, 1e-8);
  EXPECT_LE(answer.iterations, most_iterations);
}

TEST(StiffnessMultigrid, AgreesWithTheFactorOnRollers) {
  Case<2> plane({64, 48}, 2.5);
  plane.on_rollers();
  plane.make();
  expect_agreement(plane.solve(), 16);
  Case<3> box({12, 10, 8});
  box.on_rollers();
  box.make();
  expect_agreement(box.solve(), 16);
}

/// Cells at the high faces hold fewer points then.
TEST(StiffnessMultigrid, IsWorthManyPointsOrManyBonds) {
  const auto worth = [](const std::array<int, 3>& counts, double ratio) {
    const auto body = test::box_body<3>(counts, 0.5, test::Cloud::lattice, ratio);
    return worth_of_multigrid(*body->family(0), 2e3);
  };
  EXPECT_EQ(worth({10, 10, 10}, 3.0), "");
  EXPECT_EQ(worth({10, 10, 10}, 6.0), "many bonds");
  EXPECT_EQ(worth({13, 13, 13}, 2.0), "many points");
  const auto plane = test::box_body<2>({40, 40}, 0.5, test::Cloud::lattice, 12.0);
  EXPECT_EQ(worth_of_multigrid(*plane->family(0), 2e4), "");
}

TEST(StiffnessMultigrid, TakesOddNumbersOfPoints) {
  Case<2> plane({51, 37}, 2.5);
  plane.on_rollers();
  plane.make();
  expect_agreement(plane.solve(), 16);
}

/// Coarse points are on a lattice all the same.
TEST(StiffnessMultigrid, TakesIrregularClouds) {
  Case<2> plane(test::irregular_box<2>({51, 38}, 0.5, 4));
  plane.on_rollers();
  plane.make();
  expect_agreement(plane.solve(), 20);
  for (const double jitter : {0.2, 0.4}) {
    Case<3> box(test::irregular_box<3>({10, 9, 8}, 0.5, 4, test::Volumes::voronoi,
                                       test::Weights::plain, jitter));
    box.on_rollers();
    box.make();
    expect_agreement(box.solve(), 20);
  }
}

TEST(StiffnessMultigrid, HoldsFacesPlatesAndPins) {
  Case<2> held({48, 48}, 2.5);
  held.boundary.fixed(2, {0.0, 0.0});
  held.boundary.rigid_plate(3, 1.0);
  held.make();
  expect_agreement(held.solve(), 16);
  Case<2> pinned({48, 48}, 2.5);
  const Points<2>& points = pinned.body->points();
  const Index low = pinned.body->nearest_point({0.0, 0.0});
  const Index high = pinned.body->nearest_point({24.0, 0.0});
  ASSERT_LT(points.position[0][low], points.position[0][high]);
  pinned.boundary.pin(low, 0);
  pinned.boundary.pin(low, 1);
  pinned.boundary.pin(high, 1);
  pinned.make();
  expect_agreement(pinned.solve(), 24);
}

/// Poisson's ratios of 0.45, 0.49 and 0.499: more work an iteration, not more than 40 of them.
TEST(StiffnessMultigrid, TakesRockThatIsNearlyIncompressible) {
  for (const double lambda : {9.0, 49.0, 499.0}) {
    Case<2> plane({64, 48}, 2.5);
    plane.on_rollers();
    plane.make({lambda, 1.0});
    expect_agreement(plane.solve(), 40);
    Case<3> box({12, 10, 8});
    box.on_rollers();
    box.make({lambda, 1.0});
    expect_agreement(box.solve(), 40);
  }
}

/// A stiff inclusion and a soft one.
TEST(StiffnessMultigrid, TakesContrastsOfStiffness) {
  for (const double contrast : {100.0, 0.01}) {
    Case<2> plane({64, 48}, 2.5);
    plane.on_rollers();
    LawByRegion<IsotropicElasticity<2>> laws{{{1.0, 1.0}, {contrast, contrast}}, {}};
    for (Index i = 0; i < plane.body->points().size(); ++i) {
      const Vector<2> x = plane.body->points().at(i);
      laws.law_of_point.push_back(std::hypot(x[0] - 15.0, x[1] - 11.0) < 6.0 ? 1 : 0);
    }
    const auto family = plane.body->family(plane.boundary.mirrored());
    using Laws = LawByRegion<IsotropicElasticity<2>>;
    plane.elastic = std::make_shared<LinearExactElasticity<2, Laws>>(LinearExactOperator<2, Laws>(
        family, plane.boundary.mirror_condition(*family), std::move(laws)));
    expect_agreement(plane.solve(), 25);
  }
}

/// Its coarse levels are of the linear-exact operator, whose moduli are others.
TEST(StiffnessMultigrid, SolvesForTheLinearPeridynamicSolid) {
  Case<2> plane({48, 48}, 3.0);
  plane.on_rollers();
  plane.elastic = test::lps<2>(*plane.body, plane.boundary, {1.0, 1.0});
  expect_agreement(plane.solve(), 20);
}

/// Facets of a straight crack at this angle, one spacing each.
std::vector<CrackFacet<2>> straight_crack(const Vector<2>& from, double angle, int count) {
  std::vector<CrackFacet<2>> facets;
  const auto at = [&](int k) -> Vector<2> {
    return {from[0] + 0.5 * k * std::cos(angle), from[1] + 0.5 * k * std::sin(angle)};
  };
  for (int k = 0; k < count; ++k) facets.push_back({at(k), at(k + 1)});
  return facets;
}

/// Half of the section, at a height between coarse cells and at others.
TEST(StiffnessMultigrid, SolvesForBodiesWithCracks) {
  for (const double height : {12.0, 12.5, 13.0, 11.0}) {
    Case<2> plane({64, 48}, 2.5);
    plane.on_rollers();
    plane.make_cracked(straight_crack({0.0, height}, 0.0, 32));
    expect_agreement(plane.solve(), 20);
  }
  for (const double angle : {0.3, 0.7, 1.2}) {
    Case<2> plane({64, 48}, 2.5);
    plane.on_rollers();
    plane.make_cracked(straight_crack({8.0, 5.0}, angle, 24));
    expect_agreement(plane.solve(), 20);
  }
  for (const int layer : {6, 7, 8, 9}) {
    Case<3> box({12, 12, 16});
    box.on_rollers();
    std::vector<CrackFacet<3>> facets;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 12; ++j) {
        const auto at = [&](int a, int b) -> Vector<3> { return {0.5 * a, 0.5 * b, 0.5 * layer}; };
        facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
    box.make_cracked(std::move(facets));
    expect_agreement(box.solve(), 20);
  }
}

}  // namespace
}  // namespace perifrac
