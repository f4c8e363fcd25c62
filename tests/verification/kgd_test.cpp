#include <cmath>

#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

class Kgd : public testing::TestWithParam<const char*> {};

/// Means over one spacing of growth in the latter half.
void expect_the_full_solution(const SceneRun& run, double limit) {
  ASSERT_EQ(run.exit_code, 0);
  for (const char* const quantity : {"length", "pressure", "opening"}) {
    EXPECT_LE(run.figure(std::string(quantity) + " over the exact, mean of a step"), limit)
        << quantity;
  }
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], 0.02);
}

/// 20 points per half length in the end.
TEST_P(Kgd, IsWithinFivePercentOfTheFullSolution) {
  expect_the_full_solution(run_config(GetParam()), 0.05);
}

TEST_P(Kgd, IsWithinThreePercentAtFortyPoints) {
  expect_the_full_solution(run_config(GetParam(), {"body.spacing=2.5 mm"}), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Regimes, Kgd,
                         testing::Values("kgd_viscosity", "kgd_mixed", "kgd_toughness"));

/// A history of the run beside that of its reference.
struct Compared {
  std::vector<double> time, computed, exact;
};

Compared compared(const SceneRun& run, const std::string& name) {
  // Null where the table has nothing yet.
  const auto numbers = [](const nlohmann::json& values) {
    std::vector<double> numbers;
    for (const auto& value : values) {
      numbers.push_back(value.is_null() ? NAN : value.get<double>());
    }
    return numbers;
  };
  for (const auto& history : run.summary["reference"]["histories"]) {
    if (history["name"] != name) continue;
    return {numbers(history["time"]), numbers(history["computed"]), numbers(history["exact"])};
  }
  ADD_FAILURE() << "no " << name;
  return {};
}

/// Computed over exact, both less `rest`, as the mean over the time of one spacing of growth, in
/// the latter half of the run: the one that is farthest from 1.
double worst_mean(const SceneRun& run, const std::string& name, double rest, double spacing) {
  const auto [time, computed, exact] = compared(run, name);
  const std::vector<double> length = compared(run, "crack_length at the crack").exact;
  double worst = NAN;
  for (std::size_t first = 1; first < time.size(); ++first) {
    if (!(time[first - 1] >= 0.5 * time.back())) continue;
    double sum = 0.0;
    std::size_t k = first;
    for (; k < time.size() && length[k] < length[first - 1] + spacing; ++k) {
      sum += (time[k] - time[k - 1]) * (computed[k] - rest) / (exact[k] - rest);
    }
    if (k == time.size()) break;
    const double mean = sum / (time[k - 1] - time[first - 1]);
    if (!(std::abs(mean - 1.0) <= std::abs(worst - 1.0))) worst = mean;
  }
  return worst;
}

/// Carter's leak-off of order one: a march in time by tests/references/kgd.py. Pressures are net.
TEST(KgdLeakOff, IsWithinFivePercentOfTheMarchedSolution) {
  const SceneRun run = run_config("kgd_leakoff");
  ASSERT_EQ(run.exit_code, 0);
  constexpr double spacing = 2.5e-3;
  const auto worst = [&](const std::string& quantity, double rest = 0.0) {
    return worst_mean(run, quantity + " at the crack", rest, spacing);
  };
  EXPECT_NEAR(worst("crack_length"), 1.0, 0.05);
  EXPECT_NEAR(worst("inlet_well_pressure", 3e6), 1.0, 0.05);
  EXPECT_NEAR(worst("inlet_well_opening"), 1.0, 0.05);
  EXPECT_NEAR(worst("leak_off_volume"), 1.0, 0.05);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
}

TEST(HfStorage, AgreesWithTheIndependentSolution) {
  const SceneRun run = run_config("hf_storage");
  ASSERT_EQ(run.exit_code, 0);
  for (const auto& row : run.summary["reference"]["table"]) {
    if (row["time"] < 0.02) continue;
    EXPECT_LE(row["crack_length_error"], 0.08) << row["time"];
    EXPECT_LE(row["inlet_notch_pressure_error"], 0.08) << row["time"];
  }
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], 0.02);
}

}  // namespace
}  // namespace perifrac::test
