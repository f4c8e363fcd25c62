#include "modules/crack_fluid/uniform_pressure/uniform_pressure.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/state/snapshot.hpp"
#include "modules/crack_fluid/carter_leak_off.hpp"
#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

constexpr CrackLiquid inviscid{.density = water.density,
                               .viscosity = 0.0,
                               .bulk_modulus = water.bulk_modulus,
                               .vapour_pressure = 0.0,
                               .residual_aperture = water.residual_aperture};

CrackRun uniform(std::vector<CrackInlet> inlets, std::vector<CrackFilling<2>> fillings = {},
                 std::unique_ptr<LeakOff> leak_off = nullptr,
                 const CrackLiquid& liquid = inviscid) {
  return {liquid, std::move(inlets), std::move(fillings), std::move(leak_off),
          std::make_unique<UniformPressure>(liquid)};
}

Region<2> box(double from, double to) { return {"", {from, -1.0}, {to, 1.0}}; }

/// K_f (m / (rho_0 V) - 1), the pressure under which a slit of given walls holds a mass.
double pressure_of(double mass, double volume) {
  return water.bulk_modulus * (mass / (water.density * volume) - 1.0);
}

/// All at once, from the first window on, in steps of any length; before the slit is full its
/// facets are so by the same part.
TEST(UniformPressure, OfARigidSlitIsThatOfItsMass) {
  const double rate = 1e-4, volume = 10 * dx * w;
  CrackRun run = uniform({rate_inlet({0.0, 0.0}, rate)});
  run.add_line(straight_line({0.0, 0.0}, 0.4, dx, 10));
  run.open(w);
  run.advance(0.4 * volume / rate);
  for (const double fill : run.values("crack_wetted_fraction")) EXPECT_NEAR(fill, 0.4, 1e-12);
  EXPECT_EQ(run.scalar("inlet_pump_pressure"), 0.0);
  for (const double length : {0.6 * volume / rate, 1e-7, 1e-5, 3e-4}) {
    run.advance(length);
    const double expected = pressure_of(water.density * rate * run.time(), volume);
    for (const double p : run.values("crack_pressure")) {
      EXPECT_NEAR(p, expected, 3e-12 * water.bulk_modulus);
    }
    EXPECT_LT(run.mass_error(), 1e-15);
  }
  for (const double viscosity : run.values("crack_viscosity")) EXPECT_EQ(viscosity, 0.0);
  EXPECT_NEAR(run.scalar("wetted_length"), 10 * dx, 1e-15);
  EXPECT_EQ(run.scalar("fluid_lag"), 0.0);
}

/// A line of facets in an infinite elastic plane of plane strain modulus 4 GPa (Crouch 1976),
/// closed by a stress.
struct ElasticCrack {
  static constexpr int facets = 31;
  static constexpr double stress = 2e6;
  Eigen::MatrixXd compliance;
  CrackRun run;

  explicit ElasticCrack(std::vector<CrackInlet> inlets, double residual = 1e-9)
      : run(uniform(std::move(inlets), {}, nullptr, with(residual))) {
    run.add_line(straight_line({-0.5 * facets * dx, 0.0}, 0.0, dx, facets));
    Eigen::MatrixXd stiffness(facets, facets);
    for (int i = 0; i < facets; ++i) {
      for (int j = 0; j < facets; ++j) {
        const double x = (i - j) * dx;
        stiffness(i, j) = -4e9 * dx / (4.0 * std::numbers::pi * (x * x - 0.25 * dx * dx));
      }
    }
    compliance = stiffness.inverse();
    const PortView view = run.port("free_crack_opening");
    for (int i = 0; i < facets; ++i) {
      view.value[i] = -stress * compliance.row(i).sum();
      for (int j = 0; j < facets; ++j) view.slope[i * facets + j] = compliance(i, j);
    }
  }
  static CrackLiquid with(double residual) {
    CrackLiquid liquid = inviscid;
    liquid.residual_aperture = residual;
    return liquid;
  }
  /// Where rho(p) C (p - stress) is the mass.
  double pressure_of(double mass) const {
    const double c = dx * compliance.sum() * water.density, k = water.bulk_modulus;
    const double b = k + stress;  // of the net pressure: q^2 + b q = k m / c
    return stress + 2.0 * k * mass / c / (b + std::sqrt(b * b + 4.0 * k * mass / c));
  }
  /// What the rock holds, and what lifting the stress has cost [J/m].
  double rock_energy() {
    double sum = 0.0;
    for (int i = 0; i < facets; ++i) {
      const double p = run.values("crack_pressure")[i];
      const double opening = (p - stress) * compliance.row(i).sum();
      sum += dx * opening * (0.5 * (p - stress) + stress);
    }
    return sum;
  }
};

