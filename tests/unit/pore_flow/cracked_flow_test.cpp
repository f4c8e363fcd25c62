#include <cmath>
#include <complex>
#include <set>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/bonds/crack_cut.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "core/state/snapshot.hpp"
#include "tests/sanitized.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Cloud;
using test::Method;
using test::name_of;

/// Facets of a straight crack.
std::vector<CrackFacet<2>> line(const Vector<2>& from, double angle, double facet, int count) {
  const auto at = [&](int k) {
    return Vector<2>{from[0] + k * facet * std::cos(angle), from[1] + k * facet * std::sin(angle)};
  };
  std::vector<CrackFacet<2>> facets;
  for (int k = 0; k < count; ++k) facets.push_back({at(k), at(k + 1)});
  return facets;
}

/// Cuts them into the body; its points that lose bonds.
std::vector<Index> cut(BondState<2>& bonds, Family<2>& family,
                       const std::vector<CrackFacet<2>>& facets) {
  std::set<Index> points;
  for (const CrackFacet<2>& facet : facets) {
    const auto broken = bonds_cut_by<2>(facet, family, INFINITY);
    bonds.add_facet(facet, broken);
    for (const auto& [i, j] : broken) {
      silence(family, i, j);
      points.insert({i, j});
    }
  }
  return {points.begin(), points.end()};
}

std::unique_ptr<FlowOperator<2>> cracked_flow(FlowScheme scheme, const Body<2>& body,
                                              const std::vector<CrackFacet<2>>& facets,
                                              FaceSet mirrored = 0, FaceSet pressures = 0) {
  const auto intact = body.family(mirrored);
  MirrorCondition<2, 1> mirror(*intact);
  for (int face = 0; face < 4; ++face) {
    if (contains(pressures, face)) mirror.set_odd(face, 0);
  }
  auto flow = make_flow(scheme, LinearExactOperator<2, DarcyLaw<2>>(intact, mirror, {1.0}));
  const auto family = std::make_shared<Family<2>>(*intact);
  BondState<2> bonds;
  cut(bonds, *family, facets);
  flow->follow(bonds);
  return flow;
}

/// An oblique crack that leaves the body, and another that crosses it, so that some families are
/// thin.
std::vector<CrackFacet<2>> crossing_cracks() {
  std::vector<CrackFacet<2>> facets = line({-0.3, 1.6}, 0.4, 0.5, 9);
  const auto other = line({2.6, 0.9}, 1.5, 0.5, 5);
  facets.insert(facets.end(), other.begin(), other.end());
  return facets;
}

TEST(CrackedFlow, AppliesTheMatrixThatItAssembles) {
  for (const FlowScheme scheme : test::schemes) {
    for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
      const auto body = test::box_body<2>({11, 9}, 0.5, cloud);
      const auto flow = cracked_flow(scheme, *body, crossing_cracks(), 0b1110, 0b1010);
      const auto p = test::random_values(flow->size());
      std::vector<double> outflow(flow->size());
      flow->apply(p, outflow);
      const Eigen::VectorXd difference =
          flow->assemble() * test::as_eigen(p) - test::as_eigen(outflow);
      EXPECT_LT(test::largest(difference), 1e-13 * test::largest(outflow)) << name_of(scheme);
    }
  }
}

/// Symmetric; columns sum to nothing, so that mass is exact; uniform pressure alone is at rest.
TEST(CrackedFlow, KeepsMassAndLosesEnergy) {
  for (const FlowScheme scheme : test::symmetric_schemes) {
    for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
      const auto body = test::box_body<2>({11, 9}, 0.5, cloud);
      const Eigen::MatrixXd h = cracked_flow(scheme, *body, crossing_cracks())->assemble();
      const double top = h.cwiseAbs().maxCoeff();
      EXPECT_LT((h - h.transpose()).cwiseAbs().maxCoeff(), 1e-14 * top) << name_of(scheme);
      EXPECT_LT(h.colwise().sum().cwiseAbs().maxCoeff(), 1e-13 * top) << name_of(scheme);
      const Eigen::VectorXd values = symmetric_spectrum(h).values;
      EXPECT_GT(values[0], -1e-13 * top) << name_of(scheme);
      EXPECT_GT(values[1], 1e-4 * top) << name_of(scheme);
    }
  }
}

