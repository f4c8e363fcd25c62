#include "modules/pore_flow/boundary/pore_boundary.hpp"

#include <gtest/gtest.h>

#include "core/solvers/sparse_cholesky.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

/// Steady pressure: H p = sources, with prescribed pressures on the face values.
template <int D>
Eigen::VectorXd steady_pressure(const Body<D>& body, const PoreBoundary<D>& boundary) {
  const auto flow = test::flow_operator<D>(body, boundary, 0.7);
  const Index n = body.points().size();
  const Eigen::SparseMatrix<double> h = flow.assemble();
  const Eigen::VectorXd faces = boundary.face_pressures(flow.mirror()).at(0.0);
  Eigen::VectorXd right_side = -h.topRightCorner(n, faces.size()) * faces;
  if (boundary.has_sources()) right_side += boundary.sources(test::force_of(flow)).at(0.0);
  SparseCholesky factor;
  factor.factor(Eigen::SparseMatrix<double>(h.topLeftCorner(n, n)));
  Eigen::VectorXd p(n);
  factor.solve(right_side, p);
  return p;
}

template <int D>
void expect_linear(const Body<D>& body, const Eigen::VectorXd& p, int axis, double at_low,
                   double slope) {
  for (Index i = 0; i < body.points().size(); ++i) {
    ASSERT_NEAR(p[i], at_low + slope * body.points().position[axis][i], 1e-12);
  }
}

template <int D>
void expect_linear_steady_states(int count) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.5);
  const double length = count * 0.5;
  for (int axis = 0; axis < D; ++axis) {
    PoreBoundary<D> between(*body);
    between.pressure(2 * axis, 0.3);
    between.pressure(2 * axis + 1, -0.9);
    expect_linear<D>(*body, steady_pressure<D>(*body, between), axis, 0.3, -1.2 / length);

    PoreBoundary<D> through(*body);
    through.pressure(2 * axis, 0.3);
    through.flux(2 * axis + 1, 0.14);
    expect_linear<D>(*body, steady_pressure<D>(*body, through), axis, 0.3, 0.14 / 0.7);
  }
}

TEST(PoreBoundary, HoldsALinearPressureBetweenPressuresAndInflow) {
  expect_linear_steady_states<2>(9);
  expect_linear_steady_states<3>(8);
}

TEST(PoreBoundary, BringsWhatIsPrescribed) {
  const auto body = test::box_body<3>({10, 10, 11}, 0.5);
  PoreBoundary<3> boundary(*body);
  EXPECT_FALSE(boundary.has_sources());
  boundary.flux(5, 0.14);
  boundary.source(7, 2.0);
  EXPECT_TRUE(boundary.has_sources());
  const auto flow = test::flow_operator<3>(*body, boundary, 1.0);
  EXPECT_NEAR(boundary.sources(test::force_of(flow)).at(0.0).sum(), 0.14 * 25.0 + 2.0, 1e-12);
}

}  // namespace
}  // namespace perifrac
