#include <cmath>

#include <gtest/gtest.h>

#include "app/run/scene_keys.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/scene.hpp"
#include "core/state/snapshot.hpp"

/// Free fluid in a notch that hands over to the network in the crack at its floor.
namespace perifrac {
namespace {

struct Notch {
  explicit Notch(std::vector<std::string> overrides = {}) {
    overrides.push_back("body.spacing=2 mm");
    const Section scene =
        read_scene(PERIFRAC_SOURCE_DIR "/configs/notch_points.yaml", overrides, scene_catalogue());
    simulation = make_simulation(scene);
    initialize(scene, simulation);
  }

  CouplingManager& manager() { return *simulation.manager; }

  double scalar(const std::string& name) {
    for (const ModuleSlot& slot : manager().modules()) {
      const auto ports = slot.module->ports();
      for (std::size_t p = 0; p < ports.size(); ++p) {
        if (ports[p].direction == PortDirection::in || ports[p].name != name) continue;
        return slot.module->port(static_cast<PortId>(p)).value[0];
      }
    }
    ADD_FAILURE() << "no port " << name;
    return NAN;
  }

  Snapshot state() {
    Snapshot snapshot;
    snapshot.save([&](StateVisitor& visitor) { manager().visit_state(visitor); });
    return snapshot;
  }

  Simulation simulation;
};

/// What was in the notch and came in is there or in the crack, but for what the crack took in the
/// last window, which the points give in the next.
void expect_nothing_is_lost(Notch& notch, int windows) {
  const double start = notch.scalar("free_fluid_mass");
  double total_intake = 0.0, taken_before = 0.0;
  for (int window = 0; window < windows; ++window) {
    notch.manager().advance(1.0);
    const double intake = notch.scalar("mouth_taken") - taken_before;
    taken_before = notch.scalar("mouth_taken");
    const double there = notch.scalar("free_fluid_mass") + notch.scalar("crack_fluid_stored_mass");
    const double expected = start + notch.scalar("injected_fluid_mass") + intake;
    ASSERT_NEAR(there, expected, 1e-12 * start) << "window " << window;
    total_intake += std::abs(intake);
  }
  EXPECT_GT(total_intake, 1e-7);
  EXPECT_LE(notch.manager().ledger().mass()->relative_error, 1e-13);
}

TEST(HandOver, LosesNothingBesideASolidWithInertia) {
  Notch notch;
  expect_nothing_is_lost(notch, 1000);
}

TEST(HandOver, KeepsItsLedgerBesideASolidInEquilibrium) {
  Notch notch({"solid.type=quasi_static", "coupling.window={first: 20 us, largest: 20 us}"});
  for (int window = 0; window < 100; ++window) notch.manager().advance(1.0);
  EXPECT_GT(notch.scalar("mass_given_to_cracks"), 1e-7);
  EXPECT_LE(notch.manager().ledger().mass()->relative_error, 1e-13);
}

TEST(HandOver, GoesOnBitForBitAfterARestart) {
  Notch whole, other;
  for (int window = 0; window < 300; ++window) whole.manager().advance(1.0);
  const Snapshot middle = whole.state();
  whole.manager().restart_point();
  other.manager().advance(1.0);
  middle.restore([&](StateVisitor& visitor) { other.manager().visit_state(visitor); });
  other.manager().restart_point();
  for (int window = 0; window < 50; ++window) {
    whole.manager().advance(1.0);
    other.manager().advance(1.0);
  }
  EXPECT_EQ(other.state().fields(), whole.state().fields());
}

}  // namespace
}  // namespace perifrac
