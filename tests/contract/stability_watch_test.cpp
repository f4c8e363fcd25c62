#include "coupling/stability_watch.hpp"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::Line;
using fake::Socket;

/// A wall whose answer, gain times what it is told of itself plus a drive of its own, is told to
/// it one window later, extrapolated: an error is multiplied by the roots of r^2 - 2 gain r + gain.
struct Feedback {
  Feedback(double gain, std::function<double(double)> drive, double growth = 1.0) {
    auto wall = std::make_unique<Socket>(std::vector<Port>{{"displacement", "m", PortDirection::in},
                                                           {"pressure", "Pa", PortDirection::out}},
                                         line.set());
    auto solid =
        std::make_unique<Socket>(std::vector<Port>{{"pressure", "Pa", PortDirection::in},
                                                   {"displacement", "m", PortDirection::out}},
                                 line.set());
    wall->respond = [&w = *wall](const TimeWindow&) { w.at[1].value = w.at[0].value; };
    solid->respond = [&s = *solid, gain, drive](const TimeWindow& window) {
      s.at[1].value[0] = gain * s.at[0].value[0] + drive(window.end);
    };
    answer = solid.get();
    std::vector<ModuleSlot> modules;
    modules.push_back({"fluid", std::move(wall)});
    modules.push_back({"solid", std::move(solid)});
    manager = std::make_unique<CouplingManager>(
        std::move(modules),
        CouplingOptions{.first_window = 0.01, .window_growth = growth, .largest_window = 1.0});
    manager->initialize(0.0);
  }

  /// The window in which it warns, or 0.
  int warns_in(int windows) {
    int warned = 0;
    for (int n = 1; n <= windows; ++n) {
      manager->advance(1e9);
      const auto warning = manager->new_warning();
      if (!warning) continue;
      EXPECT_EQ(warned, 0) << "said twice";
      EXPECT_THAT(*warning, testing::HasSubstr("solid.displacement -> fluid"));
      EXPECT_THAT(*warning, testing::HasSubstr("coupling.iterations.max: 20"));
      warned = n;
      size = std::abs(answer->at[1].value[0]);
    }
    return warned;
  }

  Line line{1};
  Socket* answer;
  std::unique_ptr<CouplingManager> manager;
  double size = 0.0;  ///< of the answer when it warned
};

/// The gain at which errors are multiplied by r.
double gain_for(double r) { return r * r / (2.0 * r - 1.0); }

double wave(double t) { return 1.0 + std::sin(7.0 * t); }
double nothing(double t) { return t < 0.02 ? 1.0 : 0.0; }
double shock(double t) { return t < 0.5 ? 1.0 : 50.0; }

TEST(StabilityWatch, WarnsLongBeforeValuesOverflow) {
  for (const double r : {1.5, -1.5, 1.1, -1.1, -4.0, 10.0}) {
    for (const auto& drive : {wave, shock}) {
      Feedback feedback(gain_for(r), drive);
      EXPECT_GT(feedback.warns_in(300), 0) << r;
      EXPECT_LT(feedback.size, 1e130) << r;
    }
  }
  for (const double r : {1.5, -1.5, 3.0, -3.0}) {
    EXPECT_GT(Feedback(gain_for(r), nothing).warns_in(500), 0) << r << " and nothing else";
  }
  Feedback alternating(gain_for(-1.5), wave);
  EXPECT_LE(alternating.warns_in(100), 40);
  EXPECT_LT(alternating.size, 1e9);
}

TEST(StabilityWatch, SaysNothingOfWhatIsStable) {
  for (const double r : {-0.99, -0.9, -0.5, 0.0, 0.3}) {
    for (const auto& drive : {wave, shock}) {
      for (const double growth : {1.0, 1.1}) {
        Feedback feedback(gain_for(r), drive, growth);
        EXPECT_EQ(feedback.warns_in(400), 0) << r;
      }
    }
  }
  // Complex pairs of size sqrt(gain).
  for (const double gain : {0.3, 0.9, 0.99}) {
    EXPECT_EQ(Feedback(gain, wave).warns_in(400), 0) << gain;
    EXPECT_EQ(Feedback(gain, shock).warns_in(400), 0) << gain;
  }
}

/// Motions without any feedback that start from rest, or grow, or come as a shock.
TEST(StabilityWatch, SaysNothingOfMotionsThatGrow) {
  const std::vector<std::function<double(double)>> motions = {
      [](double t) { return t * t; },
      [](double t) { return t * t * t; },
      [](double t) { return std::pow(t, 4); },
      [](double t) { return t * std::sin(20.0 * t); },
      [](double t) { return std::exp(-100.0 * (t - 1.5) * (t - 1.5)); },
      [](double t) { return 1e-3 + std::exp(-100.0 * (t - 1.5) * (t - 1.5)); },
      [](double t) { return t < 1.0 ? 0.0 : 1.0; },
      [](double t) { return std::fmod(t, 0.3) < 0.15 ? 0.0 : 1.0; },
      [](double t) { return std::sqrt(t); },
  };
  for (std::size_t n = 0; n < motions.size(); ++n) {
    for (const double growth : {1.0, 1.05, 1.1}) {
      EXPECT_EQ(Feedback(0.0, motions[n], growth).warns_in(400), 0) << n << ' ' << growth;
    }
  }
}

TEST(StabilityWatch, LeavesIteratedWindowsAlone) {
  fake::Consolidation consolidation({}, [] {
    CouplingOptions options = fake::even_windows(0.1);
    options.max_iterations = 30;
    return options;
  }());
  consolidation.run(20.0);
  EXPECT_FALSE(consolidation.manager.new_warning());
}

}  // namespace
}  // namespace perifrac
