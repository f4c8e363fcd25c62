#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

#include "tests/verification/mandel_run.hpp"
#include "tests/verification/pore_run.hpp"
#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

const std::string by_volumes = "pore_flow.type=finite_volume";

Overrides with_volumes(const Overrides& more) {
  Overrides all = {by_volumes};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string shipped(const std::string& name) {
  std::ifstream file(PERIFRAC_SOURCE_DIR "/configs/" + name + ".yaml");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Pressure and flux are exact on either side of a contact, on any lattice that has it between two
/// rows; `darcy` is first order there (PoreRegions).
TEST(FiniteVolume, CarriesOneFluxThroughTwoLayersExactly) {
  const double flux = 1e6 / (10.0 / 4e-9 + 10.0 / 1e-9);
  const auto exact = [&](const Vector<2>& x) {
    return x[0] < 10.0 ? 1e6 - flux / 4e-9 * x[0] : flux / 1e-9 * (20.0 - x[0]);
  };
  const PoreRun smeared(two_layers);
  for (const char* const spacing : {"body.spacing=1 m", "body.spacing=2 m"}) {
    const PoreRun run(two_layers, with_volumes({spacing, "time.end=4000 s"}));
    const double error = run.error(exact) / 1e6;
    double flux_error = 0.0;
    for (Index i = 0; i < run.points.size(); ++i) {
      flux_error = std::max(flux_error, std::abs(run.field("darcy_velocity")[i] / flux - 1.0));
    }
    std::printf("two layers by finite volumes: pressure %.1e (darcy %.1e), flux %.1e\n", error,
                smeared.error(exact) / 1e6, flux_error);
    EXPECT_LT(error, 1e-7);
    EXPECT_LT(flux_error, 1e-6);
    EXPECT_LT(run.mass_error(), 1e-12);
  }
  EXPECT_GT(smeared.error(exact) / 1e6, 1e-2);
}

TEST(FiniteVolume, LeavesHydrostaticFluidAtRest) {
  const std::string lateral =
      "pore_flow.boundary.{}={{type: pressure, pressure: 0 Pa, hydrostatic: true}}";
  for (const char* const layers : {"body.boundary={}", "body.boundary={top: layer}"}) {
    for (const char* const state : {"linear", "tait"}) {
      for (const char* const type : {"cvode", "explicit"}) {
        const PoreRun run(heavy_fluid,
                          with_volumes({fmt::format(fmt::runtime(lateral), "left"),
                                        fmt::format(fmt::runtime(lateral), "right"), layers,
                                        fmt::format("pore_flow.fluid.equation_of_state={}", state),
                                        fmt::format("pore_flow.integrator.type={}", type)}));
        const bool compressible = state == std::string("tait");
        const double total = 9810.0 * 20.0;
        EXPECT_LT(
            run.error([&](const Vector<2>& x) { return hydrostatic_pressure(x, compressible); }),
            1e-12 * total)
            << layers << state << type;
        EXPECT_LT(std::abs(run.scalar("pore_fluid_gained")), 1e-8);
      }
    }
  }
}

/// A face whose pressure rises: second order on three lattices, all of it known from Duhamel. Five
/// percent of permeability would be 50 times the bound.
TEST(FiniteVolume, RaisesAFaceAsDuhamelSays) {
  std::vector<double> errors;
  for (const char* const spacing : {"1 m", "0.5 m", "0.25 m"}) {
    const PoreRun run(ramped_face, with_volumes({std::string("body.spacing=") + spacing,
                                                 "pore_flow.integrator.tolerance=1e-8",
                                                 "body.size=[20 m, 3 m]"}));
    errors.push_back(run.error([&](const Vector<2>& x) { return ramped_pressure(x[0], 3.0); }) /
                     1e6);
    EXPECT_LT(run.mass_error(), 1e-12);
    EXPECT_LT(run.energy_error(), 3e-3);
  }
  std::printf("ramped face by finite volumes: %.2e %.2e %.2e\n", errors[0], errors[1], errors[2]);
  EXPECT_LT(errors[2], 5e-5);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.9);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.9);
  const PoreRun explicit_run(ramped_face, with_volumes(explicit_steps));
  EXPECT_LT(
      explicit_run.error([&](const Vector<2>& x) { return ramped_pressure(x[0], 3.0); }) / 1e6,
      3e-4);
}

/// The same on Voronoi cells, and inflow and a well on them.
TEST(FiniteVolume, FlowsThroughVoronoiCells) {
  const PoreRun run(ramped_face, with_volumes({"body.jitter=0.3"}));
  const double error =
      run.error([&](const Vector<2>& x) { return ramped_pressure(x[0], 3.0); }) / 1e6;
  std::printf("ramped face by Voronoi cells: %.2e, energy %.1e\n", error, run.energy_error());
  EXPECT_LT(error, 1e-3);
  EXPECT_LT(run.mass_error(), 1e-12);
  const PoreRun inflow(
      ramped_face,
      with_volumes(
          {"body.jitter=0.3",
           "pore_flow.boundary={left: {type: flux, flux: 1e-5 m/s, schedule: {ramp: 2 s}}}",
           "pore_flow.sources=[{at: [4 m, 2 m], rate: 1e-4 m^2/s}]"}));
  EXPECT_NEAR(inflow.scalar("pore_fluid_gained"), 1000.0 * (1e-5 * 5.0 * 2.0 + 3e-4), 1e-6);
  EXPECT_LT(inflow.mass_error(), 1e-12);
}

