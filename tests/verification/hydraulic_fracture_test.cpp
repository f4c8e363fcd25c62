#include <cmath>

#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

/// Length and pressure at the outputs between two times, against a solution by other means.
void expect_near_reference(const SceneRun& run, double from, double tolerance) {
  ASSERT_EQ(run.exit_code, 0);
  for (const auto& row : run.summary["reference"]["table"]) {
    if (row["time"] < from) continue;
    EXPECT_LE(row["crack_length_error"], tolerance) << row["time"];
    EXPECT_LE(row["inlet_notch_pressure_error"], tolerance) << row["time"];
  }
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
}

TEST(HfStorage, AgreesWithTheIndependentSolutionOnACoarseLattice) {
  expect_near_reference(run_config("hf_storage", {"body.spacing=2.5 mm"}), 0.02, 0.08);
}

/// The whole chain, crack fluid that leaks into pores of a rock that cracks: the length is that of
/// rock without pores, which the same volume opens; the pressure is higher by what pores stiffen.
TEST(HfStoragePores, KeepsItsBalancesOnACoarseLattice) {
  const SceneRun run = run_config("hf_storage_pores", {"body.spacing=2.5 mm", "time.end=40 ms"});
  ASSERT_EQ(run.exit_code, 0);
  for (const auto& row : run.summary["reference"]["table"]) {
    if (row["time"] < 0.015) continue;
    EXPECT_LE(row["crack_length_error"], 0.08) << row["time"];
    EXPECT_LE(row["inlet_notch_pressure_error"], 0.25) << row["time"];
  }
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], 0.02);
  EXPECT_GT(run.summary["ledger"]["pore_fluid_mass"]["value"], 0.0);
}

/// A sloped seed turns to where the stress lets it open, and the run ends well.
TEST(HfStorage, TurnsFromASlopedNotch) {
  const SceneRun run =
      run_config("hf_storage", {"body.spacing=2.5 mm", "time.end=40 ms", "output.interval=40 ms",
                                "cracks[0].path=[75 mm, 200 mm, 79 mm, 188 mm]"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
}

}  // namespace
}  // namespace perifrac::test
