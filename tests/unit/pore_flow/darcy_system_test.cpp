#include "modules/pore_flow/darcy_system.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/spectra.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

struct Setting {
  std::shared_ptr<const Body<2>> body = test::box_body<2>({11, 9}, 0.5, test::Cloud::jittered);
  DarcySystem<2> system = make();

  DarcySystem<2> make() const {
    PoreBoundary<2> boundary(*body);
    boundary.pressure(0, 0.4);
    boundary.pressure(3, -0.2);
    boundary.source(3, 0.7);
    return test::darcy_system<2>(*body, boundary);
  }
};

TEST(DarcySystem, StoresFluidByDilatationAndPressure) {
  Setting setting;
  DarcySystem<2>& system = setting.system;
  const std::size_t n = system.points();
  const auto p = test::random_values(n, 1), value = test::random_values(n, 2),
             rate = test::random_values(n, 3);
  std::vector<double> slope = test::random_values(n, 4);
  for (double& s : slope) s = std::abs(s);
  const auto [alpha, storage, mobility, density] = test::some_rock;
  const double t = 1.7, end = 2.0;
  system.set_dilatation({value, rate, slope, end});
  std::vector<double> y(system.size(), 0.0), found(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double dilatation = value[i] + rate[i] * (t - end) + slope[i] * alpha * p[i];
    y[i] = alpha * dilatation + storage * p[i];
  }
  system.pressure(t, y, found);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], p[i], 1e-14);
}

TEST(DarcySystem, RaisesTheJacobiansVersionWhenTheSlopeChanges) {
  Setting setting;
  const std::vector<double> zero(setting.system.points(), 0.0), one(zero.size(), 1.0);
  setting.system.set_dilatation({zero, zero, zero, 1.0});
  const auto first = setting.system.jacobian_version();
  setting.system.set_dilatation({one, one, zero, 2.0});
  EXPECT_EQ(setting.system.jacobian_version(), first);
  setting.system.set_dilatation({one, one, one, 2.0});
  EXPECT_GT(setting.system.jacobian_version(), first);
}

TEST(DarcySystem, GivesItsDerivative) {
  Setting setting;
  DarcySystem<2>& system = setting.system;
  const std::vector<double> zero(system.points(), 0.0), slope(system.points(), 0.3);
  system.set_dilatation({zero, zero, slope, 1.0});
  const auto y = test::random_values(system.size(), 1), v = test::random_values(system.size(), 2);
  std::vector<double> up = y, rate(system.size()), rate_up(system.size()), product(system.size());
  for (std::size_t k = 0; k < y.size(); ++k) up[k] += v[k];
  system.rhs(0.5, y, rate);
  system.rhs(0.5, up, rate_up);
  system.jacobian_times(0.5, y, v, product);
  const double scale = test::largest(product);
  for (std::size_t k = 0; k + 2 < y.size(); ++k) {
    EXPECT_NEAR(rate_up[k] - rate[k], product[k], 1e-12 * scale);
  }
}

/// The stable step comes from a bound of the largest eigenvalue, not much above it.
TEST(DarcySystem, BoundsItsFastestRate) {
  Setting setting;
  DarcySystem<2>& system = setting.system;
  const std::vector<double> zero(system.points(), 0.0), slope(system.points(), 0.3);
  system.set_dilatation({zero, zero, slope, 1.0});
  const Index n = system.points();
  Eigen::MatrixXd jacobian(n, n);
  std::vector<double> unit(system.size(), 0.0), column(system.size());
  for (Index i = 0; i < n; ++i) {
    unit[i] = 1.0;
    system.jacobian_times(0.0, {}, unit, column);
    jacobian.col(i) = test::as_eigen(column).head(n);
    unit[i] = 0.0;
  }
  const double fastest = test::eigenvalues(jacobian).cwiseAbs().maxCoeff();
  const double bound = system.fastest_rate(0.0);
  EXPECT_GT(bound, fastest);
  EXPECT_LT(bound, 1.1 * fastest);
}

TEST(DarcySystem, LosesNeitherVolumeNorEnergy) {
  Setting setting;
  DarcySystem<2>& system = setting.system;
  const auto y = test::random_values(system.size());
  std::vector<double> rate(system.size()), p(system.points());
  system.rhs(0.0, y, rate);
  system.pressure(0.0, y, p);
  const double scale = test::largest(rate);
  double stored = 0.0, power = 0.0;
  for (Index i = 0; i < system.points(); ++i) {
    stored += system.volume()[i] * rate[i];
    power += system.volume()[i] * rate[i] * p[i];
  }
  const double* const accumulated = rate.data() + system.points();
  EXPECT_NEAR(stored, accumulated[0] + accumulated[1] + 0.7, 1e-12 * scale);
  // Stored power = work on the faces + work of the source - dissipation.
  EXPECT_NEAR(power, 0.4 * accumulated[0] - 0.2 * accumulated[1] + accumulated[3] - accumulated[2],
              1e-12 * scale);
  EXPECT_GT(accumulated[2], 0.0);
  EXPECT_NEAR(accumulated[3], 0.7 * p[3], 1e-12);
}

}  // namespace
}  // namespace perifrac
