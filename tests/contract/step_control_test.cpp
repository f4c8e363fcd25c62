#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/state/snapshot.hpp"
#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::even_windows;
using testing::Each;
using testing::HasSubstr;
using testing::Le;

/// Loses heat over each window at the rate that it is told.
class Stone final : public PhysicsModule {
 public:
  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    return {.points = line_.set(), .value = id == 0 ? loss_.value : heat_};
  }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    heat_[0] -= window.length() * loss_.value[0];
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override { visitor.visit("heat", heat_); }
  void on_restored(double) override {}

  double heat() const { return heat_[0]; }

 private:
  std::vector<Port> ports_ = {{"loss", "W", PortDirection::in}, {"heat", "J", PortDirection::out}};
  fake::Line line_{1};
  fake::Input loss_{1};
  std::vector<double> heat_ = {1.0};
};

/// Takes heat at `rate` times the stone's, at the window's end: plain iteration multiplies an error
/// by rate * window. Gives up on windows that are longer than `longest`.
class Stream final : public PhysicsModule {
 public:
  using OfTime = std::function<double(double)>;
  Stream(OfTime rate, OfTime longest) : rate_(rate), longest_(longest) {}
  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    return {.points = line_.set(), .value = id == 0 ? heat_.value : loss_};
  }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    taken_ += window.length() * heat_.value[0];
    if (window.length() > longest_(window.begin)) {
      throw NumericalError("taken", "the stream", window.end, "the window is too long");
    }
    loss_[0] = rate_(window.end) * heat_.value[0];
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override {
    visitor.visit("loss", loss_);
    visitor.visit("taken", taken_);
  }
  void on_restored(double) override {}

 private:
  OfTime rate_, longest_;
  std::vector<Port> ports_ = {{"heat", "J", PortDirection::in}, {"loss", "W", PortDirection::out}};
  fake::Line line_{1};
  fake::Input heat_{1};
  std::vector<double> loss_ = {0.0};
  double taken_ = 0.0;
};

constexpr double any = std::numeric_limits<double>::infinity();

struct Cooling {
  struct Setup {
    std::function<double(double)> rate = [](double) { return 1.0; };
    double longest = any;
    int iterations = 60;
    std::function<double(double)> longest_at = {};  ///< by the time a window begins, in its place
  };

  Cooling(const Setup& setup, double window, int retries) {
    auto first = std::make_unique<Stone>();
    stone = first.get();
    std::vector<ModuleSlot> modules;
    modules.push_back({"stone", std::move(first)});
    auto longest = setup.longest_at;
    if (!longest) longest = [given = setup.longest](double) { return given; };
    modules.push_back({"stream", std::make_unique<Stream>(setup.rate, longest)});
    CouplingOptions options = even_windows(window);
    options.retries = retries;
    options.max_iterations = setup.iterations;
    options.tolerance = 1e-9;
    manager = std::make_unique<CouplingManager>(std::move(modules), options);
    manager->initialize(0.0);
  }

  /// Ends of the windows.
  std::vector<double> run(double end) {
    std::vector<double> ends;
    while (manager->time() < end) ends.push_back(manager->advance(end));
    return ends;
  }
  Snapshot::Fields modules() const {
    Snapshot snapshot;
    snapshot.save([&](StateVisitor& visitor) {
      for (const ModuleSlot& slot : manager->modules()) {
        visitor.enter(slot.name);
        slot.module->visit_state(visitor);
        visitor.leave();
      }
    });
    return snapshot.fields();
  }
  Snapshot all() const {
    Snapshot snapshot;
    snapshot.save([&](StateVisitor& visitor) { manager->visit_state(visitor); });
    return snapshot;
  }

  Stone* stone;
  std::unique_ptr<CouplingManager> manager;
};

std::vector<double> lengths(const std::vector<double>& ends) {
  std::vector<double> lengths;
  double begin = 0.0;
  for (const double end : ends) {
    lengths.push_back(end - begin);
    begin = end;
  }
  return lengths;
}

/// Iterations that agree only in windows below 1/30 s; a module that gives up above 0.03 s.
const std::vector<Cooling::Setup> demanding = {
    {.rate = [](double) { return 30.0; }},
    {.longest = 0.03},
    {.longest = 0.03, .iterations = 1},
};

TEST(StepControl, BringsThroughWhatNeedsShorterWindows) {
  for (const Cooling::Setup& setup : demanding) {
    Cooling cooling(setup, 0.1, 8);
    const std::vector<double> ends = cooling.run(1.0);
    EXPECT_EQ(ends.back(), 1.0);
    EXPECT_GE(cooling.manager->work().cuts, 2);
    EXPECT_EQ(cooling.manager->work().windows, std::ssize(ends));
    EXPECT_THAT(lengths(ends), Each(Le(1.0 / 30.0)));

    // The same windows without any trouble: what was taken back left no trace.
    Cooling calm(setup, 0.5, 0);
    for (const double end : ends) ASSERT_EQ(calm.manager->advance(end), end);
    EXPECT_EQ(calm.manager->work().cuts, 0);
    EXPECT_EQ(cooling.modules(), calm.modules());
  }
}

