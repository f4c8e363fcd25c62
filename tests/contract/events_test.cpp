#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/state/snapshot.hpp"
#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::Alarm;
using fake::DrainingPores;
using fake::even_windows;
using fake::Springs;

/// Pores and springs, and alarms that ring at the times given, before and after them in the order.
struct Scene {
  Scene(std::vector<double> rings_before, std::vector<double> rings_after, int iterations) {
    std::vector<ModuleSlot> modules;
    const auto add_alarms = [&](const std::vector<double>& times) {
      for (const double time : times) {
        auto alarm = std::make_unique<Alarm>(time);
        alarms.push_back(alarm.get());
        modules.push_back({"alarm_" + std::to_string(alarms.size()), std::move(alarm)});
      }
    };
    add_alarms(rings_before);
    auto flow = std::make_unique<DrainingPores>(3, 0.5, 1.0);
    pores = flow.get();
    modules.push_back({"pore_flow", std::move(flow)});
    modules.push_back(
        {"solid", std::make_unique<Springs>(std::vector<double>{1.0, 2.0, 3.0}, 1.0)});
    add_alarms(rings_after);

    CouplingOptions options = even_windows(0.1);
    options.max_iterations = iterations;
    options.tolerance = 1e-8;
    manager = std::make_unique<CouplingManager>(std::move(modules), options);
    manager->initialize(0.0);
    manager->settle();
  }

  std::vector<Alarm*> alarms;
  DrainingPores* pores;
  std::unique_ptr<CouplingManager> manager;
};

class Events : public testing::TestWithParam<int> {};

TEST_P(Events, AWindowEndsAtTheEventAndTheOthersAreRedoneToIt) {
  for (const bool first : {true, false}) {
    using Times = std::vector<double>;
    Scene scene(first ? Times{0.237} : Times{}, first ? Times{} : Times{0.237}, GetParam());
    EXPECT_EQ(scene.manager->advance(1.0), 0.1);
    EXPECT_EQ(scene.manager->advance(1.0), 0.2);
    EXPECT_EQ(scene.manager->advance(1.0), 0.237);
    EXPECT_EQ(scene.manager->work().events, 1);
    EXPECT_EQ(scene.alarms[0]->rings(), 1) << "the try before the redo must be forgotten";

    // The same windows without any event: what was taken back left no trace.
    Scene calm({}, {}, GetParam());
    for (const double stop : {0.1, 0.2, 0.237}) EXPECT_EQ(calm.manager->advance(stop), stop);
    EXPECT_EQ(scene.pores->content(), calm.pores->content());
    EXPECT_EQ(scene.pores->pressure(), calm.pores->pressure());

    // And on it goes.
    EXPECT_DOUBLE_EQ(scene.manager->advance(1.0), 0.337);
    EXPECT_EQ(scene.manager->step(), 4);
  }
}

TEST_P(Events, AnEarlierEventFoundInTheRedoIsTaken) {
  // The second alarm is only reached once the window has been cut at the first.
  Scene scene({0.08}, {0.03, 0.05}, GetParam());
  EXPECT_EQ(scene.manager->advance(1.0), 0.03);
  EXPECT_EQ(scene.alarms[0]->rings(), 0);
  EXPECT_EQ(scene.alarms[1]->rings(), 1);
  EXPECT_EQ(scene.alarms[2]->rings(), 0);
  EXPECT_EQ(scene.manager->advance(1.0), 0.05);
  EXPECT_EQ(scene.manager->advance(1.0), 0.08);
}

INSTANTIATE_TEST_SUITE_P(OnePassAndIterated, Events, testing::Values(1, 50));

TEST(EventsAlone, AModuleAloneIsTakenBackAsAnyOther) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"alarm", std::make_unique<Alarm>(0.15)});
  auto* alarm = static_cast<Alarm*>(modules[0].module.get());
  CouplingManager manager(std::move(modules), even_windows(0.1));
  manager.initialize(0.0);
  manager.settle();
  EXPECT_EQ(manager.advance(1.0), 0.1);
  EXPECT_EQ(manager.advance(1.0), 0.15);
  EXPECT_EQ(alarm->rings(), 1);
  EXPECT_EQ(manager.modules()[0].advances, 4) << "settled, a window, one to its event, and again";
}

