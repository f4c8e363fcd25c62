#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/verification/pore_run.hpp"

namespace perifrac::test {
namespace {

// ---------------------------------------------------------------- regions

double layer_error(const std::string& spacing, double* flux_error) {
  const PoreRun run(two_layers, {"body.spacing=" + spacing});
  const double flux = 1e6 / (10.0 / 4e-9 + 10.0 / 1e-9);
  const auto velocity = run.field("darcy_velocity");
  *flux_error = 0.0;
  for (Index i = 0; i < run.points.size(); ++i) {
    const double x = run.points.at(i)[0];
    if (std::abs(x - 10.0) < 5.0) continue;  // farther than two horizons from the contact
    *flux_error = std::max(*flux_error, std::abs(velocity[i] / flux - 1.0));
  }
  EXPECT_LT(run.mass_error(), 1e-12);
  return run.error([&](const Vector<2>& x) {
    return x[0] < 10.0 ? 1e6 - flux / 4e-9 * x[0] : flux / 1e-9 * (20.0 - x[0]);
  }) / 1e6;
}

TEST(PoreRegions, CarryOneFluxThroughTwoLayers) {
  double coarse_flux = 0.0, fine_flux = 0.0;
  const double coarse = layer_error("1 m", &coarse_flux), fine = layer_error("0.5 m", &fine_flux);
  std::printf("two layers: pressure %.2e %.2e, flux %.2e %.2e\n", coarse, fine, coarse_flux,
              fine_flux);
  EXPECT_LT(fine, 2e-2);
  EXPECT_GT(coarse, 1.8 * fine) << "first order at the contact";
  EXPECT_GT(coarse_flux, 1.8 * fine_flux);
}

TEST(PoreRegions, ThatEqualTheRestChangeNothing) {
  const std::string same =
      "pore_flow.regions.far={permeability: 4e-12 m^2, porosity: 0.2, "
      "biot_coefficient: 0.9, grain_bulk_modulus: 20 GPa}";
  const PoreRun by_region(two_layers, {"time.end=5 s", same});
  const PoreRun tensor(two_layers, {"time.end=5 s",
                                    "pore_flow.regions.far={permeability_tensor: "
                                    "[4e-12, 4e-12, 0], porosity: 0.2, "
                                    "biot_coefficient: 0.9}"});
  double t = 0.0;
  for (Index i = 0; i < by_region.points.size(); ++i) {
    t = std::max(t, std::abs(by_region.pressure[i] - tensor.pressure[i]));
  }
  EXPECT_LT(t, 1e-3);
  EXPECT_GT(by_region.pressure[0], 1e5);
}

// ---------------------------------------------------------------- tensor

/// A pressure spread as a Gaussian keeps being one, of covariance s^2 I + 2 t K / (mu S).
const std::string wide_box = R"(
dimension: 2
body: {shape: box, size: [56 m, 56 m], spacing: 1 m}
pore_flow:
  type: darcy
  permeability_tensor: [3e-12 m^2, 1.5e-12 m^2, 1.2e-12 m^2]
  porosity: 0.2
  fluid: {bulk_modulus: 2 GPa, viscosity: 1 cP}
  integrator: {tolerance: 1e-8}
time: {end: 1 s}
)";

class PressureStart final : public StateVisitor {
 public:
  explicit PressureStart(std::vector<double> content) : content_(std::move(content)) {}

