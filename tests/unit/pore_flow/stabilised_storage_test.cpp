#include "modules/pore_flow/storage/stabilised_storage.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/bonds/crack_cut.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Cloud;

constexpr double biot_coefficient = 0.8;
constexpr double point_storage = 0.03;
constexpr double strength = 0.25;

/// Storage on a box, and the slope of a dilatation that differs from point to point.
template <int D>
struct StabilisedSetting {
  std::shared_ptr<const Body<D>> body;
  std::vector<double> value, rate, slope;
  std::unique_ptr<PoreStorage> stored;

  StabilisedSetting(const std::array<int, D>& counts, Cloud cloud)
      : body(test::box_body<D>(counts, 0.5, cloud)),
        value(test::random_values(points(), 2)),
        rate(test::random_values(points(), 3)),
        slope(test::random_values(points(), 4)),
        stored(make()) {
    for (double& s : slope) s = 0.4 * (1.0 + 0.5 * s);
    stored->set_dilatation({value, rate, slope, 2.0});
  }

  std::size_t points() const { return body->points().volume.size(); }

  std::unique_ptr<PoreStorage> make() const {
    PoreMaterials materials{{{biot_coefficient, 0.2, 0.0, point_storage}},
                            std::vector<std::uint8_t>(points(), std::uint8_t{0})};
    return std::make_unique<StabilisedStorage<D>>(std::move(materials), body->family(0), strength,
                                                  body->spacing());
  }

  /// What it adds to the points' own storage.
  Eigen::MatrixXd between() const {
    const auto n = static_cast<Index>(points());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setIdentity();
    stored->add_pattern_to(matrix);
    const auto entries = matrix.nonZeros();
    stored->add_to(matrix, 0.0, {}, body->points().volume);
    EXPECT_EQ(matrix.nonZeros(), entries) << "no room had been made";
    Eigen::MatrixXd result = matrix;
    const auto own = stored->effective_storage(0.0, {});
    for (Index i = 0; i < n; ++i) result(i, i) -= 1.0 + body->points().volume[i] * own[i];
    return result;
  }
};

template <int D>
std::vector<StabilisedSetting<D>> settings() {
  std::array<int, D> counts;
  for (int a = 0; a < D; ++a) counts[a] = D == 2 ? 9 - a : 6 - a / 2;
  std::vector<StabilisedSetting<D>> all;
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) all.emplace_back(counts, cloud);
  return all;
}

/// Mass is exact, energy is never negative, and linear pressures, at surfaces too, know nothing of
/// it: the patch test.
template <int D>
void expect_roughness(const StabilisedSetting<D>& setting) {
  const Eigen::MatrixXd b = setting.between();
  const double top = b.cwiseAbs().maxCoeff();
  const auto n = static_cast<Index>(setting.points());
  EXPECT_LT((b - b.transpose()).cwiseAbs().maxCoeff(), 1e-14 * top);
  EXPECT_LT(b.colwise().sum().cwiseAbs().maxCoeff(), 1e-13 * top);
  for (int a = 0; a < D; ++a) {
    Eigen::VectorXd p(n);
    for (Index i = 0; i < n; ++i) p[i] = 1.0 + setting.body->points().position[a][i];
    EXPECT_LT(test::largest(Eigen::VectorXd(b * p)), 1e-12 * top);
  }
  const Eigen::VectorXd values = symmetric_spectrum(b).values;
  EXPECT_GT(values[0], -1e-13 * top);
  EXPECT_GT(values[D + 1], 1e-3 * top) << "more than the linear pressures is left out";
}

TEST(StabilisedStorage, IsMadeOfWhatLinearPressuresDoNotHave) {
  for (const auto& setting : settings<2>()) expect_roughness(setting);
  for (const auto& setting : settings<3>()) expect_roughness(setting);
}

