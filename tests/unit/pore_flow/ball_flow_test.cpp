#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/solvers/sparse_cholesky.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Method;

double radius(const Vector<2>& x) { return std::hypot(x[0], x[1]); }
double radius(const Vector<3>& x) { return std::hypot(x[0], x[1], x[2]); }

/// Flow of unit mobility in an octant of the unit ball, its surface drained or sealed.
template <int D>
struct Octant {
  std::shared_ptr<const Body<D>> body;
  Eigen::SparseMatrix<double> flow;
  Eigen::VectorXd volume;
  Index points;

  Octant(double cells, bool drained) : body(test::ball_body<D>(1.0, 1.0 / cells, true)) {
    PoreBoundary<D> boundary(*body);
    if (drained) boundary.pressure(D, 0.0);
    flow = test::flow_operator<D>(*body, boundary, 1.0).assemble();
    volume = test::as_eigen(body->points().volume);
    points = body->points().size();
  }

  Eigen::VectorXd field(const std::function<double(double)>& of_radius) const {
    Eigen::VectorXd values(points);
    for (Index i = 0; i < points; ++i) values[i] = of_radius(radius(body->points().at(i)));
    return values;
  }

  double norm(const Eigen::VectorXd& p) const { return std::sqrt(p.dot(volume.cwiseProduct(p))); }
};

/// Solves (H + diagonal) p = right_side at the points, face values 0.
template <int D>
Eigen::VectorXd solve(const Octant<D>& octant, const Eigen::VectorXd& diagonal,
                      const Eigen::VectorXd& right_side) {
  Eigen::SparseMatrix<double> matrix = octant.flow.topLeftCorner(octant.points, octant.points);
  for (Index i = 0; i < octant.points; ++i) matrix.coeffRef(i, i) += diagonal[i];
  SparseCholesky factor;
  factor.factor(matrix);
  Eigen::VectorXd p(octant.points);
  factor.solve(right_side, p);
  return p;
}

template <int D>
void expect_constants_at_rest(bool octant) {
  const auto body = test::ball_body<D>(1.0, D == 2 ? 0.08 : 0.17, octant);
  const int surface = static_cast<int>(body->faces().size()) - 1;
  for (const bool drained : {false, true}) {
    PoreBoundary<D> boundary(*body);
    if (drained) boundary.pressure(surface, 3.0);
    auto flow = test::flow_operator<D>(*body, boundary, 1.0);
    const std::vector<double> p(flow.size(), 3.0);
    std::vector<double> outflow(flow.size());
    flow.apply(p, outflow);
    EXPECT_LT(test::largest(outflow), 1e-12 * flow.assemble().diagonal().maxCoeff());
  }
}

TEST(BallFlow, LeavesConstantsAtRest) {
  for (const bool octant : {false, true}) {
    expect_constants_at_rest<2>(octant);
    expect_constants_at_rest<3>(octant);
  }
}

/// Largest error of the gradient of r - 1, which the odd image keeps but for its curvature.
template <int D>
double slope_error(double cells) {
  const auto body = test::ball_body<D>(1.0, 1.0 / cells, true);
  PoreBoundary<D> boundary(*body);
  boundary.pressure(D, 0.0);
  auto flow = test::flow_operator<D>(*body, boundary, 1.0);
  const Index points = body->points().size();
  std::vector<double> p(flow.size(), 0.0), gradient(D * points);
  for (Index i = 0; i < points; ++i) p[i] = radius(body->points().at(i)) - 1.0;
  flow.gradient(p, gradient);
  double largest = 0.0;
  for (Index i = 0; i < points; ++i) {
    const double r = radius(body->points().at(i));
    if (r < 0.5) continue;
    for (int a = 0; a < D; ++a) {
      const double exact = body->points().position[a][i] / r;
      largest = std::max(largest, std::abs(gradient[a * points + i] - exact));
    }
  }
  return largest;
}

TEST(BallFlow, KeepsRadialSlopesAtTheSurface) {
  for (const double cells : {8.0, 16.0, 32.0}) EXPECT_LT(slope_error<2>(cells), 1.0 / cells);
  for (const double cells : {8.0, 16.0}) EXPECT_LT(slope_error<3>(cells), 1.5 / cells);
}

/// A uniform source flows out through the surface: p = (1 - r^2) / 2D, and all of it comes out.
template <int D>
double source_error(double cells) {
  const Octant<D> octant(cells, true);
  const Eigen::VectorXd p = solve(octant, Eigen::VectorXd::Zero(octant.points), octant.volume);
  const double inflow = (octant.flow.bottomLeftCorner(1, octant.points) * p)[0];
  EXPECT_NEAR(-inflow, octant.volume.sum(), 1e-11 * octant.volume.sum());
  const Eigen::VectorXd exact = octant.field([](double r) { return (1.0 - r * r) / (2 * D); });
  return octant.norm(p - exact) / octant.norm(exact);
}

/// Steady flow from a core of r < 1/2, where the pressure is prescribed, to the surface: p = 1/r -
/// 1 in 3D, -ln r in 2D. Errors of pressure and of what comes out.
template <int D>
std::array<double, 2> shell_errors(double cells) {
  const Octant<D> octant(cells, true);
  const Eigen::VectorXd exact =
      octant.field([](double r) { return D == 2 ? -std::log(r) : 1.0 / r - 1.0; });
  const double hold = 1e8 * octant.flow.diagonal().maxCoeff();
  const Eigen::VectorXd core = octant.field([&](double r) { return r < 0.5 ? hold : 0.0; });
  const Eigen::VectorXd p = solve(octant, core, core.cwiseProduct(exact));
  const double outflow = -(octant.flow.bottomLeftCorner(1, octant.points) * p)[0];
  return {octant.norm(p - exact) / octant.norm(exact),
          std::abs(outflow / (0.5 * std::numbers::pi) - 1.0)};
}