/// Steady inflow on one face against pressure on the other: linear, to rounding of the integrator.
TEST(FiniteVolume, TakesInflowAtTheFace) {
  for (const char* const jitter : {"body.jitter=0", "body.jitter=0.3"}) {
    const PoreRun run(ramped_face,
                      with_volumes({jitter, "time.end=2000 s",
                                    "pore_flow.boundary={left: {type: flux, flux: 1e-5 m/s}, "
                                    "right: {type: pressure, pressure: 0 Pa}}"}));
    const double error = run.error([](const Vector<2>& x) { return 1e3 * (20.0 - x[0]); });
    EXPECT_LT(error, 2e-6 * 2e4) << jitter;
    for (Index i = 0; i < run.points.size(); ++i) {
      EXPECT_NEAR(run.field("darcy_velocity")[i], 1e-5, 1e-10) << jitter << i;
    }
  }
}

TEST(FiniteVolume, LetsTheAquiferFallAsTheErrorFunctionSays) {
  for (const Overrides& integrator : {Overrides{}, explicit_steps}) {
    const PoreRun run(shipped("aquifer"), with_volumes(integrator));
    const double error = run.error([](const Vector<2>& x) {
      return 200e3 + 9810.0 * (10.0 - x[1]) - 98.1e3 * std::erfc(x[0] / 20.0);
    });
    std::printf("aquifer by finite volumes: error %.1e of the drop, energy %.1e\n", error / 98.1e3,
                run.energy_error());
    EXPECT_LT(error, 5e-4 * 98.1e3);
    EXPECT_LT(run.mass_error(), 1e-12);
    EXPECT_LT(run.energy_error(), 1e-2);
  }
}

TEST(FiniteVolume, FlowsSteadilyAlongTheProfileOfATaitFluid) {
  const double gamma = 7.5, stiffness = 22e6;
  const auto integral = [&](double p) {  // of rho / rho_0 over p
    return stiffness / (gamma + 1.0) *
           (std::pow(1.0 + gamma * p / stiffness, 1.0 + 1.0 / gamma) - 1.0);
  };
  const auto exact = [&](const Vector<2>& x) {
    const double part = integral(6e6) * (1.0 - x[0] / 20.0);
    return stiffness / gamma *
           (std::pow(1.0 + (gamma + 1.0) * part / stiffness, gamma / (gamma + 1.0)) - 1.0);
  };
  std::vector<double> errors;
  for (const char* const spacing : {"body.spacing=1 m", "body.spacing=0.5 m"}) {
    const PoreRun run(soft_fluid, with_volumes({spacing}));
    errors.push_back(run.error(exact) / 6e6);
    EXPECT_LT(run.mass_error(), 1e-12);
    EXPECT_LT(run.energy_error(), 1e-4);
  }
  std::printf("steady Tait by finite volumes: %.2e %.2e\n", errors[0], errors[1]);
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

/// configs/terzaghi.yaml with one word changed.
TEST(FiniteVolume, ConsolidatesTerzaghisColumn) {
  for (const char* const type : {"cvode", "explicit"}) {
    const SceneRun run =
        run_config("terzaghi", with_volumes({std::string("pore_flow.integrator.type=") + type}));
    EXPECT_EQ(run.exit_code, 0);
    std::printf("Terzaghi %s: %.2e %.2e, settlement %.2e\n", type,
                run.largest("pressure_error", 0.01, 0.01), run.largest("pressure_error", 0.05, 2.0),
                run.largest("settlement_error", 0.01, 2.0));
    EXPECT_LE(run.largest("pressure_error", 0.05, 2.0), 3e-4);
    EXPECT_LE(run.largest("settlement_error", 0.01, 2.0), 3e-4);
    EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
    EXPECT_LE(run.summary["ledger"]["energy_error"], 5e-4);
  }
}

/// configs/mandel.yaml with one word changed, on the lattice and on irregular points.
TEST(FiniteVolume, MeetsMandelsSolution) {
  for (const Overrides& more : {Overrides{},
                                {"pore_flow.integrator.type=explicit"},
                                {"pore_flow.integrator.linear_solver=krylov"},
                                {"body.jitter=0.2"}}) {
    const bool jittered = more == Overrides{"body.jitter=0.2"};
    const MandelRun run = run_mandel(with_volumes(more));
    EXPECT_EQ(run.exit_code, 0);
    std::printf("Mandel %s: pressure %.2e %.2e, plate %.2e, peak %.2e, energy %.1e\n",
                more.empty() ? "" : more[0].c_str(), run.largest_pressure_error(0.01, 0.01),
                run.largest_pressure_error(0.05, 2.0), run.largest_plate_error(), run.peak_error,
                run.energy_error);
    EXPECT_LE(run.largest_pressure_error(0.01, 0.01), jittered ? 4.2e-3 : 2.9e-3);
    EXPECT_LE(run.largest_pressure_error(0.05, 2.0), 6e-4);
    EXPECT_LE(run.largest_plate_error(), 3e-4);
    EXPECT_LE(run.peak_error, 7e-4);
    EXPECT_LE(run.mass_error, 1e-12);
  }
}

TEST(FiniteVolume, HasTheSameBitsAtAnyNumberOfThreads) {
  const Overrides fine = {"body.spacing=0.25 m", "body.size=[40 m, 13 m]", "time.end=0.04 s",
                          "output.times=[]"};
  for (const char* const integrator : {"cvode", "explicit"}) {
    Overrides overrides = with_volumes(fine);
    overrides.push_back(std::string("pore_flow.integrator.type=") + integrator);
    omp_set_num_threads(1);
    const MandelRun one = run_mandel(overrides);
    omp_set_num_threads(2);
    EXPECT_EQ(run_mandel(overrides).profile, one.profile) << integrator;
  }
}

}  // namespace
}  // namespace perifrac::test
