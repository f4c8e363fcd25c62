#include "modules/pore_flow/darcy_newton_matrix.hpp"

#include <numeric>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

/// A system with everything that can stand in its matrix.
template <int D>
struct NewtonSetting {
  std::shared_ptr<const Body<D>> body = test::body_with_layer_on_top<D>(test::cube<D>(6), 0.5);
  std::vector<double> slope = test::random_values(body->points().volume.size(), 5);
  DarcySystem<D> system = make();

  DarcySystem<D> make() {
    PoreBoundary<D> boundary(*body);
    boundary.pressure(0, 0.4);
    boundary.pressure(3, -0.2);
    boundary.pressure(2 * D - 1, 0.3);  // of the layer
    boundary.source(3, 0.7);
    return test::darcy_system<D>(*body, boundary);
  }

  NewtonSetting() {
    for (double& s : slope) s = 0.2 * (1.0 + 0.5 * s);  // per point
    const std::vector<double> none(slope.size(), 0.0);
    zero = none;
    system.set_dilatation({zero, zero, slope, 0.0});
  }
  std::vector<double> zero;
};

template <int D>
void expect_inverse(typename DarcyNewtonMatrix<D>::Method method, bool exact) {
  NewtonSetting<D> setting;
  DarcySystem<D>& system = setting.system;
  DarcyNewtonMatrix<D> matrix(system, method);
  EXPECT_EQ(matrix.exact(), exact);
  const double gamma = 0.02;
  const std::vector<double> y(system.size(), 0.0), r = test::random_values(system.size());
  std::vector<double> solution(system.size()), product(system.size());
  matrix.set_up(0.0, y, gamma);
  matrix.solve(r, solution);
  // What is left out of J are the energies, which follow the flow.
  system.jacobian_times(0.0, y, solution, product);
  double residual = 0.0;
  const std::size_t followed = system.size() - 2;
  for (std::size_t k = 0; k < followed; ++k) {
    residual = std::max(residual, std::abs(solution[k] - gamma * product[k] - r[k]));
  }
  if (exact) {
    EXPECT_LT(residual, 1e-12);
  } else {
    EXPECT_LT(residual, 0.9) << "no better than doing nothing";
  }
  // Volume at the points less what came in through the faces: no solve may change it.
  double before = 0.0, after = 0.0;
  for (Index i = 0; i < system.points(); ++i) {
    before += system.volume()[i] * r[i];
    after += system.volume()[i] * solution[i];
  }
  for (std::size_t k = system.points(); k < followed; ++k) {
    before -= r[k];
    after -= solution[k];
  }
  EXPECT_NEAR(after, before, 1e-12);
}

TEST(DarcyNewtonMatrix, IsTheInverseWhenDirect) {
  expect_inverse<2>(DarcyNewtonMatrix<2>::Method::direct, true);
  expect_inverse<3>(DarcyNewtonMatrix<3>::Method::direct, true);
}

TEST(DarcyNewtonMatrix, LosesNoVolumeAsAPreconditioner) {
  expect_inverse<2>(DarcyNewtonMatrix<2>::Method::preconditioner, false);
  expect_inverse<3>(DarcyNewtonMatrix<3>::Method::preconditioner, false);
}

/// With a mobility so large that an incomplete factor alone would leave much.
template <int D>
void expect_bonds_solved() {
  NewtonSetting<D> setting;
  DarcySystem<D>& system = setting.system;
  DarcyNewtonMatrix<D> matrix(system, DarcyNewtonMatrix<D>::Method::preconditioner);
  const double gamma = 1e4;
  const std::vector<double> y(system.size(), 0.0), r = test::random_values(system.size());
  std::vector<double> solution(system.size());
  matrix.set_up(0.0, y, gamma);
  matrix.solve(r, solution);
  // zeta = S p, (V S + gamma H) p = V r, H of the bonds alone; what is held stays.
  const Index points = system.points();
  const std::span<const double> storage = system.effective_storage(0.0, y);
  Eigen::MatrixXd all =
      gamma * Eigen::MatrixXd(system.flow().preconditioner()).topLeftCorner(points, points);
  Eigen::VectorXd right_side(points);
  for (Index i = 0; i < points; ++i) right_side[i] = system.volume()[i] * r[i];
  for (const HeldPoint& held : system.held_points()) {
    all.row(held.point).setZero();
    all.col(held.point).setZero();
    right_side[held.point] = 0.0;
  }
  for (Index i = 0; i < points; ++i) all(i, i) += system.volume()[i] * storage[i];
  const Eigen::VectorXd p = all.ldlt().solve(right_side);
  std::vector<double> expected(points);
  for (Index i = 0; i < points; ++i) expected[i] = storage[i] * p[i];
  for (const HeldPoint& held : system.held_points()) expected[held.point] = r[held.point];
  // Of r, up to 1, little is left: what rounding leaves in sums of terms 1e4 as large as they are.
  for (Index i = 0; i < points; ++i) EXPECT_NEAR(solution[i], expected[i], 5e-7);
}

TEST(DarcyNewtonMatrix, SolvesTheBondsAsAPreconditioner) {
  expect_bonds_solved<2>();
  expect_bonds_solved<3>();
}

}  // namespace
}  // namespace perifrac
