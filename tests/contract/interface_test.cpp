#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/simulation/simulation.hpp"
#include "tests/contract/fake_modules.hpp"
#include "tests/contract/scene_text.hpp"

/// Solids and pore flow beside a stand-in for the free fluid: what they take from it.
namespace perifrac {
namespace {

using fake::Tank;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

struct Scene {
  std::string name;
  std::string text;
  std::vector<std::string> overrides{};
};

/// Runs with a tank in the place of `fluid`.
std::unique_ptr<CouplingManager> beside_tank(const Scene& scene, int iterations = 1) {
  std::vector<std::string> overrides = scene.overrides;
  overrides.push_back("coupling.iterations.max=" + std::to_string(iterations));
  const Section section = read_scene_text(scene.text, overrides);
  const AnyBody body = make_body(section.at("body"), section.integer("dimension"));
  const PointSet& points =
      std::visit([](const auto& b) -> const PointSet& { return b->point_set(); }, body);
  std::vector<ModuleSlot> modules;
  modules.push_back({"fluid", std::make_unique<Tank>(&points, 5e5, 1e3)});
  for (const std::string& physics : physics_of(section)) {
    modules.push_back({physics, make_module(section, physics, body)});
  }
  CouplingOptions options = fake::even_windows(1e-3);
  options.max_iterations = iterations;
  options.tolerance = 1e-4;
  auto manager = std::make_unique<CouplingManager>(std::move(modules), options);
  manager->initialize(0.0);
  manager->settle();
  return manager;
}

const std::vector<Scene>& flows() {
  static const std::vector<Scene> scenes = {
      {"cvode", box_2d + quasi_static_2d + darcy},
      {"cvode_3d", box_3d + quasi_static_3d + darcy},
      {"dynamic", box_2d + dynamic_2d + darcy},
      {"krylov", box_2d + darcy, {"pore_flow.integrator.linear_solver=krylov"}},
      {"explicit", box_2d + rigid + darcy, {"pore_flow.integrator.type=explicit"}},
      {"explicit_beside_dynamic",
       box_2d + dynamic_2d + darcy,
       {"pore_flow.integrator.type=explicit"}},
      {"tait", box_2d + quasi_static_2d + darcy, {"pore_flow.fluid.equation_of_state=tait"}},
      {"tait_explicit",
       box_2d + quasi_static_2d + darcy,
       {"pore_flow.fluid.equation_of_state=tait", "pore_flow.integrator.type=explicit"}},
      {"layers", box_2d + rigid + darcy, {"body.boundary={left: layer, right: layer, top: layer}"}},
      {"layers_explicit",
       box_2d + rigid + darcy,
       {"body.boundary={left: layer, right: layer, top: layer}",
        "pore_flow.integrator.type=explicit"}},
      {"finite_volume", box_2d + quasi_static_2d + finite_volume},
      {"finite_volume_explicit",
       box_3d + quasi_static_3d + finite_volume,
       {"pore_flow.integrator.type=explicit"}},
      {"schedule",
       box_2d + rigid + darcy,
       {"pore_flow.boundary.right.schedule={times: [11.3 ms, 12.7 ms, 13 ms], factors: [1, -1, "
        "1]}"}},
  };
  return scenes;
}

TEST(Interface, NoFluidIsLostBetweenTankAndPores) {
  for (const Scene& scene : flows()) {
    const auto manager = beside_tank(scene);
    for (int window = 0; window < 100; ++window) manager->advance(1.0);
    const auto mass = manager->ledger().mass();
    ASSERT_TRUE(mass.has_value());
    EXPECT_LE(mass->relative_error, 1e-13) << scene.name;
    EXPECT_GT(std::abs(manager->modules()[0].module->port(5).value[0]), 0.01)
        << scene.name << ": nothing flowed";
  }
}

/// What smoothing makes in a hundred windows, and what the ledger lacks.
std::array<double, 2> made_by_smoothing(const std::string& compensation) {
  const auto manager =
      beside_tank({"smoothed",
                   box_2d + rigid + darcy,
                   {"pore_flow.operator=nested", "pore_flow.integrator.type=explicit",
                    "pore_flow.nested.compensation=" + compensation,
                    "pore_flow.boundary.left={type: sealed}"}});
  for (int window = 0; window < 100; ++window) manager->advance(1.0);
  PhysicsModule& pores = *manager->modules()[1].module;
  const auto ports = pores.ports();
  const auto artificial = std::ranges::find(ports, PortRole::mass_artificial, &Port::role);
  const double made = pores.port(static_cast<PortId>(artificial - ports.begin())).value[0];
  return {made, manager->ledger().mass().value().error};
}

/// Smoothing makes and loses fluid, and says how much.
TEST(Interface, NoFluidIsLostBesideWhatSmoothingMakes) {
  const auto [made, error] = made_by_smoothing("none");
  EXPECT_GT(std::abs(made), 1e-6);
  EXPECT_NEAR(error, made, 1e-12);
}

TEST(Interface, NoFluidIsMadeWhereNeighboursMakeUpForSmoothing) {
  const auto [made, error] = made_by_smoothing("neighbours");
  EXPECT_NEAR(made, 0.0, 1e-13);
  EXPECT_NEAR(error, 0.0, 1e-12);
}

TEST(Interface, ConnectsWhatIsThereAndNoMore) {
  const auto names = [](const std::string& text) {
    std::vector<std::string> names;
    const auto manager = beside_tank({"", text});
    for (const Link& link : manager->links()) names.push_back(link.path());
    return names;
  };
  EXPECT_THAT(names(box_2d + rigid), UnorderedElementsAre());
  EXPECT_THAT(names(box_2d + dynamic_2d), UnorderedElementsAre("fluid.interface_impulse -> solid",
                                                               "solid.displacement -> fluid"));
  const std::vector<std::string> exchange = {"fluid.exchanged_mass -> pore_flow",
                                             "pore_flow.pore_pressure -> fluid",
                                             "pore_flow.pore_mobility -> fluid"};
  EXPECT_THAT(names(box_2d + rigid + darcy), testing::UnorderedElementsAreArray(exchange));
  const auto all = names(box_2d + quasi_static_2d + darcy);
  EXPECT_EQ(all.size(), 7u);
  EXPECT_THAT(all, IsSupersetOf(exchange));
}

TEST(Interface, ARunThatWasRestartedGoesOnBitForBit) {
  for (const Scene& scene : flows()) {
    for (const int iterations : {1, 30}) {
      if (iterations > 1 && scene.name != "cvode" && scene.name != "layers_explicit") continue;
      const auto state = [](CouplingManager& manager) {
        Snapshot snapshot;
        snapshot.save([&](StateVisitor& visitor) { manager.visit_state(visitor); });
        return snapshot;
      };
      const auto whole = beside_tank(scene, iterations);
      for (int window = 0; window < 5; ++window) whole->advance(1.0);
      const Snapshot middle = state(*whole);
      whole->restart_point();
      const auto other = beside_tank(scene, iterations);
      other->advance(1.0);
      middle.restore([&](StateVisitor& visitor) { other->visit_state(visitor); });
      other->restart_point();
      for (CouplingManager* manager : {whole.get(), other.get()}) {
        for (int window = 0; window < 5; ++window) manager->advance(1.0);
      }
      EXPECT_EQ(state(*other).fields(), state(*whole).fields()) << scene.name;
    }
  }
}

}  // namespace
}  // namespace perifrac
