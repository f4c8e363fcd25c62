#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/module/physics_module.hpp"
#include "core/state/snapshot.hpp"

/// What every physics module owes the coupling manager, whatever its physics. To hold a module to
/// it, include this in a test source and
///   INSTANTIATE_TEST_SUITE_P(Darcy, ModuleContract, testing::Values(ModuleCase{...}), case_name);
namespace perifrac {

struct ModuleCase {
  std::string name;  ///< letters, digits, underscores
  /// Makes the same module each time, not yet initialised.
  std::function<std::unique_ptr<PhysicsModule>()> make;
  /// A window that it takes with some change of state [s].
  double window = 1.0;
  /// Size of what each in-port is fed, in its unit; 0 for those left out.
  std::map<std::string, double> input_size{};
};

inline std::string case_name(const testing::TestParamInfo<ModuleCase>& info) {
  return info.param.name;
}

class ModuleContract : public testing::TestWithParam<ModuleCase> {
 protected:
  using Outputs = std::vector<std::vector<double>>;

  /// Initialised, and all its in-ports connected.
  std::unique_ptr<PhysicsModule> make() const {
    auto module = GetParam().make();
    module->initialize(0.0);
    connect_all(*module);
    return module;
  }

  static void connect_all(PhysicsModule& module) {
    const auto ports = module.ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      if (ports[id].direction == PortDirection::in) module.connect(static_cast<PortId>(id));
    }
  }

  /// Every port, from the last to the first, and some twice.
  static void read_all(PhysicsModule& module) {
    for (auto id = static_cast<PortId>(module.ports().size()); id-- > 0;) {
      module.port(id);
      module.port(id / 2);
    }
  }

  /// Feeds every in-port a field that varies over the points and, over `length` [s], in time.
  void feed(PhysicsModule& module, double length, double factor = 1.0) const {
    const auto ports = module.ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      if (ports[id].direction != PortDirection::in) continue;
      const auto found = GetParam().input_size.find(ports[id].name);
      const double size = found == GetParam().input_size.end() ? 0.0 : factor * found->second;
      const PortView input = module.port(static_cast<PortId>(id));
      for (std::size_t i = 0; i < input.value.size(); ++i) {
        input.value[i] = size * (1.0 + 0.3 * std::sin(0.7 * static_cast<double>(i)));
        if (!input.rate.empty()) input.rate[i] = length > 0.0 ? 0.1 * input.value[i] / length : 0.0;
      }
    }
  }

  /// Advances over as much of the window as the module is stable for; returns its end [s].
  double advance(PhysicsModule& module, double begin, double part = 1.0) const {
    const double length = std::min(part * GetParam().window, module.stable_time_step());
    feed(module, length);
    return module.advance({begin, begin + length});
  }

  /// The state after the instant answer to the inputs and one window: no module's special case.
  std::unique_ptr<PhysicsModule> make_under_way(double& t) const {
    auto module = make();
    feed(*module, 0.0);
    module->advance({0.0, 0.0});
    t = advance(*module, 0.0);
    return module;
  }

  static Snapshot save(PhysicsModule& module) {
    Snapshot snapshot;
    snapshot.save([&](StateVisitor& visitor) { module.visit_state(visitor); });
    return snapshot;
  }
  static void restore(PhysicsModule& module, const Snapshot& snapshot, double t) {
    snapshot.restore([&](StateVisitor& visitor) { module.visit_state(visitor); });
    module.on_restored(t);
  }

  /// Values and slopes of the out-ports; `fields_only` leaves the ledger's out.
  static Outputs outputs(PhysicsModule& module, bool fields_only = false) {
    Outputs outputs;
    const auto ports = module.ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      // Work is counted over all tries: it is no part of the state.
      if (ports[id].direction != PortDirection::out || ports[id].role == PortRole::work) continue;
      if (fields_only && ports[id].role != PortRole::field) continue;
      const PortView view = module.port(static_cast<PortId>(id));
      outputs.emplace_back(view.value.begin(), view.value.end());
      outputs.emplace_back(view.slope.begin(), view.slope.end());
    }
    return outputs;
  }

  static double sum_of(PhysicsModule& module, PortRole role) {
    double sum = 0.0;
    const auto ports = module.ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      if (ports[id].role == role) sum += module.port(static_cast<PortId>(id)).value[0];
    }
    return sum;
  }

  static void expect_same(const Snapshot& a, const Snapshot& b, const std::string& what) {
    for (const auto& [name, values] : a.fields()) {
      EXPECT_TRUE(b.fields().at(name) == values) << name << ": " << what;
    }
    EXPECT_EQ(a.fields().size(), b.fields().size()) << what;
  }

  static void expect_finite(PhysicsModule& module, const std::string& when) {
    for (const auto& values : outputs(module)) {
      for (const double value : values) ASSERT_TRUE(std::isfinite(value)) << when;
    }
  }
};