/// The slowest mode of a drained ball decays with pi^2 in 3D and the square of Bessel's first root
/// in 2D; error of what inverse iteration finds.
template <int D>
double decay_error(double cells) {
  const Octant<D> octant(cells, true);
  SparseCholesky factor;
  factor.factor(
      Eigen::SparseMatrix<double>(octant.flow.topLeftCorner(octant.points, octant.points)));
  Eigen::VectorXd mode = octant.field([](double r) { return 1.0 - r * r; }), next(octant.points);
  double rate = 0.0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    factor.solve(octant.volume.cwiseProduct(mode), next);
    rate = octant.norm(mode) / octant.norm(next);
    mode = next;
  }
  const double exact = D == 2 ? std::pow(2.404825557695773, 2) : std::pow(std::numbers::pi, 2);
  return std::abs(rate / exact - 1.0);
}

/// A sealed ball with the source 1 - (D + 2)/D r^2, which adds up to nothing:
/// p = -r^2/2D + r^4/4D but for a constant.
template <int D>
double sealed_error(double cells) {
  const Octant<D> octant(cells, false);
  const auto without_mean = [&](Eigen::VectorXd p) {
    p.array() -= p.dot(octant.volume) / octant.volume.sum();
    return p;
  };
  const Eigen::VectorXd source =
      without_mean(octant.field([](double r) { return 1.0 - (D + 2.0) / D * r * r; }));
  const Eigen::VectorXd exact =
      without_mean(octant.field([](double r) { return (std::pow(r, 4) - 2 * r * r) / (4 * D); }));
  // The tiny storage chooses the constant.
  const Eigen::VectorXd p =
      without_mean(solve<D>(octant, 1e-9 * octant.volume, octant.volume.cwiseProduct(source)));
  return octant.norm(p - exact) / octant.norm(exact);
}

/// Errors stay below limit / cells^order; recorded for the reader.
void expect_order(const std::string& what, double order, double limit,
                  const std::vector<double>& cells, const std::function<double(double)>& error) {
  for (const double n : cells) {
    const double e = error(n);
    ::testing::Test::RecordProperty(fmt::format("{}_{}", what, n), fmt::format("{:.2e}", e));
    EXPECT_LT(e, limit / std::pow(n, order)) << what << " at " << n << " cells";
  }
}

TEST(BallFlow, ConvergesUnderADrainedSurface) {
  expect_order("source_2D", 1.5, 0.8, {8, 12, 16, 24, 32}, source_error<2>);
  expect_order("source_3D", 1.5, 0.6, {6, 8, 12, 16}, source_error<3>);
  expect_order("decay_2D", 1.5, 0.2, {8, 12, 16, 24, 32}, decay_error<2>);
  expect_order("decay_3D", 2.0, 0.8, {6, 8, 12, 16}, decay_error<3>);
}

TEST(BallFlow, ConvergesInAShell) {
  expect_order("shell_2D", 1.5, 0.3, {8, 16, 24, 32},
               [](double n) { return shell_errors<2>(n)[0]; });
  expect_order("shell_3D", 1.5, 0.2, {8, 12, 16}, [](double n) { return shell_errors<3>(n)[0]; });
  expect_order("out_of_shell_2D", 1.5, 0.15, {8, 16, 24, 32},
               [](double n) { return shell_errors<2>(n)[1]; });
  expect_order("out_of_shell_3D", 1.5, 0.2, {8, 12, 16},
               [](double n) { return shell_errors<3>(n)[1]; });
}

TEST(BallFlow, ConvergesUnderASealedSurface) {
  expect_order("sealed_2D", 1.5, 0.7, {8, 12, 16, 24, 32}, sealed_error<2>);
  expect_order("sealed_3D", 1.5, 0.6, {6, 8, 12, 16}, sealed_error<3>);
}

/// Drained at its surface, a ball loses what comes out there, to rounding, by every integrator.
template <int D>
void expect_mass_kept(bool octant) {
  const auto body = test::ball_body<D>(1.0, D == 2 ? 0.1 : 0.2, octant);
  PoreBoundary<D> boundary(*body);
  boundary.pressure(static_cast<int>(body->faces().size()) - 1, 0.1);
  for (const Method method : {Method::forward_euler, Method::direct, Method::krylov}) {
    DarcyFlow<D> flow(body, test::darcy_system<D>(*body, boundary), {1.0},
                      test::integrator_maker<D>(method, 1e-5));
    flow.initialize(0.0);
    const double before = test::scalar(flow, "pore_fluid_mass");
    flow.advance({0.0, 0.02});
    flow.advance({0.02, 0.1});
    const double gained = test::scalar(flow, "pore_fluid_gained");
    EXPECT_LT(gained, -0.2 * before);
    EXPECT_NEAR(test::scalar(flow, "pore_fluid_mass") - before, gained, 1e-12 * before);
  }
}

TEST(BallFlow, KeepsItsMass) {
  for (const bool octant : {false, true}) {
    expect_mass_kept<2>(octant);
    expect_mass_kept<3>(octant);
  }
}

}  // namespace
}  // namespace perifrac