/// Gradients from one side are exact, and so is the dissipation: the patch test of a cut body.
TEST(CrackedFlow, IsExactForLinearFields) {
  const Vector<2> slope = {2.0, 1.4};
  for (const double angle : {0.0, 0.4, M_PI / 4.0}) {
    for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
      const auto body = test::box_body<2>({16, 16}, 0.5, cloud);
      const Index n = body->points().size();
      const auto facets = line({2.03, 2.51}, angle, 0.5, 7);
      const auto flow = cracked_flow(FlowScheme::conservative, *body, facets);
      std::vector<double> p(n), velocity(2 * n), outflow(n);
      double volume = 0.0, dissipated = 0.0;
      for (Index i = 0; i < n; ++i) {
        const Vector<2> x = body->points().at(i);
        p[i] = 0.3 + slope[0] * x[0] + slope[1] * x[1];
        volume += body->points().volume[i];
      }
      flow->velocity(p, velocity);
      flow->apply(p, outflow);
      for (Index i = 0; i < n; ++i) {
        EXPECT_NEAR(velocity[i], -slope[0], 1e-11);
        EXPECT_NEAR(velocity[n + i], -slope[1], 1e-11);
        dissipated += p[i] * outflow[i];
      }
      EXPECT_NEAR(dissipated, (slope[0] * slope[0] + slope[1] * slope[1]) * volume,
                  1e-12 * dissipated);
    }
  }
}

/// A crack through the whole body: neither side knows the other's pressure.
TEST(CrackedFlow, NothingCrossesACrack) {
  for (const FlowScheme scheme : test::schemes) {
    const auto body = test::box_body<2>({12, 8}, 0.5);
    const auto flow = cracked_flow(scheme, *body, line({3.0, -0.5}, M_PI / 2.0, 0.5, 10), 0b1100);
    std::vector<double> p(flow->size()), outflow(flow->size());
    for (Index i = 0; i < body->points().size(); ++i) {
      p[i] = body->points().position[0][i] < 3.0 ? 1.0 : 0.0;
    }
    flow->apply(p, outflow);
    for (const double q : outflow) EXPECT_NEAR(q, 0.0, 1e-13) << name_of(scheme);
  }
}

/// A sealed slit in a uniform flow across it: p = Im sqrt(z^2 - a^2), z along the slit. Points in
/// the outer rows are held at that. The mean error of points within a / 2 of the middle.
double error_beside_a_slit(int half, double angle) {
  const int n = 6 * half;
  const auto body = test::box_body<2>({n, n}, 1.0);
  const Points<2>& points = body->points();
  const Vector<2> middle = {0.5 * n + 0.11, 0.5 * n + 0.03};
  const double c = std::cos(angle), s = std::sin(angle);
  const auto facets = line({middle[0] - half * c, middle[1] - half * s}, angle, 1.0, 2 * half);
  const auto along = [&](Index i) {
    const double x = points.position[0][i] - middle[0], y = points.position[1][i] - middle[1];
    return std::complex<double>(c * x + s * y, -s * x + c * y);
  };
  const Eigen::SparseMatrix<double> h =
      cracked_flow(FlowScheme::conservative, *body, facets)->assemble();
  Eigen::VectorXd exact(points.size()), held = Eigen::VectorXd::Zero(points.size());
  std::vector<Eigen::Triplet<double>> ones;
  for (Index i = 0; i < points.size(); ++i) {
    const auto z = along(i);
    exact[i] = (std::sqrt(z - 1.0 * half) * std::sqrt(z + 1.0 * half)).imag();
    const double x = points.position[0][i], y = points.position[1][i];
    if (std::min({x, y, n - x, n - y}) < 3.0) {
      held[i] = exact[i];
    } else {
      ones.emplace_back(i, static_cast<Index>(ones.size()), 1.0);
    }
  }
  Eigen::SparseMatrix<double> free(points.size(), static_cast<Index>(ones.size()));
  free.setFromTriplets(ones.begin(), ones.end());
  SparseCholesky factor;
  factor.factor(free.transpose() * h * free);
  Eigen::VectorXd solution(free.cols());
  factor.solve(-(free.transpose() * (h * held)), solution);
  const Eigen::VectorXd error = held + free * solution - exact;
  double square = 0.0, count = 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    if (std::abs(along(i)) > 0.5 * half) continue;
    square += error[i] * error[i];
    ++count;
  }
  return std::sqrt(square / count);
}

/// First order: as if the slit were less than half a spacing shorter, however long it is.
TEST(CrackedFlow, GoesAroundASlit) {
  for (const double angle : {0.0, 0.4, M_PI / 4.0}) {
    for (const int half : {10, 20}) {
      if (half > 10 && test::sanitized) continue;
      const double error = error_beside_a_slit(half, angle);
      RecordProperty("slit_" + std::to_string(angle) + "_" + std::to_string(half),
                     std::to_string(error));
      EXPECT_LT(error, 0.5) << angle << " " << half;
    }
  }
}