TEST_P(ModuleContract, PortsAreNamedOnceAndStayInOrder) {
  const auto module = GetParam().make();
  const auto names = [&] {
    std::vector<std::string> names;
    for (const Port& port : module->ports()) {
      names.push_back((port.direction == PortDirection::in ? "in " : "out ") + port.name);
    }
    return names;
  };
  const auto before = names();
  module->initialize(0.0);
  EXPECT_EQ(names(), before);
  advance(*module, 0.0);
  EXPECT_EQ(names(), before);
  EXPECT_EQ(std::set<std::string>(before.begin(), before.end()).size(), before.size());
}

TEST_P(ModuleContract, PortsHaveAsManyValuesAsTheirPoints) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const auto ports = module->ports();
  for (std::size_t id = 0; id < ports.size(); ++id) {
    const Port& port = ports[id];
    const PortView view = module->port(static_cast<PortId>(id));
    ASSERT_NE(view.points, nullptr) << port.name;
    const std::size_t values = port.components * view.points->count;
    EXPECT_EQ(view.value.size(), values) << port.name;
    EXPECT_TRUE(view.rate.empty() || view.rate.size() == values) << port.name;
    EXPECT_TRUE(view.slope.empty() || view.slope.size() == values ||
                view.slope.size() == values * values)
        << port.name;
    for (int axis = 0; axis < view.points->dimension; ++axis) {
      EXPECT_EQ(view.points->position[axis].size(), view.points->count) << port.name;
    }
    if (port.role != PortRole::field && port.role != PortRole::property) {
      EXPECT_EQ(values, 1u) << port.name;
    }
  }
}

TEST_P(ModuleContract, ReadingPortsChangesNothing) {
  for (const bool connected : {false, true}) {
    const auto module = GetParam().make(), read = GetParam().make();
    double t = 0.0;
    for (PhysicsModule* each : {module.get(), read.get()}) {
      const auto look = [&] {
        if (each == read.get()) read_all(*each);
      };
      each->initialize(0.0);
      look();
      if (connected) connect_all(*each);
      look();
      feed(*each, 0.0);
      look();
      each->advance({0.0, 0.0});
      look();
      each->conclude({0.0, 0.0});
      look();
      t = 0.0;
      for (int n = 0; n < 3; ++n) {
        const double reached = advance(*each, t);
        look();
        each->conclude({t, reached});
        look();
        t = reached;
        const Snapshot now = save(*each);
        look();
        restore(*each, now, t);
        look();
      }
    }
    expect_same(save(*module), save(*read), connected ? "connected" : "not connected");
    EXPECT_EQ(outputs(*module), outputs(*read));
  }
}

TEST_P(ModuleContract, OutputsAreFinite) {
  const auto module = make();
  expect_finite(*module, "after initialize");
  feed(*module, 0.0);
  EXPECT_EQ(module->advance({0.0, 0.0}), 0.0);
  expect_finite(*module, "after a window of no length");
  advance(*module, 0.0);
  expect_finite(*module, "after a window");
}

