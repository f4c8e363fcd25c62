#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/state/snapshot.hpp"
#include "modules/crack_fluid/carter_leak_off.hpp"
#include "modules/crack_fluid/crack_fluid.hpp"
#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

const Region<2> everywhere{"", {-1.0, -1.0}, {1.0, 1.0}};

/// A straight crack in an infinite elastic plane of plane strain modulus E', facet by facet of
/// constant opening (Crouch 1976): how every opening answers to every pressure.
Eigen::MatrixXd elastic_compliance(int facets, double plane_strain_modulus) {
  Eigen::MatrixXd stiffness(facets, facets);
  for (int i = 0; i < facets; ++i) {
    for (int j = 0; j < facets; ++j) {
      const double x = (i - j) * dx;
      stiffness(i, j) =
          -plane_strain_modulus * dx / (4.0 * std::numbers::pi * (x * x - 0.25 * dx * dx));
    }
  }
  return stiffness.inverse();
}

/// A crack of that kind along the x axis, dry and closed, its middle at 0.
CrackRun elastic_crack(int facets, std::vector<CrackInlet> inlets, double residual = 2e-6) {
  CrackLiquid liquid = water;
  liquid.residual_aperture = residual;
  CrackRun run(liquid, std::move(inlets));
  run.add_line(straight_line({-0.5 * facets * dx, 0.0}, 0.0, dx, facets));
  const Eigen::MatrixXd compliance = elastic_compliance(facets, 4e9);
  const PortView view = run.port("free_crack_opening");
  for (int i = 0; i < facets; ++i) {
    for (int j = 0; j < facets; ++j) view.slope[i * facets + j] = compliance(i, j);
  }
  return run;
}

TEST(CrackNetwork, ElasticCrackIsPumpedUpAndEvensOut) {
  const double rate = 1e-4, pumped = 0.01;
  CrackRun run = elastic_crack(
      41,
      {rate_inlet({0.0, 0.0}, rate, Schedule::table({pumped, pumped * (1 + 1e-9)}, {1.0, 0.0}))});
  for (int k = 0; k < 20; ++k) {
    run.advance(pumped / 20.0);
    EXPECT_LT(run.mass_error(), 1e-14);
    const auto p = run.values("crack_pressure");
    for (int f = 0; f < 41; ++f) EXPECT_NEAR(p[f], p[40 - f], 1e-6 * p[20]) << f;
  }
  EXPECT_LT(run.scalar("crack_newton_iterations"), 8 * 20);
  const double mass = water.density * rate * pumped * (1.0 + 0.5e-9);
  run.advance(10.0, 20);
  EXPECT_NEAR(run.scalar("crack_fluid_stored_mass"), mass, 1e-13 * mass);
  // One pressure everywhere, that at which the crack holds what was pumped.
  const double compliance = dx * elastic_compliance(41, 4e9).sum();
  const auto p = run.values("crack_pressure");
  for (const double pressure : p) EXPECT_NEAR(pressure, p[0], 1e-8 * p[0]);
  EXPECT_NEAR(p[0] * compliance * water.density_at(p[0]), mass, 1e-8 * mass);
  EXPECT_NEAR(run.scalar("inlet_pump_pressure"), p[20], 1e-12 * p[20]);
  EXPECT_NEAR(run.scalar("wetted_length"), 41 * dx, 1e-12);
}

TEST(CrackNetwork, FlowsBackUntilDry) {
  const double rate = 1e-4;
  CrackRun run = elastic_crack(
      41, {rate_inlet({0.0, 0.0}, rate,
                      Schedule::table({0.01, 0.011, 0.02, 1.0}, {1.0, 0.0, -1.0, -1.0}))});
  run.advance(0.01, 20);
  const double pumped = run.scalar("injected_crack_fluid_mass");
  run.advance(0.2, 100);
  EXPECT_LT(run.mass_error(), 1e-12);  // of what is left
  // Asked for twenty times what there is, it took what there is, and none of its pressure is left.
  const double left = run.scalar("crack_fluid_stored_mass");
  EXPECT_GT(left, 0.0);
  EXPECT_LT(left, 0.2 * pumped);
  EXPECT_EQ(run.scalar("inlet_pump_pressure"), 0.0);
  for (const double fill : run.values("crack_wetted_fraction")) {
    EXPECT_GE(fill, 0.0);
    EXPECT_LE(fill, 1.0);
  }
}