 private:
  void real(const std::string& name, std::vector<double>& values) override {
    if (name.ends_with("fluid_content")) std::ranges::copy(content_, values.begin());
  }
  void integer(const std::string&, std::vector<std::int64_t>&) override {}
  std::vector<double> content_;
};

double gaussian_error(const std::string& spacing) {
  Simulation simulation = make_simulation(read_scene_text(wide_box, {"body.spacing=" + spacing}));
  const auto& points = std::get<std::shared_ptr<const Body<2>>>(simulation.body)->points();
  const double storage = 1e-10, begin = 16.0, t = 0.1;  // s^2 = 16 m^2
  const auto exact = [&](const Vector<2>& at, double time) {
    const double x = at[0] - 28.0, y = at[1] - 28.0, growth = 2.0 * time / (1e-3 * storage);
    const double xx = begin + growth * 3e-12, yy = begin + growth * 1.5e-12, xy = growth * 1.2e-12;
    const double determinant = xx * yy - xy * xy;
    const double distance = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant;
    return begin / std::sqrt(determinant) * std::exp(-0.5 * distance);
  };
  PhysicsModule& flow = *simulation.manager->modules()[0].module;
  flow.initialize(0.0);
  std::vector<double> content;
  for (Index i = 0; i < points.size(); ++i) content.push_back(storage * exact(points.at(i), 0.0));
  PressureStart start(content);
  flow.visit_state(start);
  flow.on_restored(0.0);
  flow.advance({0.0, t});
  const auto pressure = field_named(*simulation.manager, "pore_pressure").values();
  double worst = 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    worst = std::max(worst, std::abs(pressure[i] - exact(points.at(i), t)));
  }
  return worst;
}