TEST_P(ModuleContract, AdvanceEndsInTheWindow) {
  const auto module = make();
  EXPECT_GT(module->stable_time_step(), 0.0);
  double t = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double reached = advance(*module, t);
    EXPECT_GT(reached, t);
    EXPECT_LE(reached, t + GetParam().window);
    t = reached;
  }
}

TEST_P(ModuleContract, StateIsShownOncePerNameAndInOneOrder) {
  /// Lists names; changes nothing.
  class Names final : public StateVisitor {
   public:
    std::vector<std::string> names;

   private:
    void real(const std::string& name, std::vector<double>&) override { names.push_back(name); }
    void integer(const std::string& name, std::vector<std::int64_t>&) override {
      names.push_back(name);
    }
  };
  double t = 0.0;
  const auto module = make_under_way(t);
  Names first;
  Names second;
  module->visit_state(first);
  advance(*module, t);
  module->visit_state(second);
  EXPECT_EQ(first.names, second.names);
  EXPECT_EQ(std::set<std::string>(first.names.begin(), first.names.end()).size(),
            first.names.size());
}

TEST_P(ModuleContract, SavingChangesNothing) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const Snapshot first = save(*module);
  expect_same(save(*module), first, "saved twice");
}

TEST_P(ModuleContract, AWindowRepeatsBitForBit) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const Snapshot begin = save(*module);
  restore(*module, begin, t);
  const double reached = advance(*module, t);
  const Snapshot once = save(*module);
  const Outputs output = outputs(*module);

  advance(*module, reached, 0.6);  // a past that must not show
  restore(*module, begin, t);
  expect_same(save(*module), begin, "restored");
  advance(*module, t);
  expect_same(save(*module), once, "advanced again");
  EXPECT_EQ(outputs(*module), output);
}

TEST_P(ModuleContract, ARestoredModuleForgetsATryOfAnotherLength) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const Snapshot begin = save(*module);
  restore(*module, begin, t);
  advance(*module, t);
  const Snapshot once = save(*module);

  restore(*module, begin, t);
  advance(*module, t, 0.3);
  restore(*module, begin, t);
  advance(*module, t);
  expect_same(save(*module), once, "advanced after a shorter try");
}

TEST_P(ModuleContract, OnRestoredTwiceIsOnRestoredOnce) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const Snapshot begin = save(*module);
  restore(*module, begin, t);
  advance(*module, t);
  const Snapshot once = save(*module);
  restore(*module, begin, t);
  module->on_restored(t);
  expect_same(save(*module), begin, "on_restored may not change the state");
  advance(*module, t);
  expect_same(save(*module), once, "on_restored twice");
}

TEST_P(ModuleContract, AnotherModuleGoesOnBitForBit) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const Snapshot begin = save(*module);
  restore(*module, begin, t);
  advance(*module, t);

  const auto other = make();
  restore(*other, begin, t);
  advance(*other, t);
  expect_same(save(*other), save(*module), "restored into another module");
  EXPECT_EQ(outputs(*other), outputs(*module));
}

TEST_P(ModuleContract, AWindowOfNoLengthMovesNoMass) {
  double t = 0.0;
  const auto module = make_under_way(t);
  const double stored = sum_of(*module, PortRole::mass_stored);
  const double gained = sum_of(*module, PortRole::mass_gained);
  feed(*module, 0.0, 2.0);
  EXPECT_EQ(module->advance({t, t}), t);
  EXPECT_EQ(sum_of(*module, PortRole::mass_stored), stored);
  EXPECT_EQ(sum_of(*module, PortRole::mass_gained), gained);
}

TEST_P(ModuleContract, FieldsAfterAWindowOfNoLengthDependOnItsInputsOnly) {
  // Work done on the way there and back may leave its rounding in the ledger.
  double t = 0.0;
  const auto module = make_under_way(t);
  feed(*module, 0.0);
  module->advance({t, t});
  const Outputs once = outputs(*module, true);
  feed(*module, 0.0, 2.0);
  module->advance({t, t});
  feed(*module, 0.0);
  module->advance({t, t});
  EXPECT_EQ(outputs(*module, true), once);
}

}  // namespace perifrac
