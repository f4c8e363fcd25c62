#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

#include "tests/verification/mandel_run.hpp"
#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

using Overrides = std::vector<std::string>;

void print(const std::string& name, const MandelRun& run) {
  std::printf("%s: %ld solid solves, at most %ld passes a window, %.2f s, mass %.1e, energy %.1e\n",
              name.c_str(), static_cast<long>(run.solid_solves), static_cast<long>(run.most_passes),
              run.seconds, run.mass_error, run.energy_error);
  for (const auto& row : run.rows) {
    std::printf("  T = %.4f: pressure %.2e, plate %.2e\n", row.dimensionless_time,
                row.pressure_error, row.plate_error);
  }
  std::printf("  peak %.2e\n", run.peak_error);
}

/// The limits that the shipped scene must keep, times `factor`.
void expect_accurate(const MandelRun& run, double factor) {
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.rows.size(), 6u);
  EXPECT_LE(run.largest_pressure_error(0.01, 0.01), factor * 1.4e-3);
  EXPECT_LE(run.largest_pressure_error(0.05, 2.0), factor * 4e-4);
  EXPECT_LE(run.largest_plate_error(), factor * 2.3e-4);
  EXPECT_LE(run.peak_error, factor * 5e-4);
  EXPECT_GT(run.peak_error, 0.0) << "the peak was never passed";
  EXPECT_LE(run.mass_error, 1e-12);
  EXPECT_LE(run.energy_error, factor * 6e-4);
}

TEST(Mandel, ShippedSceneMeetsItsLimits) {
  const MandelRun run = run_mandel({});
  print("as shipped", run);
  expect_accurate(run, 1.0);
}

/// What varies from point to point is none of the answer: no accuracy is lost, and the uniform
/// pressure of points that are far apart, just after the load, comes out better.
TEST(Mandel, StabilisedStorageMeetsTheSameLimits) {
  const MandelRun run = run_mandel({"pore_flow.undrained_stabilisation=0.25"});
  print("stabilised", run);
  expect_accurate(run, 1.0);
  const auto early_error = [](const char* strength) {
    const std::string key = "pore_flow.undrained_stabilisation=";
    return run_mandel({key + strength, "body.spacing=2 m", "time.end=9 s",
                       "output.times=[1.6533 s, 8.2665 s]"})
        .largest_pressure_error(0.01, 0.01);
  };
  EXPECT_LT(early_error("0.25"), 0.5 * early_error("0"));
}

constexpr double undrained_pressure = 106.29;  // [Pa]
constexpr double diffusion_time = 0.41333;     // dx^2/c at 2 m [s]

std::string even_windows(double window, const std::string& passes) {
  return fmt::format("coupling={{window: {{first: {0} s, growth: 1, largest: {0} s}}{1}}}", window,
                     passes);
}

/// Before diffusion has come far, the middle is at the undrained pressure, or 7.6 % above it.
void expect_stable(double part, const Overrides& words, const std::string& passes) {
  const double window = part * diffusion_time;
  const double end = (part > 1.0 ? 20 : 150) * window;
  Overrides all = {"body.spacing=2 m", "output.times=[]", fmt::format("time.end={} s", end),
                   even_windows(window, passes)};
  all.insert(all.end(), words.begin(), words.end());
  const SceneRun run = run_config("mandel", all);
  EXPECT_EQ(run.exit_code, 0);
  const double most = part > 1.0 ? 1.11 : 1.08;  // long windows see the peak less well
  for (const char* const place : {"the middle", "a/2", "3a/4"}) {
    const auto pressures = run.column(fmt::format("pore_pressure at {} [Pa]", place));
    EXPECT_LT(*std::ranges::max_element(pressures), most * undrained_pressure) << place;
    EXPECT_GT(*std::ranges::min_element(pressures), -0.01 * undrained_pressure) << place;
  }
  EXPECT_LT(std::abs(run.summary["ledger"]["energy_error"].get<double>()), 0.012);
}