TEST(CrackNetwork, NewFacetsAreDryAndFill) {
  CrackRun run(water, {rate_inlet({0.0, 0.0}, 1e-5)});
  auto line = straight_line({0.0, 0.0}, 0.3, dx, 12);
  run.add_line({line.begin(), line.begin() + 4});
  run.open(w, 1e-11);
  run.advance(0.02, 20);
  const double pressure = run.values("crack_pressure")[0];
  EXPECT_GT(pressure, 1e5);
  const double before = run.scalar("crack_fluid_stored_mass");
  run.add_line({line.begin() + 3, line.end()});
  EXPECT_EQ(run.scalar("crack_fluid_stored_mass"), before);
  EXPECT_EQ(run.values("crack_wetted_fraction"),
            (std::vector<double>{1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(run.values("crack_viscosity")[2], water.viscosity);
  EXPECT_EQ(run.values("crack_viscosity")[3], 0.0);
  run.open(w, 1e-11);
  run.advance(0.01, 20);
  EXPECT_LT(run.values("crack_pressure")[0], pressure);
  EXPECT_GT(run.values("crack_wetted_fraction")[5], 0.5);
  EXPECT_LT(run.mass_error(), 1e-14);
}

/// Facets of metres, in rock that lets faces apart by far more than the residual aperture for a
/// little pressure beyond what closes them. Fluid that comes to a dry facet is there at once.
TEST(CrackNetwork, FillsLongFacetsOfAClosedCrack) {
  CrackLiquid liquid = water;
  liquid.residual_aperture = 1e-7;
  for (const double closing : {0.2e6, 20e6}) {
    for (const double compliance : {2e-10, 6e-8}) {
      CrackRun run(liquid, {rate_inlet({0.0, 0.0}, 1e-5)});
      run.add_line(straight_line({0.0, 0.0}, 0.0, 5.0, 3));
      for (int k = 0; k < 60; ++k) {
        run.open(-closing * compliance, compliance);
        run.advance(1e-5 * std::pow(1.25, k));
        ASSERT_LE(run.mass_error(), 1e-8) << closing << " " << compliance << " " << k;
        const double capacity = 1000.0 * 5.0 * 1e-7, came = 1e-2 * run.time();
        if (came < 0.99 * capacity) {
          EXPECT_NEAR(run.values("crack_wetted_fraction")[0], came / capacity, 1e-9);
        }
      }
      EXPECT_GE(run.values("crack_pressure")[0], closing);
    }
  }
}

TEST(CrackNetwork, DoesNothingWithoutACrack) {
  CrackRun run(water, {rate_inlet({0.0, 0.0}, 1e-5)});
  run.advance(1.0, 3);
  EXPECT_EQ(run.scalar("injected_crack_fluid_mass"), 0.0);
  EXPECT_EQ(run.scalar("inlet_pump_pressure"), 0.0);
  EXPECT_EQ(run.port("crack_pressure").value.size(), 0u);
}

TEST(CrackNetwork, RestartedGoesOnBitForBit) {
  const auto walk = [](CrackRun& run) {
    return [&run](StateVisitor& visitor) { run.module().visit_state(visitor); };
  };
  const auto make = [] { return elastic_crack(15, {rate_inlet({0.0, 0.0}, 1e-4)}); };
  CrackRun run = make();
  run.advance(0.001, 5);
  Snapshot snapshot;
  snapshot.save(walk(run));
  CrackRun other = make();
  snapshot.restore(walk(other));
  other.module().on_restored(0.001);
  EXPECT_EQ(other.values("crack_flow_rate"), run.values("crack_flow_rate"));
  EXPECT_EQ(other.scalar("crack_volume"), run.scalar("crack_volume"));
  for (CrackRun* each : {&run, &other}) each->module().advance({0.001, 0.0015});
  Snapshot one, two;
  one.save(walk(run));
  two.save(walk(other));
  EXPECT_EQ(one.fields(), two.fields());
}

TEST(CrackNetwork, StorageAnswersAtOnce) {
  CrackRun run(water, {}, {{everywhere, 1e5}});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 3));
  run.open(w);
  run.advance(0.0);
  EXPECT_EQ(run.values("crack_pressure"), (std::vector<double>{1e5, 1e5, 1e5}));
  const double mass = run.scalar("crack_fluid_stored_mass");
  EXPECT_NEAR(mass, water.density_at(1e5) * w * 3.0 * dx, 1e-14 * mass);
  EXPECT_EQ(run.scalar("injected_crack_fluid_mass"), mass);
  run.port("free_crack_opening").value[1] = w * (1.0 - 1e-3);
  run.advance(0.0);
  const double squeezed = water.bulk_modulus * ((1.0 + 1e5 / water.bulk_modulus) / 0.999 - 1.0);
  EXPECT_NEAR(run.values("crack_pressure")[1], squeezed, 1e-9 * squeezed);
  EXPECT_NEAR(run.values("crack_pressure")[0], 1e5, 1e-2);
  run.port("free_crack_opening").value[1] = 2.0 * w;
  run.advance(0.0);
  EXPECT_EQ(run.values("crack_pressure")[1], 0.0);
  EXPECT_NEAR(run.values("crack_wetted_fraction")[1], 0.5, 3.4e-5);
  EXPECT_EQ(run.scalar("crack_fluid_stored_mass"), mass);
}

TEST(CrackNetwork, RatesFollowTheirSchedule) {
  CrackRun run(water, {rate_inlet({0.0, 0.0}, 1e-5, Schedule::ramp(0.03))});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 20));
  run.open(w);
  run.advance(0.04);  // across the kink
  const double mass = water.density * 1e-5 * (0.5 * 0.03 + 0.01);
  EXPECT_NEAR(run.scalar("injected_crack_fluid_mass"), mass, 1e-12 * mass);
}

