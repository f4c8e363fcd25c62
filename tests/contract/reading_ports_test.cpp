#include <filesystem>

#include <gtest/gtest.h>

#include "app/simulation/simulation.hpp"
#include "core/state/snapshot.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac::test {
namespace {

struct Case {
  const char* scene;
  std::vector<std::string> overrides;
  int windows;
};

void PrintTo(const Case& scene, std::ostream* out) { *out << scene.scene; }

void read_all(const CouplingManager& manager) {
  for (const ModuleSlot& slot : manager.modules()) {
    for (auto id = static_cast<PortId>(slot.module->ports().size()); id-- > 0;) {
      slot.module->port(id);
      slot.module->port(id / 2);
    }
  }
}

/// The state after so many windows; all ports are read before each, and before the first exchange.
Snapshot state_after(const Case& scene, bool reads) {
  const Section section =
      read_scene(std::string(PERIFRAC_SOURCE_DIR "/configs/") + scene.scene + ".yaml",
                 scene.overrides, scene_catalogue());
  Simulation simulation = make_simulation(section);
  CouplingManager& manager = *simulation.manager;
  const auto look = [&] {
    if (reads) read_all(manager);
  };
  initialize(section, simulation);
  look();
  manager.settle();
  for (int n = 0; n < scene.windows; ++n) {
    look();
    manager.advance(simulation.end);
    if (n % 10 == 5) manager.restart_point();
  }
  Snapshot state;
  state.save([&](StateVisitor& visitor) { manager.visit_state(visitor); });
  return state;
}

class ReadingPorts : public testing::TestWithParam<Case> {};

/// Cracks ran otherwise, and past the ends of arrays, where an in-port was read that nobody writes.
TEST_P(ReadingPorts, LeavesARunAsItIs) {
  const Snapshot unread = state_after(GetParam(), false), read = state_after(GetParam(), true);
  EXPECT_EQ(unread.fields().size(), read.fields().size());
  for (const auto& [name, values] : unread.fields()) {
    EXPECT_TRUE(read.fields().at(name) == values) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReadingPorts,
                         testing::Values(Case{"three_point_bending", {}, 20},
                                         Case{"hf_storage", {"body.spacing=5 mm"}, 40},
                                         Case{"hf_leakoff_pores", {"body.spacing=5 mm"}, 20},
                                         Case{"mandel_dynamic", {"body.spacing=2 m"}, 20},
                                         Case{"mandel", {"body.spacing=2 m"}, 20},
                                         Case{"dam_break", {}, 20}),
                         [](const auto& info) { return std::string(info.param.scene); });

}  // namespace
}  // namespace perifrac::test