/// Expected where it is, too early, too late and beyond the window.
TEST(EventsAlone, AnEventThatIsExpectedIsTriedFirst) {
  using Times = std::vector<double>;
  const std::vector<std::tuple<Times, Times, int>> cases = {{{0.15}, {0.1, 0.15}, 3},
                                                            {{0.13}, {0.1, 0.13, 0.15}, 5},
                                                            {{0.17}, {0.1, 0.15}, 4},
                                                            {{0.35}, {0.1, 0.15}, 4},
                                                            {{0.02}, {0.02, 0.12, 0.15}, 5}};
  for (const auto& [expected, ends, advances] : cases) {
    std::vector<ModuleSlot> modules;
    modules.push_back({"alarm", std::make_unique<Alarm>(0.15, expected)});
    auto* alarm = static_cast<Alarm*>(modules[0].module.get());
    CouplingManager manager(std::move(modules), even_windows(0.1));
    manager.initialize(0.0);
    manager.settle();
    for (const double end : ends) EXPECT_DOUBLE_EQ(manager.advance(1.0), end) << expected[0];
    EXPECT_EQ(alarm->rings(), 1);
    EXPECT_EQ(manager.modules()[0].advances, advances) << expected[0];
  }
}

TEST(EventsAlone, WindowsDoNotGrowByAnEvent) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"alarm", std::make_unique<Alarm>(0.15)});
  CouplingManager manager(std::move(modules),
                          {.first_window = 0.1, .window_growth = 2.0, .largest_window = 10.0});
  manager.initialize(0.0);
  EXPECT_EQ(manager.advance(10.0), 0.1);
  EXPECT_EQ(manager.advance(10.0), 0.15);
  EXPECT_DOUBLE_EQ(manager.advance(10.0), 0.35);
  manager.settle();
  EXPECT_DOUBLE_EQ(manager.advance(10.0), 0.45) << "a sudden load starts over";
}

/// Ends every window a little nearer to a time that so is never reached.
class Zeno final : public PhysicsModule {
 public:
  std::span<const Port> ports() const override { return {}; }
  PortView port(PortId) override { return {}; }
  void initialize(double) override {}
  double stable_time_step() const override { return 1.0; }
  double advance(const TimeWindow& window) override {
    return std::min(window.end, window.begin + 0.02 * (0.25 - window.begin));
  }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}
};

TEST(EventsAlone, WithoutProgressEndTheRun) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"zeno", std::make_unique<Zeno>()});
  CouplingManager manager(std::move(modules), even_windows(0.1));
  manager.initialize(0.0);
  try {
    while (manager.time() < 1.0 && manager.step() < 2000) manager.advance(1.0);
    ADD_FAILURE() << "came to " << manager.time();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("windows become ever shorter"));
    EXPECT_THAT(error.what(), testing::HasSubstr("an event in each"));
    EXPECT_EQ(error.place(), "zeno");
  }
}

/// Says it reached a time that it cannot have reached.
class Confused final : public PhysicsModule {
 public:
  explicit Confused(double reached) : reached_(reached) {}
  std::span<const Port> ports() const override { return {}; }
  PortView port(PortId) override { return {}; }
  void initialize(double) override {}
  double stable_time_step() const override { return 1.0; }
  double advance(const TimeWindow&) override { return reached_; }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}

 private:
  double reached_;
};

TEST(EventsAlone, ATimeOutsideTheWindowIsAnError) {
  for (const double reached : {-1.0, 0.0, 0.2, std::nan("")}) {
    std::vector<ModuleSlot> modules;
    modules.push_back({"confused", std::make_unique<Confused>(reached)});
    CouplingManager manager(std::move(modules), even_windows(0.1));
    manager.initialize(0.0);
    EXPECT_THROW(manager.advance(1.0), NumericalError) << reached;
  }
}

}  // namespace
}  // namespace perifrac
