#include "app/references/solutions/cryer_solution.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "tests/unit/references/semi_discrete.hpp"

namespace perifrac {
namespace {

constexpr double load = 1e6;

/// A ball of 10 m with K = 1 GPa; storage 0 is incompressible constituents.
CryerProblem ball(double poisson_ratio, double biot_coefficient, double storage) {
  constexpr double bulk = 1e9;
  return {.bulk_modulus = bulk,
          .shear_modulus = 1.5 * bulk * (1.0 - 2.0 * poisson_ratio) / (1.0 + poisson_ratio),
          .biot_coefficient = biot_coefficient,
          .storage = storage,
          .mobility = 1e-9,
          .radius = 10.0,
          .load = load};
}

/// Biot's equations on spherical shells: displacements at their surfaces from the energy, pressures
/// in them; nothing is known of how dilatation follows pressure.
class Shells {
 public:
  explicit Shells(const CryerProblem& problem) : h_(problem.radius / shells) {
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(shells, shells);
    Eigen::MatrixXd coupling = stiffness;
    Eigen::MatrixXd storage = stiffness;
    Eigen::MatrixXd flow = stiffness;
    for (int i = 0; i < shells; ++i) {
      const double inner = i * h_;
      const double outer = inner + h_;
      const double volume = (std::pow(outer, 3) - std::pow(inner, 3)) / 3.0;  // over 4 pi
      Eigen::VectorXd radial = Eigen::VectorXd::Zero(shells);
      Eigen::VectorXd hoop = radial;
      Eigen::VectorXd dilatation = radial;
      const auto add = [&](int surface, double r, double sign) {
        if (surface < 0) return;  // the middle does not move
        radial(surface) = sign / h_;
        hoop(surface) = 0.5 / (inner + 0.5 * h_);
        dilatation(surface) = sign * r * r / volume;
      };
      add(i - 1, inner, -1.0);
      add(i, outer, 1.0);
      // The mean dilatation of the shell and the difference of its strains: so a uniform pressure
      // is in equilibrium to round-off.
      const Eigen::VectorXd shear = radial - hoop;
      stiffness += volume * (problem.bulk_modulus * dilatation * dilatation.transpose() +
                             4.0 / 3.0 * problem.shear_modulus * shear * shear.transpose());
      coupling.col(i) = problem.biot_coefficient * volume * dilatation;
      storage(i, i) = volume * problem.storage;
      if (i > 0) test::add_flow(flow, i - 1, i, problem.mobility * inner * inner / h_);
    }
    flow(shells - 1, shells - 1) += 2.0 * problem.mobility * std::pow(problem.radius, 2) / h_;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(shells);
    force(shells - 1) = -problem.load * std::pow(problem.radius, 2);
    const Eigen::LLT<Eigen::MatrixXd> factor(stiffness);
    const Eigen::MatrixXd capacity = storage + coupling.transpose() * factor.solve(coupling);
    // Undrained: no shell gains fluid.
    start_ = capacity.llt().solve(-coupling.transpose() * factor.solve(force));
    discrete_.emplace(capacity, flow, start_);
    last_row_ = factor.solve(coupling).row(shells - 1);
    loaded_ = factor.solve(force)(shells - 1);
  }
  static constexpr int shells = 160;
  double radius(int i) const { return (i + 0.5) * h_; }
  const Eigen::VectorXd& start() const { return start_; }
  Eigen::VectorXd pressures(double t) const { return discrete_->at(t); }
  double surface_displacement(const Eigen::VectorXd& p) const { return loaded_ + last_row_.dot(p); }

 private:
  double h_;
  Eigen::VectorXd start_;
  Eigen::RowVectorXd last_row_;
  double loaded_ = 0.0;
  std::optional<test::SemiDiscrete> discrete_;
};

class CryerBall : public testing::TestWithParam<CryerProblem> {};

TEST_P(CryerBall, AgreesWithShells) {
  const CryerProblem problem = GetParam();
  const CryerSolution cryer(problem);
  const Shells shells(problem);
  const double p0 = cryer.initial_pressure();
  EXPECT_NEAR(shells.start()(0), p0, 1e-6 * p0);
  for (const double T : {0.003, 0.01, 0.03, 0.06, 0.1, 0.3, 1.0}) {
    const double t = T * cryer.time_scale();
    const Eigen::VectorXd p = shells.pressures(t);
    for (int i = 0; i < Shells::shells; i += 7) {
      EXPECT_NEAR(cryer.pressure(shells.radius(i), t), p(i), 2e-3 * p0) << T << ' ' << i;
    }
    EXPECT_NEAR(cryer.surface_displacement(t), shells.surface_displacement(p),
                1e-3 * std::abs(cryer.surface_displacement(t)));
  }
}

TEST_P(CryerBall, PeaksAsTheInnermostShellDoes) {
  const CryerSolution cryer(GetParam());
  const Shells shells(GetParam());
  const auto peak = cryer.peak();
  EXPECT_NEAR(shells.pressures(peak.time)(0), peak.pressure, 1e-3 * peak.pressure);
  for (const double factor : {0.8, 1.25}) {
    EXPECT_LT(shells.pressures(factor * peak.time)(0), peak.pressure);
  }
}

TEST_P(CryerBall, StartsUndrainedAndEndsDrained) {
  const CryerProblem problem = GetParam();
  const CryerSolution cryer(problem);
  EXPECT_NEAR(cryer.pressure(5.0, 1e-5 * cryer.time_scale()), cryer.initial_pressure(),
              0.02 * cryer.initial_pressure());
  EXPECT_NEAR(cryer.pressure(10.0, 0.1 * cryer.time_scale()), 0.0, 1e-9 * load);
  // Undrained: alpha theta + S p = 0.
  EXPECT_NEAR(problem.biot_coefficient * 3.0 * cryer.surface_displacement(0.0) / problem.radius +
                  problem.storage * cryer.initial_pressure(),
              0.0, 1e-12);
  EXPECT_NEAR(cryer.surface_displacement(20.0 * cryer.time_scale()),
              -load * problem.radius / (3.0 * problem.bulk_modulus), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Rocks, CryerBall,
                         testing::Values(ball(0.0, 1.0, 0.0), ball(0.25, 1.0, 0.0),
                                         ball(0.25, 0.7, 4e-10), ball(0.4, 1.0, 1e-9)));

TEST(CryerSolution, OvershootGrowsAsTheRockResistsShear) {
  // Incompressible constituents: p0 is the load. At nu = 1/2 the rock has no shear stiffness, and
  // nothing is handed inwards.
  EXPECT_NEAR(CryerSolution(ball(0.0, 1.0, 0.0)).initial_pressure(), load, 1e-6);
  EXPECT_NEAR(CryerSolution(ball(0.499999, 1.0, 0.0)).peak().pressure / load, 1.0, 1e-3);
  double before = 2.0;
  for (const double nu : {0.0, 0.1, 0.2, 0.3, 0.4}) {
    const double peak = CryerSolution(ball(nu, 1.0, 0.0)).peak().pressure / load;
    EXPECT_LT(peak, before);
    before = peak;
  }
}

}  // namespace
}  // namespace perifrac