TEST(TensorPermeability, SpreadsAGaussianAlongItsOwnAxes) {
  const double coarse = gaussian_error("1 m"), fine = gaussian_error("0.5 m");
  std::printf("anisotropic Gaussian: %.2e %.2e, order %.2f\n", coarse, fine,
              std::log2(coarse / fine));
  EXPECT_LT(fine, 3e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

// ---------------------------------------------------------------- gravity

TEST(PoreGravity, LeavesHydrostaticFluidAtRest) {
  const double total = 9810.0 * 20.0;
  for (const Overrides& sides : {Overrides{}, lateral}) {
    for (const bool compressible : {false, true}) {
      for (const bool small_steps : {false, true}) {
        Overrides overrides = sides;
        if (compressible) overrides.push_back(tait);
        if (small_steps) overrides.push_back(explicit_steps[0]);
        const PoreRun run(heavy_fluid, overrides);
        const double rest =
            run.error([&](const Vector<2>& x) { return hydrostatic_pressure(x, compressible); });
        EXPECT_LT(rest, 1e-12 * total) << sides.size() << compressible << small_steps;
        EXPECT_LT(std::abs(run.scalar("pore_fluid_gained")), 1e-8);
        EXPECT_LT(run.scalar("darcy_dissipation"), 1e-12);
      }
    }
  }
}

TEST(PoreGravity, LeavesHydrostaticFluidAtRestBelowALayerWithAnyOperator) {
  for (const std::string scheme : {"conservative", "bond", "nested"}) {
    for (const bool compressible : {false, true}) {
      Overrides overrides = {"body.boundary={top: layer}", "pore_flow.operator=" + scheme,
                             explicit_steps[0]};
      if (compressible) overrides.push_back(tait);
      const PoreRun run(heavy_fluid, overrides);
      const double rest =
          run.error([&](const Vector<2>& x) { return hydrostatic_pressure(x, compressible); });
      EXPECT_LT(rest, 1e-12 * 9810.0 * 20.0) << scheme << compressible;
    }
  }
}

TEST(PoreGravity, FillsADryLayerAndBooksItsWork) {
  for (const bool compressible : {false, true}) {
    Overrides overrides = lateral;
    overrides.insert(overrides.end(), {"pore_flow.initial_state=uniform", "time.end=20000 s",
                                       "pore_flow.integrator.tolerance=1e-7"});
    if (compressible) overrides.push_back(tait);
    const PoreRun run(heavy_fluid, overrides);
    std::printf("filled: mass %.1e, energy %.1e, gained %.3g kg, dissipated %.3g J\n",
                run.mass_error(), run.energy_error(), run.scalar("pore_fluid_gained"),
                run.scalar("darcy_dissipation"));
    EXPECT_LT(run.mass_error(), 1e-12);
    EXPECT_LT(run.energy_error(), 1e-4);
    EXPECT_GT(run.scalar("pore_fluid_gained"), 1.0);
    EXPECT_GT(run.scalar("darcy_dissipation"), 1.0);
    if (compressible) continue;
    EXPECT_LT(run.error([](const Vector<2>& x) { return 9810.0 * (20.0 - x[1]); }), 10.0);
  }
}

TEST(PoreGravity, DrainsAColumnAtItsConductivity) {
  const PoreRun run(heavy_fluid, {"pore_flow.initial_state=uniform", "pore_flow.regions={}",
                                  "pore_flow.boundary.bottom={type: pressure, pressure: 0 Pa}"});
  const auto velocity = run.field("darcy_velocity");
  for (Index i = 0; i < run.points.size(); ++i) {
    EXPECT_NEAR(velocity[i], 0.0, 1e-15);
    EXPECT_NEAR(velocity[run.points.size() + i], -1e-8 * 9810.0, 1e-15);
    EXPECT_NEAR(run.pressure[i], 0.0, 1e-7);
  }
  EXPECT_LT(run.energy_error(), 1e-12);
}

// ---------------------------------------------------------------- schedules

TEST(PoreSchedule, RaisesAFaceAsDuhamelSays) {
  for (const Overrides& integrator : {Overrides{"coupling.window.first=5 s"}, explicit_steps}) {
    const PoreRun run(ramped_face, integrator);
    const double error =
        run.error([&](const Vector<2>& x) { return ramped_pressure(x[0], 3.0); }) / 1e6;
    std::printf("ramped face: error %.2e, mass %.1e, energy %.1e\n", error, run.mass_error(),
                run.energy_error());
    EXPECT_LT(error, 3e-4);
    EXPECT_LT(run.mass_error(), 1e-12);
    EXPECT_LT(run.energy_error(), 3e-3);
    EXPECT_GT(run.scalar("pore_fluid_work"), 1.0);
  }
}

TEST(PoreSchedule, DeliversTheIntegralOfATable) {
  const std::string well =
      "pore_flow.sources=[{at: [4 m, 2 m], rate: 1e-4 m^2/s, schedule: "
      "{times: [0.5 s, 1 s, 1.1 s, 2 s], factors: [0, 1, -0.5, 0]}}]";
  const double exact = 1000.0 * 1e-4 * (0.25 + 0.025 - 0.225);
  const PoreRun run(ramped_face, {well, "pore_flow.boundary={}", "coupling.window.first=5 s"});
  EXPECT_NEAR(run.scalar("pore_fluid_gained"), exact, 1e-6 * exact);
  EXPECT_LT(run.mass_error(), 1e-12);
  EXPECT_LT(run.energy_error(), 1e-4);
  const PoreRun inflow(ramped_face, {"pore_flow.boundary={left: {type: flux, flux: 1e-5 m/s, "
                                     "schedule: {ramp: 2 s}}}"});
  EXPECT_NEAR(inflow.scalar("pore_fluid_gained"), 1000.0 * 1e-5 * 5.0 * 2.0, 1e-6);
}

// ---------------------------------------------------------------- the shipped aquifer

TEST(Aquifer, FallsAsTheErrorFunctionSays) {
  std::ifstream file(PERIFRAC_SOURCE_DIR "/configs/aquifer.yaml");
  const std::string scene((std::istreambuf_iterator<char>(file)), {});
  for (const Overrides& integrator : {Overrides{}, explicit_steps}) {
    const PoreRun run(scene, integrator);
    const double error = run.error([](const Vector<2>& x) {
      return 200e3 + 9810.0 * (10.0 - x[1]) - 98.1e3 * std::erfc(x[0] / 20.0);
    });
    std::printf("aquifer: error %.1e of the drop, mass %.1e, energy %.1e\n", error / 98.1e3,
                run.mass_error(), run.energy_error());
    EXPECT_LT(error, 5e-4 * 98.1e3);
    EXPECT_LT(run.mass_error(), 1e-12);
    EXPECT_LT(run.energy_error(), 1e-2);
  }
}

// ---------------------------------------------------------------- Tait

double steady_tait_error(const Overrides& overrides, double* flux_error) {
  const PoreRun run(soft_fluid, overrides);
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
  const auto velocity = run.field("darcy_velocity");
  *flux_error = 0.0;
  for (Index i = 0; i < run.points.size(); ++i) {
    const double flux =
        std::pow(1.0 + gamma * run.pressure[i] / stiffness, 1.0 / gamma) * velocity[i];
    const double steady = 1e-8 * integral(6e6) / 20.0;
    *flux_error = std::max(*flux_error, std::abs(flux / steady - 1.0));
  }
  std::printf("steady Tait: mass %.1e, energy %.1e, Newton %g in %g steps\n", run.mass_error(),
              run.energy_error(), run.scalar("newton_iterations"), run.scalar("integrator_steps"));
  EXPECT_LT(run.mass_error(), 1e-12);
  EXPECT_LT(run.energy_error(), 1e-4);
  EXPECT_LT(run.scalar("newton_iterations"), 3.0 * run.scalar("integrator_steps"));
  return run.error(exact) / 6e6;
}

TEST(TaitFluid, FlowsSteadilyAlongItsProfile) {
  double flux = 0.0, fine_flux = 0.0;
  const double coarse = steady_tait_error({}, &flux);
  const double fine = steady_tait_error({"body.spacing=0.5 m"}, &fine_flux);
  std::printf("steady Tait: pressure %.2e %.2e, flux %.2e %.2e\n", coarse, fine, flux, fine_flux);
  EXPECT_LT(fine, 1.5e-4);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
  EXPECT_LT(steady_tait_error({"pore_flow.integrator.linear_solver=krylov"}, &flux), 1.01 * coarse);
}

TEST(TaitFluid, IsTheSameForEveryIntegrator) {
  const Overrides early = {"time.end=20 s"};
  const PoreRun implicit(soft_fluid, early);
  const PoreRun small_steps(soft_fluid, {"time.end=20 s", explicit_steps[0]});
  double difference = 0.0;
  for (Index i = 0; i < implicit.points.size(); ++i) {
    difference = std::max(difference, std::abs(implicit.pressure[i] - small_steps.pressure[i]));
  }
  EXPECT_LT(difference, 3e-3 * 6e6);
  EXPECT_LT(small_steps.mass_error(), 1e-12);
  std::printf("Tait explicit against cvode: %.1e, %g and %g steps\n", difference / 6e6,
              small_steps.scalar("integrator_steps"), implicit.scalar("integrator_steps"));
}

/// A rock that deforms, squeezed while its soft fluid leaves: what the solid takes as work of the
/// pore stress is what the fluid gives.
TEST(TaitFluid, BalancesEnergyWithADeformingSolid) {
  const Overrides squeezed = {"pore_flow.boundary.left={type: sealed}",
                              "pore_flow.fluid.bulk_modulus=22 MPa",
                              tait,
                              "time.end=2 s",
                              "pore_flow.initial_pressure=0 Pa",
                              "pore_flow.boundary.right.pressure=0 Pa",
                              "coupling.iterations={max: 30, tolerance: 1e-6}",
                              "pore_flow.integrator.tolerance=1e-7",
                              "coupling.window={first: 1 ms, growth: 1.1, largest: 20 ms}"};
  Overrides linear = squeezed;
  linear.push_back("pore_flow.fluid.equation_of_state=linear");
  const std::string scene = box_2d + quasi_static_2d + darcy;
  const PoreRun compressible(scene, squeezed), incompressible(scene, linear);
  std::printf("squeezed: Tait mass %.1e, energy %.1e; linear mass %.1e, energy %.1e\n",
              compressible.mass_error(), compressible.energy_error(), incompressible.mass_error(),
              incompressible.energy_error());
  EXPECT_LT(compressible.mass_error(), 1e-12);
  EXPECT_LT(compressible.energy_error(), 3e-3);
}

TEST(TaitFluid, IsLinearWherePressuresAreSmall) {
  const Overrides small = {"time.end=20 s", "pore_flow.initial_pressure=0 Pa",
                           "pore_flow.boundary.left.pressure=2.2 kPa"};
  Overrides linear = small;
  linear.push_back("pore_flow.fluid.equation_of_state=linear");
  const PoreRun a(soft_fluid, small), b(soft_fluid, linear);
  double difference = 0.0;
  for (Index i = 0; i < a.points.size(); ++i) {
    difference = std::max(difference, std::abs(a.pressure[i] - b.pressure[i]));
  }
  EXPECT_LT(difference, 1e-3 * 2200.0);  // about gamma p / K_f
  EXPECT_GT(difference, 1e-6 * 2200.0);
}

}  // namespace
}  // namespace perifrac::test