TEST(UniformPressure, OpensAnElasticCrackAtOnce) {
  const double rate = 1e-4;
  ElasticCrack crack({rate_inlet({0.0, 0.0}, rate)});
  for (const double length : {1e-4, 1e-3, 0.1}) {
    crack.run.advance(length);
    const double exact = crack.pressure_of(water.density * rate * crack.run.time());
    for (const double p : crack.run.values("crack_pressure")) {
      EXPECT_NEAR(p / exact, 1.0, 1e-11) << length;
    }
    EXPECT_LT(crack.run.mass_error(), 1e-15);
  }
  EXPECT_LE(crack.run.scalar("crack_newton_iterations"), 22);
}

/// Pumped up and let go again; what inlets bring by the mean enthalpy of a window is off by its
/// square, and by nothing else.
TEST(UniformPressure, DissipatesNothing) {
  std::vector<double> dissipated;
  for (const int windows : {20, 40}) {
    ElasticCrack crack({rate_inlet({0.0, 0.0}, 1e-4)});
    crack.run.advance(1e-3);
    const double before = crack.run.scalar("crack_flow_dissipation");
    const double work_before = crack.run.scalar("crack_fluid_work");
    const double stored_before = crack.run.scalar("crack_fluid_energy") + crack.rock_energy();
    crack.run.advance(0.2, windows);
    const double work = crack.run.scalar("crack_fluid_work") - work_before;
    const double stored =
        crack.run.scalar("crack_fluid_energy") + crack.rock_energy() - stored_before;
    dissipated.push_back((crack.run.scalar("crack_flow_dissipation") - before) / work);
    EXPECT_NEAR((work - stored) / work, dissipated.back(), 1e-8);
  }
  EXPECT_LT(std::abs(dissipated[0]), 3.8e-5);
  EXPECT_GT(std::abs(dissipated[0] / dissipated[1]), 3.5);
}

/// Two rigid slits under different pressures and one that is dry, which a facet joins: what they
/// hold adds up, and what is lost is what the compressed fluid had.
TEST(UniformPressure, CracksThatJoinShareWhatTheyHold) {
  CrackRun run = uniform({}, {{box(-1.0, 2.5 * dx), 4e6}, {box(2.5 * dx, 0.5), 1e6}});
  const auto line = straight_line({0.0, 0.0}, 0.0, dx, 8);
  run.add_line({line.begin(), line.begin() + 3});
  run.add_line({line.begin() + 3, line.end()});
  run.add_line(straight_line({0.6, 0.0}, 0.0, dx, 4));
  run.open(w);
  run.advance(1e-3);
  EXPECT_NEAR(run.values("crack_pressure")[0], 4e6, 1.0);
  EXPECT_NEAR(run.values("crack_pressure")[5], 1e6, 1.0);
  const double mass = run.scalar("crack_fluid_stored_mass");
  const double energy = run.scalar("crack_fluid_energy");
  run.add_line({line.begin() + 2, line.begin() + 4});
  run.open(w);
  run.advance(1e-3);
  // The facet that joins them was dry: they fill it up to less than their volume.
  for (int f = 0; f < 7; ++f) EXPECT_EQ(run.values("crack_pressure")[f], 0.0) << f;
  EXPECT_NEAR(run.values("crack_wetted_fraction")[11], mass / (water.density * 8 * dx * w), 1e-12);
  for (int f = 7; f < 11; ++f) EXPECT_EQ(run.values("crack_fluid_mass")[f], 0.0) << f;
  EXPECT_NEAR(run.scalar("crack_fluid_stored_mass"), mass, 1e-15 * mass);
  EXPECT_NEAR(run.scalar("crack_flow_dissipation"), energy - run.scalar("crack_fluid_energy"),
              1e-12 * energy);
  EXPECT_GT(run.scalar("crack_flow_dissipation"), 0.0);
}

