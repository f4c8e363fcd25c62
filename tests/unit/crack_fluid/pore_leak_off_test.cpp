#include "modules/crack_fluid/pore_leak_off.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "core/body/body.hpp"
#include "coupling/coupling_keys.hpp"
#include "coupling/manager.hpp"
#include "tests/contract/scene_text.hpp"
#include "tests/port_named.hpp"

namespace perifrac {
namespace {

/// A strip of rock, cut across in its middle by a crack that is held under pressure.
const std::string strip = R"(
dimension: 2
body: {shape: box, size: [60 m, 4 m], spacing: 1 m}
time: {end: 1 s}
pore_flow:
  type: darcy
  permeability: 1e-15 m^2
  porosity: 0.2
  biot_coefficient: 1
  grain_bulk_modulus: 1e9 GPa
  fluid: {bulk_modulus: 2.2 GPa, viscosity: 1 mPa s}
  integrator: {tolerance: 1e-7}
crack_fluid:
  type: network
  viscosity: 1 mPa s
  bulk_modulus: 2.2 GPa
  residual_aperture: 1 mm
  leak_off: pores
  filled:
    - {from: [0 m, 0 m], to: [60 m, 4 m], pressure: 1 MPa}
  inlets:
    - {name: pump, at: [30 m, 2 m], holds: pressure, pressure: 1 MPa}
)";
constexpr double storage = 0.2 / 2.2e9;
constexpr double mobility = 1e-12;
constexpr double pressure = 1e6;
constexpr double density = 1000.0;

/// Cuts the bonds of the body across x, facet by facet.
void cut(const Body<2>& body, double x, int facets) {
  const auto family = body.family(0);
  std::vector<std::vector<std::pair<Index, Index>>> bonds(facets);
  for (Index i = 0; i < family->point_count; ++i) {
    for (const auto& bond : family->bonds(i)) {
      const Index j = bond.other;
      const Vector<2> a = body.points().at(i), b = body.points().at(j);
      if (j < i || (a[0] < x) == (b[0] < x)) continue;
      const double y = a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
      bonds[std::min(static_cast<int>(y / body.spacing()), facets - 1)].emplace_back(i, j);
    }
  }
  BondState<2>& state = body.claim_bond_state();
  for (int f = 0; f < facets; ++f) {
    const double dx = body.spacing();
    state.add_facet({{{x, f * dx}, {x, (f + 1) * dx}}}, bonds[f]);
  }
}

struct LeakingStrip {
  std::unique_ptr<CouplingManager> manager;
  double time = 0.0;

  explicit LeakingStrip(const std::vector<std::string>& overrides = {}) {
    const Section scene = read_scene_text(strip, overrides);
    const AnyBody body = make_body(scene.at("body"), 2);
    cut(*std::get<0>(body), 30.0, 4);
    std::vector<ModuleSlot> modules;
    for (const std::string& physics : physics_of(scene)) {
      modules.push_back({physics, make_module(scene, physics, body)});
    }
    manager = std::make_unique<CouplingManager>(std::move(modules),
                                                read_coupling_options(scene.at("coupling"), 1e6));
    manager->initialize(0.0);
    manager->settle();
  }
  void advance(double length, int windows) {
    const double begin = time;
    for (int k = 1; k <= windows; ++k) {
      const double end = begin + length * k / windows;
      while (time < end) time = manager->advance(end);
    }
  }
  double scalar(int module, const std::string& name) {
    return test::port_named(*manager->modules()[module].module, name).value[0];
  }
  double leaked() { return -scalar(0, "leaked_crack_fluid_mass"); }
};

/// What a half-space takes per area while its surface is held under pressure, twice.
double both_sides(double t) {
  return density * 4.0 * pressure * std::sqrt(mobility * storage * t / std::numbers::pi);
}

class PoreLeakOffFrom : public testing::TestWithParam<const char*> {};

/// A seventh of a spacing lies between crack and pores; more at first, when the front is within the
/// horizon.
TEST_P(PoreLeakOffFrom, IsThatOfTwoHalfSpaces) {
  LeakingStrip run({std::string("crack_fluid.type=") + GetParam()});
  const double of_a_spacing = 8.0 * density * storage * pressure;
  double lacking_before = INFINITY;
  for (int k = 0; k < 5; ++k) {
    run.advance(500.0, 25);
    const double lacking = 4.0 * both_sides(run.time) - run.leaked();
    EXPECT_LT(std::abs(lacking), 0.3 * of_a_spacing) << run.time;
    EXPECT_LT(lacking, lacking_before) << run.time;
    lacking_before = lacking;
    EXPECT_LT(run.manager->ledger().mass()->relative_error, 1e-14);
    EXPECT_LT(run.manager->ledger().energy()->relative_error, 7.8e-5);
  }
  EXPECT_NEAR(lacking_before, of_a_spacing / 7.0, 0.006 * of_a_spacing);
}

INSTANTIATE_TEST_SUITE_P(Fluids, PoreLeakOffFrom, testing::Values("network", "uniform_pressure"));

/// The pores' answer is in: windows of four times what explicit diffusion bears in one pass, and of
/// twenty times that where passes are repeated until they agree.
TEST(PoreLeakOff, HoldsInLongWindows) {
  LeakingStrip one_pass, iterated({"coupling.iterations.max=60"});
  one_pass.advance(2500.0, 25);
  iterated.advance(2500.0, 5);
  const double expected = 4.0 * both_sides(2500.0);
  EXPECT_NEAR(one_pass.leaked(), expected, 0.035 * expected);
  EXPECT_NEAR(iterated.leaked(), expected, 0.042 * expected);
}

/// Two of the four facets that cross the strip; pressure spreads behind them all the same.
TEST(PoreLeakOff, PassesNoSealedWalls) {
  LeakingStrip all, half({"crack_fluid.sealed=[{from: [0 m, 0 m], to: [60 m, 2 m]}]"});
  LeakingStrip none({"crack_fluid.sealed=[{from: [0 m, 0 m], to: [60 m, 4 m]}]"});
  for (LeakingStrip* run : {&all, &half, &none}) run->advance(100.0, 10);
  EXPECT_EQ(none.leaked(), 0.0);
  EXPECT_GT(half.leaked(), 0.5 * all.leaked());
  EXPECT_LT(half.leaked(), 0.9 * all.leaked());
  EXPECT_LT(half.manager->ledger().mass()->relative_error, 1e-14);
}

TEST(PoreLeakOff, GoesBothWays) {
  LeakingStrip out, in({"pore_flow.initial_pressure=1 MPa", "crack_fluid.filled=[]",
                        "crack_fluid.inlets=[{name: pump, at: [30 m, 2 m], holds: pressure, "
                        "pressure: 0 Pa}]"});
  out.advance(500.0, 20);
  in.advance(500.0, 20);
  EXPECT_NEAR(in.leaked(), -out.leaked(), 1.8e-4 * out.leaked());
  EXPECT_LT(in.manager->ledger().mass()->relative_error, 1e-14);
}

}  // namespace
}  // namespace perifrac
