#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

void expect_accurate(const SceneRun& run, double factor, double energy) {
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.largest("pressure_error", 0.01, 0.01), factor * 8.4e-4);
  EXPECT_LE(run.largest("pressure_error", 0.05, 2.0), factor * 2e-4);
  EXPECT_LE(run.largest("settlement_error", 0.01, 2.0), factor * 3e-4);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], energy);
}

TEST(Terzaghi, ShippedSceneMeetsItsLimits) {
  const SceneRun run = run_config("terzaghi");
  expect_accurate(run, 1.0, 1.2e-5);
}

TEST(Terzaghi, ExplicitFlowMeetsTwiceTheLimits) {
  const SceneRun run = run_config("terzaghi", {"pore_flow.integrator.type=explicit"});
  expect_accurate(run, 2.0, 5e-4);
}

TEST(Terzaghi, ConvergesWithTheSquareOfTheSpacing) {
  for (const std::string strength : {"0", "0.25"}) {
    const auto at = [&](const std::string& spacing, const std::string& width) {
      return run_config("terzaghi", {"body.spacing=" + spacing, "body.size=" + width,
                                     "pore_flow.undrained_stabilisation=" + strength,
                                     "time.end=0.57811 s", "output.times=[]"});
    };
    const SceneRun coarse = at("2 m", "[8 m, 50 m]");
    const SceneRun middle = at("1 m", "[4 m, 50 m]");
    const SceneRun fine = at("0.5 m", "[2 m, 50 m]");
    for (const char* const error : {"pressure_error", "settlement_error"}) {
      const double least = std::pow(2.0, 1.9);
      const double first = coarse.largest(error, 0.01, 0.01);
      const double second = middle.largest(error, 0.01, 0.01);
      EXPECT_GT(first, least * second) << error << ", stabilised by " << strength;
      EXPECT_GT(second, least * fine.largest(error, 0.01, 0.01)) << error << ' ' << strength;
    }
  }
}

/// In one dimension as in two (Mandel): pressures after 200 windows of dx^2/c, and of parts of it.
TEST(Terzaghi, ShorterWindowsAreAtLeastFirstOrderBetter) {
  constexpr double diffusion_time = 0.0231245;  // dx^2/c [s]
  for (const std::string strength : {"0", "0.25"}) {
    const auto pressure = [&](double part) {
      return run_config(
                 "terzaghi",
                 {"output.times=[]", fmt::format("time.end={} s", 200 * diffusion_time),
                  "output.probes=[{name: below, at: [2 m, 40 m], field: pore_pressure}]",
                  "pore_flow.integrator.tolerance=1e-8",
                  "pore_flow.undrained_stabilisation=" + strength,
                  fmt::format("coupling={{window: {{first: {0} s, growth: 1, largest: {0} s}}, "
                              "iterations: {{max: 1}}}}",
                              part * diffusion_time)})
          .column("pore_pressure at below [Pa]")
          .back();
    };
    const double finest = pressure(0.25), coarse = std::abs(pressure(1.0) - finest);
    EXPECT_LT(coarse, 2.5e-6 * finest);
    EXPECT_LT(std::abs(pressure(0.5) - finest), coarse / 2.5) << strength;  // 3 at first order
  }
}

TEST(Terzaghi, RecordsHistoriesWithTheRowsOfTheTable) {
  const SceneRun run = run_config("terzaghi", {"output.history_interval=2 s"});
  const auto& times = run.summary["reference"]["histories"][0]["time"];
  EXPECT_EQ(times.size(), 21u);
  EXPECT_LT(times.size(), run.summary["counts"]["windows"].get<std::size_t>());
}

TEST(Terzaghi, IsTheSameInThreeDimensions) {
  const SceneRun plane = run_config(
      "terzaghi",
      {"time.end=28.9053 s", "output.times=[0.57811 s, 2.89053 s, 5.78106 s, 11.56212 s]"});
  const SceneRun solid = run_config("terzaghi_3d");
  expect_accurate(solid, 1.0, 1.1e-5);
  const auto& expected = plane.summary["reference"]["profiles"][0]["computed"];
  const auto& found = solid.summary["reference"]["profiles"][0]["computed"];
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) {
    ASSERT_EQ(found[n].size(), expected[n].size());
    for (std::size_t i = 0; i < expected[n].size(); ++i) {
      EXPECT_NEAR(found[n][i], expected[n][i].get<double>(), 2.2e-4 * 6e6);
    }
  }
}

TEST(Terzaghi, IsTheSameWhereThreeDimensionsAreIteratedUpon) {
  const std::string solves_by = "pore_flow.integrator.linear_solver=";
  const auto run = [&](const char* solver) {
    return run_config("terzaghi_3d", {"body.size=[5 m, 5 m, 50 m]", "time.end=0.57811 s",
                                      "output.times=[0.57811 s]", solves_by + solver});
  };
  const auto iterations = [](const SceneRun& done) {
    for (const auto& module : done.summary["modules"]) {
      if (module["name"] != "pore_flow") continue;
      return module["statistics"].value("linear_iterations", 0.0);
    }
    return -1.0;
  };
  const SceneRun factored = run("direct"), iterated = run("automatic");
  EXPECT_EQ(iterations(factored), 0.0);
  EXPECT_GT(iterations(iterated), 0.0) << "1250 points";
  EXPECT_LT(iterations(iterated), 5.0 * iterated.summary["counts"]["windows"].get<double>());
  const auto& expected = factored.summary["reference"]["profiles"][0]["computed"].back();
  const auto& found = iterated.summary["reference"]["profiles"][0]["computed"].back();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i].get<double>(), 1e-5 * 6e6);
  }
  EXPECT_EQ(iterations(run_config("terzaghi_3d", {"time.end=1 ms", "output.times=[]"})), 0.0)
      << "few points are factored";
}

}  // namespace
}  // namespace perifrac::test