/// From 1e-4 to 1e4 of dx^2/c, in one pass and as windows are by default, stabilised and not.
TEST(Mandel, WindowsOfAnyLengthAreStable) {
  const std::string one_pass = ", iterations: {max: 1}", open;
  const Overrides plain = {"pore_flow.undrained_stabilisation=0"};
  for (const double part : {1e-4, 1e-2, 0.1, 0.15, 0.3, 1.0, 10.0, 1e4}) {
    SCOPED_TRACE(fmt::format("windows of {} dx^2/c", part));
    expect_stable(part, {}, one_pass);
    if (part > 0.01) expect_stable(part, plain, one_pass);
    if (part > 0.01 && part < 1.0) expect_stable(part, plain, open);
    if (part == 0.15 || part == 0.3) {
      expect_stable(part, {"pore_flow.integrator.type=explicit"}, one_pass);
    }
  }
}

/// Pressures at the end of windows that are shorter and shorter, over 200 of the longest and more.
TEST(Mandel, ShorterWindowsAreAtLeastFirstOrderBetter) {
  for (const std::string strength : {"0.25", "0"}) {
    const auto pressure = [&](double part) {
      return run_config("mandel", {"body.spacing=2 m", "output.times=[]", "time.end=80 s",
                                   "pore_flow.integrator.tolerance=1e-7",
                                   "pore_flow.undrained_stabilisation=" + strength,
                                   even_windows(part * 0.4, ", iterations: {max: 1}")})
          .column("pore_pressure at 3a/4 [Pa]")
          .back();
    };
    const double finest = pressure(0.125), coarse = std::abs(pressure(1.0) - finest);
    EXPECT_LT(coarse, 4e-5 * undrained_pressure);
    EXPECT_LT(std::abs(pressure(0.5) - finest), coarse / 1.8) << strength;
  }
}

struct Variant {
  const char* name;
  Overrides overrides;
};

class MandelVariant : public testing::TestWithParam<Variant> {};

TEST_P(MandelVariant, MeetsTwiceTheLimits) {
  const MandelRun run = run_mandel(GetParam().overrides);
  print(GetParam().name, run);
  expect_accurate(run, 2.0);
}

const Overrides iterated = {"coupling.iterations.max=12", "coupling.iterations.tolerance=1e-6",
                            "pore_flow.integrator.tolerance=1e-7", "coupling.window.first=100 ms",
                            "coupling.acceleration=none"};

Overrides with(Overrides base, const Overrides& more) {
  base.insert(base.end(), more.begin(), more.end());
  return base;
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, MandelVariant,
    testing::Values(Variant{"explicit_one_pass", {"pore_flow.integrator.type=explicit"}},
                    Variant{"krylov_one_pass", {"pore_flow.integrator.linear_solver=krylov"}},
                    Variant{"iterated_by_default", {"coupling.iterations.max=12"}},
                    Variant{"cvode_iterated", iterated},
                    Variant{"cvode_anderson", with(iterated, {"coupling.acceleration=anderson"})},
                    Variant{"cvode_aitken", with(iterated, {"coupling.acceleration=aitken"})},
                    Variant{"explicit_iterated",
                            with(iterated, {"pore_flow.integrator.type=explicit"})}),
    [](const auto& info) { return info.param.name; });

TEST(Mandel, DynamicSolidMeetsItsLimits) {
  const MandelRun run =
      run_mandel({"time.end=22 s", "output.times=[1.6533 s, 8.2665 s]"}, "mandel_dynamic");
  print("dynamic", run);
  EXPECT_EQ(run.rows.size(), 3u);
  EXPECT_LE(run.largest_pressure_error(0.01, 0.01), 1e-2);
  EXPECT_LE(run.largest_pressure_error(0.05, 0.05), 4e-3);
  EXPECT_LE(run.largest_plate_error(), 1.2e-3);
  EXPECT_LE(run.peak_error, 1.35e-4);
  EXPECT_GT(run.peak_error, 0.0) << "the peak was never passed";
  EXPECT_LE(run.mass_error, 1e-12);
  EXPECT_LE(run.energy_error, 4e-4);
}