TEST(CrackNetwork, FacetsAsNearShareAnInlet) {
  CrackRun run(water, {rate_inlet({0.0, 0.0}, 1e-5)});
  run.add_line(straight_line({-5 * dx, 0.0}, 0.0, dx, 10));
  run.open(w);
  run.advance(0.02, 20);
  const auto mass = run.values("crack_fluid_mass");
  for (int f = 0; f < 10; ++f) EXPECT_NEAR(mass[f], mass[9 - f], 1e-12 * mass[5]) << f;
}

TEST(CrackNetwork, AFacetServesOneInlet) {
  CrackRun run(water, {pressure_inlet("one", {0.0, 0.0}, 0.0), rate_inlet({1e-4, 0.0}, 1e-5)});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 3));
  EXPECT_THROW(run.advance(0.1), NumericalError);
}

CrackRun leaking(double coefficient, std::vector<CrackInlet> inlets,
                 SealedWalls<2> sealed = SealedWalls<2>()) {
  CrackRun run(water, std::move(inlets), {{everywhere, 1e5}},
               std::make_unique<CarterLeakOff<2>>(ByRegion<2, double>{coefficient}, water.density,
                                                  std::move(sealed)));
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.open(w);
  return run;
}

TEST(CrackNetwork, CarterTakesItsVolume) {
  CrackRun run = leaking(1e-5, {pressure_inlet("in", {0.0, 0.0}, 1e6)});
  run.advance(0.001);
  run.advance(0.1, 3);
  run.advance(2.0, 10);
  const double volume = 4.0 * 1e-5 * std::sqrt(run.time()) * 10 * dx;
  EXPECT_NEAR(-run.scalar("leaked_crack_fluid_mass"), water.density * volume,
              1e-10 * water.density * volume);
  EXPECT_NEAR(run.scalar("leak_off_volume"), volume, 1e-10 * volume);
  const double last = volume - 4.0 * 1e-5 * std::sqrt(run.time() - 0.2) * 10 * dx;
  EXPECT_NEAR(run.scalar("leak_off_rate"), last / 0.2, 1e-8 * last);
  EXPECT_LT(run.mass_error(), 1e-14);
}

TEST(CrackNetwork, SealedWallsLetNothingThrough) {
  const Region<2> box{"", {-dx, -dx}, {4.1 * dx, dx}};  // four facets of ten
  CrackRun run = leaking(1e-5, {pressure_inlet("in", {0.0, 0.0}, 1e6)}, SealedWalls<2>({box}));
  run.advance(0.1, 3);
  const double volume = 4.0 * 1e-5 * std::sqrt(run.time()) * 6 * dx;
  EXPECT_NEAR(run.scalar("leak_off_volume"), volume, 1e-10 * volume);
  const auto felt = run.values("crack_leak_off");
  EXPECT_EQ(felt[3], 0.0);
  EXPECT_EQ(felt[4], 1e-5);
}

TEST(CrackNetwork, CarterTakesNoMoreThanThereIs) {
  CrackRun run = leaking(1e-4, {});
  const double drained = std::pow(w / (4.0 * 1e-4), 2);  // when it would have taken all
  run.advance(100.0 * drained, 50);
  const double injected = run.scalar("injected_crack_fluid_mass");
  EXPECT_LT(run.scalar("crack_fluid_stored_mass"), 0.1 * injected);
  EXPECT_NEAR(run.scalar("crack_fluid_stored_mass") - run.scalar("leaked_crack_fluid_mass"),
              injected, 1e-14 * injected);
  for (const double fill : run.values("crack_wetted_fraction")) EXPECT_GE(fill, 0.0);
}

}  // namespace
}  // namespace perifrac
