// The module of docs/add_a_module.md, alone and in a coupled run.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "app/run/scene_keys.hpp"
#include "core/config/scene.hpp"
#include "coupling/coupling_keys.hpp"
#include "coupling/manager.hpp"
#include "docs/example_module/compaction.hpp"
#include "modules/pore_flow/darcy_type.hpp"
#include "tests/contract/module_contract.hpp"

namespace perifrac {
namespace {

/// The keys of every scene, with the new module's beside them.
Catalogue catalogue() {
  Catalogue all = scene_catalogue();
  const ModuleType type = compaction_type();
  all.push_back({type.section, type.name, type.keys, type.meaning});
  return all;
}

Section read(const std::vector<std::string>& overrides = {}) {
  return read_scene(PERIFRAC_SOURCE_DIR "/docs/example_module/compaction.yaml", overrides,
                    catalogue());
}

std::unique_ptr<PhysicsModule> make_compaction() {
  const Section scene = read();
  return compaction_type().make(scene.at("solid"), make_body(scene.at("body"), 2));
}

INSTANTIATE_TEST_SUITE_P(Compaction, ModuleContract,
                         testing::Values(ModuleCase{
                             "Compaction", make_compaction, 1.0, {{"pore_stress", 1e5}}}),
                         case_name);

/// The layer of the scene in figures, and Terzaghi's solution for it.
struct Consolidation {
  double storage = 0.2 / 2.2e9 + (0.9 - 0.2) / 36e9;
  double mobility = 10 * 9.869233e-16 / 1e-3;
  double stiffness = 1.2e9;
  double alpha = 0.9;
  double length = 40.0;
  double total_storage = storage + alpha * alpha / stiffness;
  double initial_pressure = alpha * 1e6 / stiffness / total_storage;
  double diffusivity = mobility / total_storage;

  double dimensionless_time(double t) const { return diffusivity * t / (length * length); }

  /// Sealed at x = 0, drained at x = length.
  double pressure(double x, double t) const {
    double sum = 0.0;
    for (int n = 0; n < 200; ++n) {
      const double root = (n + 0.5) * std::numbers::pi;
      sum += (n % 2 == 0 ? 2.0 : -2.0) / root * std::cos(root * x / length) *
             std::exp(-root * root * dimensionless_time(t));
    }
    return initial_pressure * sum;
  }
};

struct Layer {
  std::shared_ptr<const Body<2>> body;
  std::unique_ptr<CouplingManager> manager;

  explicit Layer(const std::vector<std::string>& overrides) {
    const Section scene = read(overrides);
    const AnyBody any = make_body(scene.at("body"), 2);
    body = std::get<std::shared_ptr<const Body<2>>>(any);
    std::vector<ModuleSlot> modules;
    modules.push_back({"pore_flow", darcy_type().make(scene.at("pore_flow"), any)});
    modules.push_back({"solid", compaction_type().make(scene.at("solid"), any)});
    const CouplingOptions options =
        read_coupling_options(scene.at("coupling"), scene.number("time.end"));
    manager = std::make_unique<CouplingManager>(std::move(modules), options);
    manager->initialize(0.0);
    manager->settle();
  }

  double pressure_error() const {
    const Consolidation exact;
    PhysicsModule& flow = *manager->modules()[0].module;
    double largest = 0.0;
    for (std::size_t id = 0; id < flow.ports().size(); ++id) {
      if (flow.ports()[id].name != "pore_pressure") continue;
      const auto pressure = flow.port(static_cast<PortId>(id)).value;
      for (Index i = 0; i < body->points().size(); ++i) {
        const double expected = manager->time() > 0.0
                                    ? exact.pressure(body->points().position[0][i], manager->time())
                                    : exact.initial_pressure;
        largest = std::max(largest, std::abs(pressure[i] - expected));
      }
    }
    return largest / exact.initial_pressure;
  }
};

class CompactionScheme : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(CompactionScheme, ConsolidatesAsTerzaghiSays) {
  Layer layer(GetParam());
  EXPECT_LE(layer.pressure_error(), 1e-9) << "undrained";
  for (const double time : {0.1, 0.3, 1.0}) {
    const double t = time / Consolidation{}.dimensionless_time(1.0);
    while (layer.manager->time() < t) layer.manager->advance(t);
    EXPECT_LE(layer.pressure_error(), 2e-3) << "T = " << time;
  }
  EXPECT_LE(layer.manager->ledger().mass()->relative_error, 1e-12);
  EXPECT_LE(layer.manager->ledger().energy()->relative_error, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Schemes, CompactionScheme,
                         testing::Values(std::vector<std::string>{},
                                         std::vector<std::string>{
                                             "pore_flow.integrator.type=explicit"}));

}  // namespace
}  // namespace perifrac