TEST(UniformPressure, ComesBackAsTheSameMassLeaves) {
  ElasticCrack crack({rate_inlet(
      {0.0, 0.0}, 1e-4, Schedule::table({0.01, 0.011, 0.02, 1.0}, {1.0, 0.0, -1.0, -1.0}))});
  crack.run.advance(0.01, 10);
  const double pumped = crack.run.scalar("injected_crack_fluid_mass");
  EXPECT_NEAR(pumped, 1e-3, 1e-15);
  crack.run.advance(0.2, 100);
  // Asked for twenty times what there is, it took what there is.
  EXPECT_EQ(crack.run.scalar("inlet_pump_pressure"), 0.0);
  EXPECT_LT(crack.run.scalar("crack_fluid_stored_mass"), 1e-4 * pumped);
  for (const double fill : crack.run.values("crack_wetted_fraction")) EXPECT_GE(fill, 0.0);
}

TEST(UniformPressure, CarterTakesItsVolume) {
  CrackRun run =
      uniform({pressure_inlet("in", {0.0, 0.0}, 1e6)}, {{box(-1.0, 1.0), 1e5}},
              std::make_unique<CarterLeakOff<2>>(ByRegion<2, double>{1e-5}, water.density));
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.open(w);
  run.advance(0.1, 3);
  run.advance(2.0, 10);
  const double volume = 4.0 * 1e-5 * std::sqrt(run.time()) * 10 * dx;
  EXPECT_NEAR(run.scalar("leak_off_volume"), volume, 1e-10 * volume);
  EXPECT_EQ(run.values("crack_leak_off")[7], 1e-5);
  for (const double p : run.values("crack_pressure")) EXPECT_EQ(p, 1e6);
  EXPECT_LT(run.mass_error(), 1e-14);
}

TEST(UniformPressure, CarterTakesNoMoreThanThereIs) {
  CrackRun run =
      uniform({}, {{box(-1.0, 1.0), 1e5}},
              std::make_unique<CarterLeakOff<2>>(ByRegion<2, double>{1e-4}, water.density));
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.open(w);
  run.advance(100.0 * std::pow(w / (4.0 * 1e-4), 2), 50);
  const double injected = run.scalar("injected_crack_fluid_mass");
  EXPECT_LT(run.scalar("crack_fluid_stored_mass"), 0.1 * injected);
  EXPECT_NEAR(run.scalar("crack_fluid_stored_mass") - run.scalar("leaked_crack_fluid_mass"),
              injected, 1e-14 * injected);
}

TEST(UniformPressure, IsThatWhichAnInletHolds) {
  CrackRun run =
      uniform({rate_inlet({0.0, 0.0}, 1e-4), pressure_inlet("tank", {8.5 * dx, 0.0}, 3e5)});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.open(w);
  run.advance(0.1, 5);
  for (const double p : run.values("crack_pressure")) EXPECT_EQ(p, 3e5);
  // The tank took all of it but what fills the slit.
  const double held = water.density_at(3e5) * 10 * dx * w;
  EXPECT_NEAR(run.scalar("injected_crack_fluid_mass"), held, 1e-12 * held);
}

TEST(UniformPressure, IsOneOnly) {
  CrackRun run = uniform(
      {pressure_inlet("one", {0.0, 0.0}, 1e5), pressure_inlet("other", {9.5 * dx, 0.0}, 2e5)});
  const auto line = straight_line({0.0, 0.0}, 0.0, dx, 10);
  run.add_line({line.begin(), line.begin() + 5});
  run.add_line({line.begin() + 5, line.end()});
  run.open(w);
  run.advance(0.1);  // two cracks
  EXPECT_EQ(run.values("crack_pressure")[0], 1e5);
  EXPECT_EQ(run.values("crack_pressure")[8], 2e5);
  run.add_line({line.begin() + 4, line.begin() + 6});
  run.open(w);
  EXPECT_THROW(run.advance(0.1), FinalError);
}

