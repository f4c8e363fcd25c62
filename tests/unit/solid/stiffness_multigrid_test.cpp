#include "modules/solid/equilibrium/stiffness_multigrid.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/base/eigen_view.hpp"
#include "core/solvers/sparse_cholesky.hpp"
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

  explicit Case(const std::array<int, D>& counts, double horizon_ratio = 2.0)
      : body(test::box_body<D>(counts, 0.5, test::Cloud::lattice, horizon_ratio)),
        boundary(*body) {}

  void make(IsotropicElasticity<D> law = {1.0, 1.0}) {
    elastic = test::elastic<D>(*body, boundary, law);
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
    EXPECT_EQ(StiffnessMultigrid<D>::obstacle(*body, free), "");
    Eigen::VectorXd load(free.rows());
    std::mt19937 bits(5);
    for (double& force : load) force = std::uniform_real_distribution<double>(-1.0, 1.0)(bits);
    StiffnessMultigrid<D> multigrid(*body, elastic, boundary, free);
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
TEST(StiffnessMultigrid, TakesOddNumbersOfPoints) {
  Case<2> plane({51, 37}, 2.5);
  plane.on_rollers();
  plane.make();
  expect_agreement(plane.solve(), 16);
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

TEST(StiffnessMultigrid, TakesMoreIterationsWhereRockIsNearlyIncompressible) {
  Case<2> plane({64, 48}, 2.5);
  plane.on_rollers();
  plane.make({24.0, 1.0});  // a Poisson's ratio of 0.48
  expect_agreement(plane.solve(), 40);
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

}  // namespace
}  // namespace perifrac
