#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

using Overrides = std::vector<std::string>;

void expect_balances(const SceneRun& run, double energy) {
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], energy);
}

/// First order: half the spacing leaves half of every error.
void expect_first_order(const SceneRun& coarse, const SceneRun& fine, const Overrides& errors) {
  for (const std::string& error : errors) {
    EXPECT_GT(coarse.largest(error, 0.0, 1e9), 1.6 * fine.largest(error, 0.0, 1e9)) << error;
  }
}

TEST(BondedLayers, CarryTerzaghisColumn) {
  const SceneRun run = run_config("terzaghi_layers");
  expect_balances(run, 1e-3);
  EXPECT_LE(run.largest("pressure_error", 0.0, 1.0), 2.5e-2);
  EXPECT_LE(run.largest("settlement_error", 0.0, 1.0), 1e-2);
  expect_first_order(run,
                     run_config("terzaghi_layers", {"body.spacing=0.5 m", "body.size=[3 m, 50 m]"}),
                     {"pressure_error", "settlement_error"});
}

TEST(BondedLayers, BearAPartOfTheLoadInMandelsProblem) {
  const Overrides early = {"time.end=1.6533 s", "output.times=[]"};
  const SceneRun run = run_config("mandel_layers", early);
  expect_balances(run, 1.35e-3);
  EXPECT_LE(run.largest("pressure_error", 0.0, 1.0), 0.12);
  EXPECT_LE(run.largest("plate_error", 0.0, 1.0), 0.09);
  Overrides fine = early;
  fine.push_back("body.spacing=0.5 m");
  expect_first_order(run, run_config("mandel_layers", fine), {"pressure_error", "plate_error"});
}

TEST(TwoRegions, ConsolidateAsALayeredColumn) {
  const SceneRun run = run_config("layered_column");
  expect_balances(run, 1e-3);
  EXPECT_LE(run.largest("pressure_error", 0.0, 0.02), 3.2e-2);
  EXPECT_LE(run.largest("pressure_error", 0.05, 2.0), 1.5e-2);
  EXPECT_LE(run.largest("settlement_error", 0.0, 2.0), 4e-3);
  expect_first_order(run,
                     run_config("layered_column", {"body.spacing=0.5 m", "body.size=[2 m, 50 m]"}),
                     {"pressure_error", "settlement_error"});
}

}  // namespace
}  // namespace perifrac::test