TEST(StabilisedStorage, FindsThePressureThatItStores) {
  for (StabilisedSetting<2>& setting : settings<2>()) {
    const std::size_t n = setting.points();
    const Eigen::MatrixXd b = setting.between();
    const auto p = test::random_values(n, 1), dp = test::random_values(n, 6);
    const double t = 1.7;
    const Eigen::VectorXd held = b * test::as_eigen(p), added = b * test::as_eigen(dp);
    std::vector<double> zeta(n), change(n), found(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double own = point_storage + biot_coefficient * biot_coefficient * setting.slope[i];
      const double theta = setting.value[i] + setting.rate[i] * (t - 2.0);
      zeta[i] = biot_coefficient * theta + own * p[i] + held[i] / setting.body->points().volume[i];
      change[i] = own * dp[i] + added[i] / setting.body->points().volume[i];
    }
    setting.stored->pressure(t, zeta, found);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], p[i], 1e-13);
    setting.stored->pressure_change(t, zeta, change, found, PoreStorage::to_rounding);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], dp[i], 1e-13);
    EXPECT_GT(test::largest(held), 1e-2 * test::largest(zeta)) << "nothing to be found";
  }
}

/// What it found before the content changed is where it begins, and nothing else; where the
/// dilatation is another, or bonds break, it is forgotten.
TEST(StabilisedStorage, FindsThePressureAfterAChange) {
  for (StabilisedSetting<2>& setting : settings<2>()) {
    const std::size_t n = setting.points();
    const auto before = test::random_values(n, 7), after = test::random_values(n, 8);
    std::vector<double> found(n), expected(n);
    const auto expect_the_same = [&] {
      const auto fresh = setting.make();
      fresh->set_dilatation({setting.value, setting.rate, setting.slope, 2.0});
      fresh->pressure(1.0, after, expected);
      setting.stored->pressure(1.0, after, found);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], expected[i], 1e-13);
    };
    setting.stored->pressure(1.0, before, found);
    expect_the_same();
    for (double& value : setting.value) value += 0.5;
    setting.stored->set_dilatation({setting.value, setting.rate, setting.slope, 2.0});
    expect_the_same();
  }
}

/// Its energy is what forcing fluid in takes while the dilatation stands.
TEST(StabilisedStorage, HasTheEnergyOfTheWorkDone) {
  for (StabilisedSetting<2>& setting : settings<2>()) {
    const auto p = test::random_values(setting.points(), 1);
    const Eigen::VectorXd held = setting.between() * test::as_eigen(p);
    const double work = 0.5 * test::as_eigen(p).dot(held);
    EXPECT_NEAR(setting.stored->energy_between_points(p), work, 1e-14);
    EXPECT_GT(work, 1e-3);
  }
}

/// The bonds that a crack along x cuts, through the body.
std::vector<BrokenBond> cut_at(const Body<2>& body, double x) {
  std::vector<BrokenBond> broken;
  const auto family = body.family(0);
  const CrackFacet<2> facet = {{{x, -1.0}, {x, 100.0}}};
  for (const auto& [i, j] : bonds_cut_by<2>(facet, *family, INFINITY))
    broken.push_back({i, j, no_facet});
  return broken;
}

TEST(StabilisedStorage, KnowsNothingAcrossBrokenBonds) {
  for (StabilisedSetting<2>& setting : settings<2>()) {
    const Eigen::MatrixXd intact = setting.between();
    setting.stored->take_bonds(cut_at(*setting.body, 2.0));
    const Eigen::MatrixXd cut = setting.between();
    const std::vector<double>& x = setting.body->points().position[0];
    double crossed = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) {
        if ((x[i] < 2.0) == (x[j] < 2.0)) continue;
        EXPECT_EQ(cut(i, j), 0.0);
        crossed = std::max(crossed, std::abs(intact(i, j)));
      }
    }
    EXPECT_GT(crossed, 1e-3);
    EXPECT_LT(cut.colwise().sum().cwiseAbs().maxCoeff(), 1e-13 * cut.cwiseAbs().maxCoeff());
    setting.stored->take_bonds({});  // a state from before is restored
    EXPECT_EQ(setting.between(), intact);
  }
}