/// A body that cracks on its way, and pore flow in it from pressures that vary.
struct CrackingRun {
  std::shared_ptr<const Body<2>> body = test::box_body<2>({14, 11}, 0.5);
  BondState<2>& bonds = body->claim_bond_state();
  Family<2> family = *body->family(0);
  DarcyFlow<2> flow;

  explicit CrackingRun(Method method)
      : flow(body, test::darcy_system<2>(*body, PoreBoundary<2>(*body)), {0.5, {0.3, -0.7}},
             test::integrator_maker<2>(method, 1e-6)) {}
  void crack(double y, int facets) { cut(bonds, family, line({0.0, y}, 0.3, 0.5, facets)); }
  StateWalk state() {
    return [this](StateVisitor& visitor) {
      flow.visit_state(visitor);
      bonds.visit_state(visitor);
    };
  }
  std::vector<double> content() {
    const auto zeta = test::port(flow, "fluid_content").value;
    return {zeta.begin(), zeta.end()};
  }
};

/// Bonds that break while pore flow runs are those that were broken when it began again.
TEST(CrackedFlow, RestartsBitForBit) {
  for (const Method method : test::methods) {
    CrackingRun whole(method), restarted(method);
    whole.crack(1.2, 4);
    whole.flow.initialize(0.0);
    whole.flow.advance({0.0, 0.2});
    whole.crack(3.6, 6);
    whole.flow.advance({0.2, 0.3});
    Snapshot snapshot;
    snapshot.save(whole.state());
    whole.flow.on_restored(0.3);

    restarted.flow.initialize(0.0);
    snapshot.restore(restarted.state());
    restarted.flow.on_restored(0.3);
    for (CrackingRun* run : {&whole, &restarted}) run->flow.advance({0.3, 0.7});
    EXPECT_EQ(whole.content(), restarted.content());
  }
}

/// A window that is taken back mends what broke in it.
TEST(CrackedFlow, RollsBackBitForBit) {
  for (const Method method : test::methods) {
    CrackingRun direct(method), twice(method);
    for (CrackingRun* run : {&direct, &twice}) {
      run->crack(1.2, 4);
      run->flow.initialize(0.0);
      run->flow.advance({0.0, 0.2});
      run->flow.on_restored(0.2);
    }
    Snapshot snapshot;
    snapshot.save(twice.state());
    twice.crack(3.6, 6);
    twice.flow.advance({0.2, 0.7});
    snapshot.restore(twice.state());
    twice.flow.on_restored(0.2);
    for (CrackingRun* run : {&direct, &twice}) run->flow.advance({0.2, 0.7});
    EXPECT_EQ(direct.content(), twice.content());
  }
}

/// What was broken on the way counts at once: both halves of a body keep what they have.
TEST(CrackedFlow, FollowsBondsThatBreak) {
  for (const Method method : test::methods) {
    CrackingRun run(method);
    run.flow.initialize(0.0);
    run.flow.advance({0.0, 0.1});
    cut(run.bonds, run.family, line({3.5, -0.5}, M_PI / 2.0, 0.5, 13));
    const auto left = [&] {
      double sum = 0.0;
      const std::vector<double> zeta = run.content();
      for (Index i = 0; i < run.body->points().size(); ++i) {
        if (run.body->points().position[0][i] < 3.5) sum += zeta[i];
      }
      return sum;
    };
    const double before = left();
    run.flow.advance({0.1, 3.0});
    EXPECT_NEAR(left(), before, 1e-12 * std::abs(before));
    const auto p = test::port(run.flow, "pore_pressure").value;
    const auto row = [&](double x) { return p[run.body->nearest_point({x, 2.75})]; };
    EXPECT_GT(std::abs(row(3.25) - row(3.75)), 0.1);
  }
}

/// The step that is stable for what is left is found anew, as if it had been broken from the start.
TEST(CrackedFlow, TheStableStepIsThatOfTheBondsLeft) {
  const Method method = Method::forward_euler;
  CrackingRun intact(method), cracking(method), cracked(method);
  for (CrackingRun* run : {&intact, &cracking}) {
    run->flow.initialize(0.0);
    run->flow.advance({0.0, 0.1});
  }
  cracking.crack(1.2, 6);
  cracking.flow.advance({0.1, 0.2});
  cracked.crack(1.2, 6);
  cracked.flow.initialize(0.0);
  cracked.flow.advance({0.0, 0.2});
  EXPECT_EQ(cracking.flow.stable_time_step(), cracked.flow.stable_time_step());
  EXPECT_NE(cracking.flow.stable_time_step(), intact.flow.stable_time_step());
}

}  // namespace
}  // namespace perifrac