TEST(StepControl, CutWindowsComeBackWhereTheyAreEasy) {
  const auto rate = [](double t) { return t < 0.5 ? 30.0 : 1.0; };
  Cooling cooling({.rate = rate}, 0.1, 8);
  std::vector<double> found = lengths(cooling.run(3.0));
  EXPECT_LT(found.front(), 1.0 / 30.0);
  EXPECT_NEAR(std::ranges::max(found), 0.1, 1e-12);
  // Where an error halves only in every fifth pass, windows stay short.
  found = lengths(Cooling(demanding[0], 0.1, 8).run(3.0));
  EXPECT_LT(std::ranges::max(found), 1.0 / 30.0);
}

TEST(StepControl, WhatNeverConvergesStopsWithTheSameWords) {
  const auto fails = [](const Cooling::Setup& setup, int retries) {
    Cooling cooling(setup, 0.1, retries);
    std::string said;
    try {
      cooling.manager->advance(1.0);
    } catch (const NumericalError& error) {
      said = error.what();
    }
    EXPECT_EQ(cooling.manager->work().cuts, retries);
    EXPECT_EQ(cooling.manager->time(), 0.0);
    return said;
  };
  for (const int retries : {0, 3}) {
    const std::string said = fails({.rate = [](double) { return 1e6; }}, retries);
    EXPECT_THAT(said, HasSubstr("the coupling diverges"));
    EXPECT_THAT(said, HasSubstr("in loss at stream.loss -> stone"));
    EXPECT_THAT(fails({.longest = 0.0}, retries), HasSubstr("the window is too long in taken"));
  }
}

TEST(StepControl, TheLogSaysWhyAWindowIsCut) {
  testing::internal::CaptureStderr();
  Cooling(demanding[0], 0.1, 8).manager->advance(1.0);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("the window from t = 0 s is cut from 0.1 s to half of it"));
  EXPECT_THAT(log, HasSubstr("the coupling diverges"));
  EXPECT_THAT(log, HasSubstr("stream.loss -> stone"));
}

TEST(StepControl, ARestartAmongCutWindowsGoesOnBitForBit) {
  for (const Cooling::Setup& setup : demanding) {
    Cooling whole(setup, 0.1, 8);
    whole.run(0.15);
    const Snapshot middle = whole.all();
    whole.manager->restart_point();
    Cooling restarted(setup, 0.1, 8);
    middle.restore([&](StateVisitor& visitor) { restarted.manager->visit_state(visitor); });
    restarted.manager->restart_point();
    EXPECT_GT(whole.manager->work().cuts, 0);
    EXPECT_EQ(restarted.run(1.0), whole.run(1.0));
    EXPECT_EQ(restarted.all().fields(), whole.all().fields());
  }
}

TEST(StepControl, ChangesNothingWhereNothingFails) {
  for (const int iterations : {1, 60}) {
    Cooling with({.iterations = iterations}, 0.1, 8), without({.iterations = iterations}, 0.1, 0);
    EXPECT_EQ(with.run(1.0), without.run(1.0));
    EXPECT_EQ(with.all().fields(), without.all().fields());
    EXPECT_EQ(with.manager->work().passes, without.manager->work().passes);
  }
}

/// What bears ever shorter windows only, towards a time that so is never reached.
TEST(StepControl, StopsWhereWindowsBecomeEverShorter) {
  Cooling cooling({.longest_at = [](double t) { return 0.3 * std::abs(0.5 - t); }}, 0.1, 8);
  std::string said;
  try {
    cooling.run(1.0);
  } catch (const NumericalError& error) {
    said = error.what();
  }
  EXPECT_THAT(said, HasSubstr("windows become ever shorter, where 0.1 s was asked for"));
  EXPECT_THAT(said, HasSubstr("the window is too long"));
  EXPECT_THAT(said, HasSubstr("a schedule"));
  EXPECT_THAT(said, HasSubstr("no progress in taken at the stream, t = 0.5 s"));
  EXPECT_LT(cooling.manager->step(), 400);
}

TEST(StepControl, AWindowBetweenCutsMayBeCutAgain) {
  Cooling cooling({.longest = 0.1 / 256.0}, 0.1, 8);
  EXPECT_DOUBLE_EQ(cooling.manager->advance(1.0), 0.1 / 256.0);
  EXPECT_THROW(Cooling({.longest = 0.1 / 256.0}, 0.1, 7).manager->advance(1.0), NumericalError);
}

}  // namespace
}  // namespace perifrac