/// What is taken from free fluid lowers the pressure that it is taken at.
TEST(UniformPressure, FollowsTheFreeFluidAtAMouth) {
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    CrackInlet mouth = pressure_inlet("mouth", {0.0, 0.0}, 0.0);
    mouth.holds_pressure = false;
    mouth.from_fluid = true;
    CrackRun run = uniform({mouth});
    run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 5));
    run.open(w, 1e-11);
    run.port("mouth_pressure").value[0] = 1e5;
    run.port("mouth_stiffness").value[0] = stiffness;
    for (int window = 0; window < 10; ++window) {
      const double before = run.scalar("mouth_taken");
      run.port("mouth_given").value[0] = before;  // one window late, as the fluid is
      run.advance(1e-4);
      const double expected = std::max(0.0, 1e5 - stiffness * (run.scalar("mouth_taken") - before));
      EXPECT_NEAR(run.values("crack_pressure")[3], expected, 1e-3);
    }
    EXPECT_NEAR(run.scalar("mass_taken_by_cracks"), -run.scalar("crack_fluid_stored_mass"), 1e-15);
  }
}

TEST(UniformPressure, RestartedGoesOnBitForBit) {
  const auto walk = [](CrackRun& run) {
    return [&run](StateVisitor& visitor) { run.module().visit_state(visitor); };
  };
  ElasticCrack crack({rate_inlet({0.0, 0.0}, 1e-4)}), other({rate_inlet({0.0, 0.0}, 1e-4)});
  crack.run.advance(0.001, 5);
  Snapshot snapshot, one, two;
  snapshot.save(walk(crack.run));
  snapshot.restore(walk(other.run));
  other.run.module().on_restored(0.001);
  for (CrackRun* each : {&crack.run, &other.run}) each->module().advance({0.001, 0.0015});
  one.save(walk(crack.run));
  two.save(walk(other.run));
  EXPECT_EQ(one.fields(), two.fields());
}

/// Three cracks in each other's shadow, dry, partly full, closed and open, at 0 to 100 MPa.
struct RandomCracks {
  static constexpr int facets = 18;
  std::mt19937 random;
  UniformPressure flow{inviscid};
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> slope{facets, facets};
  std::vector<double> value, rate, mass;
  std::vector<FacetInflow> inflows;
  std::vector<WellFlow> wells;