/// A body whose left face holds a pressure, and the equations of flow in it.
struct Flow {
  std::shared_ptr<const Body<2>> body = test::box_body<2>({11, 9}, 0.5, Cloud::jittered);
  std::vector<double> zero, slope;
  DarcySystem<2> system;

  explicit Flow(FlowScheme scheme)
      : zero(body->points().volume.size(), 0.0), slope(zero.size(), 0.3), system(make(scheme)) {
    system.set_dilatation({zero, zero, slope, 1.0});
  }

  DarcySystem<2> make(FlowScheme scheme) const {
    PoreBoundary<2> boundary(*body);
    boundary.pressure(0, 0.4);
    boundary.source(3, 0.7);
    auto flow = test::flow_operator<2>(*body, boundary, 0.7);
    const ScheduledVector pressures = boundary.face_pressures(flow.mirror());
    const ScheduledVector sources = boundary.sources(test::force_of(flow));
    PoreMaterials materials{{{biot_coefficient, 0.2, 0.0, point_storage}},
                            std::vector<std::uint8_t>(zero.size(), std::uint8_t{0})};
    return {make_flow(scheme, std::move(flow)),
            std::make_unique<StabilisedStorage<2>>(std::move(materials), body->family(0), strength,
                                                   body->spacing()),
            PoreFluid{.bulk_modulus = 1.0, .viscosity = 1.0, .density = 1.5}, pressures, sources};
  }
};

TEST(StabilisedStorage, TakesPartInTheSystemsDerivative) {
  for (const FlowScheme scheme : test::symmetric_schemes) {
    Flow flow(scheme);
    DarcySystem<2>& system = flow.system;
    const auto y = test::random_values(system.size(), 1), v = test::random_values(system.size(), 2);
    std::vector<double> moved(y), here(y.size()), there(y.size()), product(y.size());
    for (std::size_t k = 0; k < y.size(); ++k) moved[k] += v[k];
    system.rhs(0.5, y, here);
    system.rhs(0.5, moved, there);
    system.jacobian_times(0.5, y, v, product);
    const double top = test::largest(product);
    for (std::size_t k = 0; k < system.size() - 2; ++k) {  // energies are left out
      EXPECT_NEAR(there[k] - here[k], product[k], 1e-12 * top) << k;
    }
  }
}

TEST(StabilisedStorage, TakesPartInNewtonsMatrix) {
  for (const FlowScheme scheme : test::symmetric_schemes) {
    Flow flow(scheme);
    DarcySystem<2>& system = flow.system;
    const auto y = test::random_values(system.size(), 1), v = test::random_values(system.size(), 2);
    std::vector<double> solution(y.size()), product(y.size());
    DarcyFactor<2> newton(system);
    for (const double gamma : {0.02, 0.5}) {
      newton.set_up(0.5, y, gamma);
      newton.solve(v, solution);
      system.jacobian_times(0.5, y, solution, product);
      for (std::size_t k = 0; k < system.size() - 2; ++k) {
        EXPECT_NEAR(solution[k] - gamma * product[k], v[k], 1e-12) << k;
      }
    }
  }
}

/// Bonds that break in the body break for what is stored too.
TEST(StabilisedStorage, FollowsTheBodysBonds) {
  Flow flow(FlowScheme::conservative);
  const std::vector<double>& x = flow.body->points().position[0];
  std::vector<double> y(flow.system.size(), 0.0), p(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] < 2.0 ? std::sin(9.0 * x[i]) : 0.0;
  const auto largest_beyond = [&] {
    flow.system.pressure(0.0, y, p);
    double largest = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (x[i] > 2.0) largest = std::max(largest, std::abs(p[i]));
    }
    return largest;
  };
  EXPECT_GT(largest_beyond(), 1e-3);
  std::vector<std::pair<Index, Index>> pairs;
  for (const BrokenBond& bond : cut_at(*flow.body, 2.0)) pairs.emplace_back(bond.i, bond.j);
  BondState<2> bonds;
  bonds.break_bonds(pairs);
  flow.system.follow(bonds);
  EXPECT_EQ(largest_beyond(), 0.0);
}

}  // namespace
}  // namespace perifrac
