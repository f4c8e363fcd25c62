// Solids whose law is not linear or has a memory: in equilibrium by Newton's method, and in motion.
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "modules/solid/material/nonlinear_elasticity.hpp"
#include "tests/unit/solid/moving_solid.hpp"
#include "tests/unit/solid/nonlinear_laws.hpp"

namespace perifrac {
namespace {

using test::Hardening, test::Stiffening;
using test::lambda, test::mu, test::Solid;

template <int D>
constexpr IsotropicElasticity<D> plain{lambda, mu};
template <int D>
constexpr Stiffening<D> stiffening{plain<D>, 3e4};
template <int D>
constexpr Hardening<D> hardening{plain<D>, 0.02, 1.0};

template <int D, class Law>
std::shared_ptr<ElasticOperator<D>> material(const Body<D>& body, const SolidBoundary<D>& boundary,
                                             const Law& law) {
  const auto family = body.family(boundary.mirrored());
  return std::make_shared<NonlinearElasticity<D, Law>>(
      family, boundary.mirror_condition(*family),
      LawByRegion<Law>{{law}, std::vector<std::uint8_t>(family->point_count, 0)}, std::nullopt,
      law.stiffening());
}

template <int D, class Law>
void start(Solid<D>& solid, const Law& law, const SolverChoice& choice = {}) {
  solid.module = std::make_unique<QuasiStaticSolid<D>>(
      solid.body, material<D>(*solid.body, solid.boundary, law), solid.boundary, choice);
  solid.module->initialize(0.0);
}

template <class Module>
Snapshot saved(Module& module) {
  Snapshot state;
  state.save([&](StateVisitor& visitor) { module.visit_state(visitor); });
  return state;
}

template <int D>
double volume(const Body<D>& body) {
  const auto& volumes = body.points().volume;
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

/// All faces move as the gradient of displacement says, which is the answer.
template <int D>
void expect_uniform_answer(int count) {
  Solid<D> solid(test::cube<D>(count));
  Vector<D> slope;
  Tensor<D, D> gradient{};
  for (int a = 0; a < D; ++a) {
    gradient[a * D + a] = slope[a] = 0.02 - 0.015 * a;
    solid.boundary.roller(2 * a, 0.0);
    solid.boundary.roller(2 * a + 1, slope[a] * count * 0.5);
  }
  start(solid, stiffening<D>);
  solid.step();
  EXPECT_LT(solid.error(slope), 6e-12);
  const double energy = volume(*solid.body) * stiffening<D>.energy(gradient);
  EXPECT_NEAR(solid.port("elastic_energy").value[0], energy, 1e-12 * energy);
  const auto stress = solid.port("effective_stress").value;
  const auto expected = stiffening<D>.stress(gradient);
  for (int k = 0; k < D * D; ++k) {
    EXPECT_NEAR(stress[k * solid.points()], expected[k], 7e-12);
  }
}

TEST(NonlinearSolid, IsUniformWhereItsFacesAre) {
  expect_uniform_answer<2>(9);
  expect_uniform_answer<3>(6);
}

/// Between rollers, pulled along the first axis.
template <int D>
Solid<D> pulled(int count, double pull, const Schedule& schedule = {}) {
  Solid<D> solid(test::cube<D>(count));
  for (int face = 0; face < 2 * D; ++face) {
    if (face != 1) solid.boundary.roller(face, 0.0);
  }
  Vector<D> traction{};
  traction[0] = pull;
  solid.boundary.traction(1, traction, schedule);
  return solid;
}

template <int D>
void expect_stretch_under_a_pull() {
  constexpr double stretch = 0.02;
  Tensor<D, D> gradient{};
  gradient[0] = stretch;
  Vector<D> slope{};
  slope[0] = stretch;
  Solid<D> solid = pulled<D>(8, stiffening<D>.stress(gradient)[0]);
  start(solid, stiffening<D>);
  solid.step();
  EXPECT_LT(solid.error(slope), 1e-10);
  EXPECT_GT(stiffening<D>.stress(gradient)[0], 1.5 * plain<D>.stress(gradient)[0]) << "is linear";
}

TEST(NonlinearSolid, StretchesAsItsLawSays) {
  expect_stretch_under_a_pull<2>();
  expect_stretch_under_a_pull<3>();
}

/// Held at its left end, sheared and bent by its weight: no strain is like another.
Solid<2> beam(int count, const Schedule& schedule = {}) {
  Solid<2> solid({2 * count, count}, 5.0 / count);
  solid.boundary.fixed(0, {});
  solid.boundary.body_force({2e-3, -3e-3}, schedule);
  return solid;
}

TEST(NonlinearSolid, BalancesItsWeightWhicheverWayItsStiffnessAtRestIsSolvedFor) {
  std::vector<std::vector<double>> found;
  for (const auto kind : {SolverChoice::Kind::direct, SolverChoice::Kind::multigrid}) {
    Solid<2> solid = beam(16);
    start(solid, stiffening<2>, {.kind = kind});
    solid.step();
    const auto u = solid.port("displacement").value;
    found.emplace_back(u.begin(), u.end());
    const auto force = solid.external_force();
    const double weight = 3e-3 * volume(*solid.body);
    double sum = 0.0;
    for (Index i = 0; i < solid.points(); ++i) sum += force[solid.points() + i];
    double reaction = 0.0;
    for (std::size_t k = 2 * solid.points(); k < force.size(); ++k) reaction += std::abs(force[k]);
    EXPECT_GT(reaction, weight);
    EXPECT_NEAR(sum, -weight, 1e-9 * weight);
  }
  const double largest = test::largest(found[0]);
  for (std::size_t k = 0; k < found[0].size(); ++k) {
    EXPECT_NEAR(found[0][k], found[1][k], 1e-9 * largest);
  }
}

TEST(NonlinearSolid, SaysWhereItDoesNotResist) {
  constexpr Stiffening<2> softening{plain<2>, -1e6};
  Solid<2> solid = pulled<2>(8, 0.5);
  start(solid, softening);
  EXPECT_THROW(solid.step(), NumericalError);
}

/// Of plain<D> between rollers: the stretch by a pull that rises, in closed form, beyond the yield.
template <int D>
double plastic_stretch(double pull) {
  const Hardening<D>& law = hardening<D>;
  const double part = std::sqrt(1.0 - 1.0 / D);  // of a unit stretch that is deviator
  const double softer = 2.0 * mu / (2.0 * mu + law.hardening);
  return (pull - softer * part * law.yield) / (lambda + 2.0 * mu - 2.0 * mu * softer * part * part);
}

template <int D>
void expect_flow_and_return() {
  constexpr double pull = 0.15;
  Solid<D> solid = pulled<D>(8, pull, Schedule::table({0.0, 10.0, 20.0}, {0.0, 1.0, 0.9}));
  start(solid, hardening<D>);
  for (int n = 0; n < 10; ++n) solid.step();
  Vector<D> slope{};
  slope[0] = plastic_stretch<D>(pull);
  EXPECT_LT(solid.error(slope), 1e-10) << "loaded";
  EXPECT_GT(slope[0], 1.1 * pull / (lambda + 2.0 * mu)) << "does not flow";
  for (int n = 0; n < 10; ++n) solid.step();
  slope[0] -= 0.1 * pull / (lambda + 2.0 * mu);
  EXPECT_LT(solid.error(slope), 1e-10) << "unloaded";
}

TEST(NonlinearSolid, FlowsAndComesBackElastically) {
  expect_flow_and_return<2>();
  expect_flow_and_return<3>();
}

/// What of the work is neither stored nor heat.
double energy_error(int windows) {
  Solid<2> solid = beam(8, Schedule::ramp(1.0));
  solid.boundary.traction(1, {0.0, -0.02}, Schedule::ramp(1.0));
  start(solid, hardening<2>);
  for (int n = 0; n < windows; ++n) solid.step(1.0 / windows);
  const double heat = solid.port("material_heat").value[0];
  const double work = solid.port("external_work").value[0];
  EXPECT_GT(heat, 0.05 * work);
  return std::abs(work - heat - solid.port("elastic_energy").value[0]) / work;
}

TEST(NonlinearSolid, TurnsIntoHeatWhatItDoesNotStore) {
  const double coarse = energy_error(20), fine = energy_error(40);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.6 * coarse);
}

TEST(NonlinearSolid, GoesOnFromASnapshotWithTheSameBits) {
  Solid<2> solid = beam(6);
  solid.boundary.traction(1, {0.0, -0.02}, Schedule::ramp(4.0));
  start(solid, hardening<2>);
  for (int n = 0; n < 2; ++n) solid.step();
  const Snapshot middle = saved(*solid.module);
  for (int n = 0; n < 2; ++n) solid.step();
  const Snapshot end = saved(*solid.module);
  Solid<2> again = beam(6);
  again.boundary.traction(1, {0.0, -0.02}, Schedule::ramp(4.0));
  start(again, hardening<2>);
  middle.restore([&](StateVisitor& visitor) { again.module->visit_state(visitor); });
  again.module->on_restored(2.0);
  again.time = 2.0;
  for (int n = 0; n < 2; ++n) again.step();
  EXPECT_TRUE(saved(*again.module).fields() == end.fields());
}

/// A bar that is pulled for a while: its end swings, and its rock flows.
test::Moving<2> swinging(double safety) {
  test::Moving<2> bar({20, 6}, 0.5);
  bar.safety = safety;
  for (const int face : {0, 2, 3}) bar.boundary.roller(face, 0.0);
  bar.boundary.traction(1, {0.1, 0.0}, Schedule::ramp(4.0));
  bar.module = std::make_unique<DynamicSolid<2>>(bar.body,
                                                 material<2>(*bar.body, bar.boundary, hardening<2>),
                                                 bar.boundary, test::density, 0.0, safety);
  bar.module->initialize(0.0);
  return bar;
}

double energy_error_in_motion(double safety) {
  test::Moving<2> bar = swinging(safety);
  for (int n = 0; n < 20; ++n) bar.advance(1.0);
  EXPECT_GT(bar.value("material_heat"), 0.05 * bar.value("external_work"));
  return std::abs(bar.energy_error() + bar.value("material_heat")) / bar.value("external_work");
}

TEST(NonlinearSolid, TurnsIntoHeatInMotionToo) {
  const double coarse = energy_error_in_motion(0.4), fine = energy_error_in_motion(0.1);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(NonlinearSolid, SwingsOnFromASnapshotWithTheSameBits) {
  test::Moving<2> bar = swinging(0.9), again = swinging(0.9);
  for (int n = 0; n < 5; ++n) bar.advance(1.0);
  const Snapshot middle = saved(*bar.module);
  for (int n = 0; n < 5; ++n) bar.advance(1.0);
  middle.restore([&](StateVisitor& visitor) { again.module->visit_state(visitor); });
  again.module->on_restored(5.0);
  again.time = 5.0;
  for (int n = 0; n < 5; ++n) again.advance(1.0);
  EXPECT_TRUE(saved(*again.module).fields() == saved(*bar.module).fields());
}

}  // namespace
}  // namespace perifrac