  explicit RandomCracks(unsigned seed) : random(seed) {
    std::vector<CrackFacet<2>> lines;
    Eigen::MatrixXd stiffness(facets, facets);
    for (int f = 0; f < facets; ++f) {
      const double x = f % 6 * dx, y = f / 6 * 4.0 * dx;
      lines.push_back({{{x, y}, {(f % 6 + 1) * dx, y}}});
      for (int g = 0; g < facets; ++g) {
        const double along = (f % 6 - g % 6) * dx, across = (f / 6 - g / 6) * 4.0 * dx;
        const double square = along * along + across * across;
        stiffness(f, g) = (f / 6 == g / 6 ? -1.0 : -0.3) * 4e9 * dx /
                          (4.0 * std::numbers::pi * (square - 0.25 * dx * dx));
      }
    }
    slope = stiffness.inverse();
    flow.follow(CrackGraph(lines), Eigen::VectorXd::Zero(facets));
    const double stress = 1e8 * std::pow(between(0.0, 1.0), 2.0);
    for (int f = 0; f < facets; ++f) value.push_back(-stress * slope.row(f).sum());
    rate.assign(facets, 0.0);
    for (int crack = 0; crack < 3; ++crack) {
      const double fill = between(0.0, 1.0) < 0.3 ? 0.0 : std::pow(10.0, between(-3.0, 1.0));
      for (int f = 0; f < 6; ++f) mass.push_back(fill * water.density * dx * 1e-6);
    }
    inflows.push_back({2, 1e-5, 1e-5, 0.0});
    const double held = between(0.0, 2.0) * stress;
    if (between(0.0, 1.0) < 0.5) inflows.push_back({8, -INFINITY, INFINITY, held});
    if (between(0.0, 1.0) < 0.5) inflows.push_back({15, -2e-5, 0.0, 0.0});
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  FlowReport solve(Eigen::VectorXd& v) {
    return flow.solve({.time = {0.0, 1.0},
                       .opening = {value, rate, {slope.data(), std::size_t(slope.size())}, 1.0},
                       .mass = mass,
                       .inflows = inflows,
                       .wells = wells},
                      v);
  }
};

/// Wherever it begins, to the same pressures. The few that are left are for shorter steps.
TEST(UniformPressure, IsFoundFromAnywhere) {
  int iterations = 0, failed = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    RandomCracks cracks(seed);
    Eigen::VectorXd dry = Eigen::VectorXd::Constant(RandomCracks::facets, water.empty());
    Eigen::VectorXd pressed = Eigen::VectorXd::Constant(RandomCracks::facets, 3e8);
    const FlowReport one = cracks.solve(dry), two = cracks.solve(pressed);
    iterations += one.iterations + two.iterations;
    if (!one.converged || !two.converged) ++failed;
    const double scale = dry.cwiseAbs().maxCoeff() + water.bulk_modulus * 1e-3;
    if (one.converged && two.converged) {
      EXPECT_LT((dry - pressed).cwiseAbs().maxCoeff(), 1e-6 * scale) << seed;
    }
    EXPECT_LT(std::abs(cracks.flow.outflow().sum()),
              1e-14 * cracks.flow.outflow().cwiseAbs().sum() + 1e-30);
  }
  EXPECT_LE(failed, 4);  // 3
  EXPECT_LT(iterations, 2000 * 9);
}

/// The same beside a well that feeds all three, with friction from none to ten megapascal, pumped,
/// shut in or flowing back.
TEST(UniformPressure, BesideAWellIsFoundFromAnywhere) {
  int iterations = 0;
  std::array<int, 3> failed{};
  for (unsigned seed = 0; seed < 1000; ++seed) {
    RandomCracks cracks(seed);
    const double full = 1e-8, wanted = full * std::array{1.0, 0.0, -1.0}[seed % 3];
    cracks.inflows.erase(cracks.inflows.begin() + 1, cracks.inflows.end());
    std::vector<WellFlow::Opening> openings;
    for (const Index facet : {4, 10, 17}) {
      const double most =
          cracks.between(0.0, 1.0) < 0.2 ? 0.0 : std::pow(10.0, cracks.between(2.0, 7.0));
      openings.push_back({.facet = facet, .resistance = most / (full * full), .rate = 0.0});
    }
    cracks.wells.emplace_back(openings, wanted, WellFlow::Law{2.2 / full, 0.0, 2.2});
    Eigen::VectorXd dry = Eigen::VectorXd::Constant(RandomCracks::facets, water.empty());
    Eigen::VectorXd pressed = Eigen::VectorXd::Constant(RandomCracks::facets, 3e8);
    const FlowReport one = cracks.solve(dry);
    EXPECT_LT(std::abs(cracks.flow.outflow().sum()),
              1e-14 * cracks.flow.outflow().cwiseAbs().sum() + 1e-30);
    const FlowReport two = cracks.solve(pressed);
    iterations += one.iterations + two.iterations;
    if (!one.converged || !two.converged) {
      ++failed[seed % 3];
      continue;
    }
    const double scale = dry.cwiseAbs().maxCoeff() + water.bulk_modulus * 1e-3;
    EXPECT_LT((dry - pressed).cwiseAbs().maxCoeff(), 1e-6 * scale) << seed;
  }
  EXPECT_EQ(failed[0] + failed[1], 0);
  EXPECT_LE(failed[2], 15);          // 12, for shorter steps
  EXPECT_LT(iterations, 2000 * 13);  // 9.4
}

}  // namespace
}  // namespace perifrac