TEST(Mandel, HalfTheSpacingIsFourTimesAsGood) {
  const MandelRun coarse = run_mandel({"time.end=1.6533 s", "output.times=[]"});
  const MandelRun fine = run_mandel({"body.spacing=0.5 m", "time.end=1.6533 s", "output.times=[]"});
  print("half the spacing", fine);
  EXPECT_LE(fine.largest_pressure_error(0.01, 0.01), 4.4e-4);
  EXPECT_GT(coarse.largest_pressure_error(0.01, 0.01),
            3.0 * fine.largest_pressure_error(0.01, 0.01));
}

TEST(Mandel, FewSolvesSufficeForFourThousandths) {
  const MandelRun run =
      run_mandel({"time.end=82.665 s", "output.times=[1.6533 s, 8.2665 s, 16.533 s, 33.066 s]",
                  "coupling.window.growth=1.15", "coupling.window.largest=4 s"});
  print("few solves", run);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.solid_solves, 80);
  EXPECT_LE(run.largest_pressure_error(0.0, 1.0), 1.85e-3);
}

class FluidStiffness : public testing::TestWithParam<const char*> {};

TEST_P(FluidStiffness, FixedStressConvergesInTwelveIterations) {
  const MandelRun run = run_mandel(
      with(iterated, {std::string("pore_flow.fluid.bulk_modulus=") + GetParam(),
                      "coupling.iterations.max=50", "time.end=20 s", "output.times=[]"}));
  print(GetParam(), run);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.most_passes, 12);
}

/// The scene's own first window is short: there the default acceleration is what keeps the limit.
TEST_P(FluidStiffness, FixedStressConvergesInTwelveIterationsAsShipped) {
  const MandelRun run =
      run_mandel({"coupling.iterations.max=50", "coupling.iterations.tolerance=1e-6",
                  "pore_flow.integrator.tolerance=1e-7",
                  std::string("pore_flow.fluid.bulk_modulus=") + GetParam(), "time.end=10 s",
                  "output.times=[]"});
  print(GetParam(), run);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.most_passes, 12);
}

INSTANTIATE_TEST_SUITE_P(FromSoftToIncompressible, FluidStiffness,
                         testing::Values("22 MPa", "200 MPa", "2 GPa", "100 GPa", "1e6 GPa"));

TEST(Mandel, DrainedSplitWarnsBeforeItDiverges) {
  const Overrides drained = {"coupling.split=drained",
                             "coupling.acceleration=none",
                             "coupling.iterations.max=30",
                             "coupling.iterations.tolerance=1e-4",
                             "coupling.window.first=100 ms",
                             "time.end=2 s",
                             "output.times=[]"};
  const Simulation strong = make_mandel(drained);
  ASSERT_EQ(strong.manager->warnings().size(), 1u);
  EXPECT_NE(strong.manager->warnings()[0].find("fixed_stress"), std::string::npos);
  EXPECT_NE(strong.manager->warnings()[0].find("strength"), std::string::npos);
  EXPECT_EQ(run_mandel(drained).exit_code, 1);

  const Overrides weak = with(drained, {"pore_flow.fluid.bulk_modulus=22 MPa"});
  EXPECT_TRUE(make_mandel(weak).manager->warnings().empty());
  EXPECT_EQ(run_mandel(weak).exit_code, 0);
}

TEST(Mandel, BitsDoNotDependOnThreads) {
  // Enough points for the loops to be shared out among threads.
  const Overrides fine = {"body.spacing=0.25 m", "body.size=[40 m, 13 m]", "time.end=0.04 s",
                          "output.times=[]"};
  for (const char* integrator : {"cvode", "explicit"}) {
    const Overrides overrides =
        with(fine, {std::string("pore_flow.integrator.type=") + integrator});
    omp_set_num_threads(1);
    const MandelRun one = run_mandel(overrides);
    omp_set_num_threads(2);
    EXPECT_EQ(run_mandel(overrides).profile, one.profile) << integrator;
  }
}

}  // namespace
}  // namespace perifrac::test
