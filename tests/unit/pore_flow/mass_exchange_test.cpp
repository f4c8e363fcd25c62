#include "modules/pore_flow/mass_exchange.hpp"

#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/state/compensated_sum.hpp"
#include "tests/sanitized.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Method;
using test::scalar;
using test::some_rock;

template <int D>
DarcyFlow<D> flow_of(std::shared_ptr<const Body<D>> body, const PoreBoundary<D>& boundary,
                     Method method, double tolerance, double pressure = 0.0) {
  return {body,
          test::darcy_system<D>(*body, boundary),
          {pressure},
          test::integrator_maker<D>(method, tolerance)};
}

/// What windows with masses that jump at random leave in the ledger, over what was delivered; with
/// a restart point every 50 windows, as in a run.
double lost_mass(Method method, bool open, int windows) {
  const auto body = test::layered_body<2>({6, 5}, 0.5, open ? face_bit(3) : 0);
  PoreBoundary<2> boundary(*body);
  if (open) {
    boundary.pressure(1, 0.3);
    boundary.pressure(3, -0.2);
  }
  DarcyFlow<2> flow = flow_of<2>(body, boundary, method, 1e-5, 0.1);
  flow.initialize(0.0);
  const double before = scalar(flow, "pore_fluid_mass");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> mass(-1.0, 1.3), length(0.2, 1.0);
  CompensatedSum delivered, size;
  double t = 0.0;
  for (int window = 0; window < windows; ++window) {
    for (double& m : test::port(flow, "exchanged_mass").value) {
      m = 1e-3 * mass(random);
      delivered.add(m);
      size.add(std::abs(m));
    }
    const double end = t + 0.2 * length(random);
    flow.advance({t, end});
    t = end;
    if (window % 50 == 0) flow.on_restored(t);
  }
  const double gained = scalar(flow, "pore_fluid_gained");
  if (open) {
    EXPECT_LT(gained, -0.01 * size.value()) << "nothing left through the faces";
  }
  const double stored = scalar(flow, "pore_fluid_mass") - before;
  return std::abs(stored - gained - delivered.value()) / size.value();
}

TEST(MassExchange, KeepsEveryDropWhileMassesJump) {
  const int windows = test::sanitized ? 500 : 10'000;
  for (std::size_t m = 0; m < test::methods.size(); ++m) {
    for (const bool open : {false, true}) {
      const double lost =
          lost_mass(test::methods[m], open, test::methods[m] == Method::krylov ? 500 : windows);
      RecordProperty(fmt::format("lost_{}_{}", open ? "open" : "closed", test::method_names[m]),
                     fmt::format("{:.1e}", lost));
      EXPECT_LE(lost, 1e-13) << test::method_names[m] << (open ? " open" : " closed");
    }
  }
}

/// The same at every point of a closed box: the pressure grows with the mass, uniformly.
TEST(MassExchange, RaisesThePressureByWhatTheRockStores) {
  const auto body = test::box_body<3>({5, 4, 4}, 0.5);
  for (const Method method : test::methods) {
    DarcyFlow<3> flow = flow_of<3>(body, PoreBoundary<3>(*body), method, 1e-5, 0.25);
    flow.initialize(0.0);
    std::ranges::fill(test::port(flow, "exchanged_mass").value, 0.03);
    flow.advance({0.0, 0.0});
    for (const double p : test::port(flow, "pore_pressure").value) {
      EXPECT_EQ(p, 0.25) << "a window of no length hands over nothing";
    }
    flow.advance({0.0, 0.7});
    flow.advance({0.7, 0.9});
    const double exact = 0.25 + 0.06 / (some_rock.fluid_density * 0.125 * some_rock.storage);
    for (const double p : test::port(flow, "pore_pressure").value) EXPECT_NEAR(p, exact, 1e-13);
    for (const double slope : test::port(flow, "pore_pressure").slope) {
      EXPECT_NEAR(0.25 + slope * 0.06, exact, 1e-13) << "what it told of that before";
    }
    for (const double zeta : test::port(flow, "fluid_content").value) {
      EXPECT_NEAR(zeta, exact * some_rock.storage, 1e-13);
    }
  }
}

/// Steady masses at one point are a source of the same rate there, drained face and layer included.
TEST(MassExchange, IsASourceWhereItIsSteady) {
  const auto body = test::body_with_layer_on_top<2>({9, 8}, 0.5);
  const double rate = 0.05;
  for (const Method method : test::methods) {
    PoreBoundary<2> boundary(*body);
    boundary.pressure(0, 0.1);
    boundary.pressure(3, 0.0);
    PoreBoundary<2> with_source = boundary;
    with_source.source(20, rate);
    const bool euler = method == Method::forward_euler;
    DarcyFlow<2> expected = flow_of<2>(body, with_source, method, 1e-8);
    DarcyFlow<2> flow = flow_of<2>(body, boundary, method, 1e-8);
    expected.initialize(0.0);
    flow.initialize(0.0);
    for (int window = 0; window < 20; ++window) {
      test::port(flow, "exchanged_mass").value[20] = some_rock.fluid_density * rate * 0.1;
      for (DarcyFlow<2>* one : {&flow, &expected}) one->advance({0.1 * window, 0.1 * (window + 1)});
    }
    const auto p = test::port(flow, "pore_pressure").value;
    const auto exact = test::port(expected, "pore_pressure").value;
    const double largest = *std::ranges::max_element(exact);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_NEAR(p[i], exact[i], (euler ? 2e-2 : 1e-6) * largest) << i;
    }
    const double work = scalar(expected, "pore_fluid_work");
    EXPECT_NEAR(scalar(flow, "pore_fluid_work"), work, 5e-3 * work);
  }
}

double energy_gap(int windows) {
  const auto body = test::box_body<2>({9, 8}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(1, 0.0);
  DarcyFlow<2> flow = flow_of<2>(body, boundary, Method::direct, 1e-9);
  flow.initialize(0.0);
  const double length = 2.0 / windows;
  for (int n = 0; n < windows; ++n) {
    const double middle = (n + 0.5) * length;
    const auto mass = test::port(flow, "exchanged_mass").value;
    for (std::size_t i = 0; i < 20; ++i) mass[i] = 0.1 * length * std::sin(2.0 * middle + i);
    flow.advance({n * length, (n + 1) * length});
  }
  const double gained = scalar(flow, "pore_fluid_work");
  const double dissipated = scalar(flow, "darcy_dissipation");
  EXPECT_GT(dissipated, 0.1 * std::abs(gained));
  return std::abs(scalar(flow, "pore_fluid_energy") - gained + dissipated) / dissipated;
}

TEST(MassExchange, BalancesEnergyWithTheSquareOfTheWindow) {
  const double coarse = energy_gap(40), fine = energy_gap(80);
  RecordProperty("energy_gap", fmt::format("{:.1e} {:.1e}", coarse, fine));
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

TEST(DarcyFlow, ShowsTheMobilityOfItsPointsOnce) {
  const auto body = test::body_with_layer_on_top<2>({6, 5}, 0.5);
  PoreBoundary<2> sealed(*body);
  DarcyFlow<2> flow = flow_of<2>(body, sealed, Method::direct, 1e-5);
  flow.initialize(0.0);
  const auto mobility = test::port(flow, "pore_mobility").value;
  for (Index i = 0; i < body->points().size(); ++i) {
    const bool in_layer = body->points().position[1][i] > 2.5;
    EXPECT_EQ(mobility[i], in_layer ? 0.0 : some_rock.mobility);
  }
  EXPECT_EQ(test::port(flow, "pore_mobility").value.data(), mobility.data());
}

/// Fluid that flows through for 100 000 explicit steps, in windows of one step and of many: what
/// came in and what went out are sums of very many equal terms.
TEST(DarcyFlow, KeepsItsLedgerOverVeryManyExplicitSteps) {
  const auto body = test::box_body<2>({6, 4}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(0, 0.7);
  boundary.pressure(1, 0.1);
  for (const int steps : {1, 1000}) {
    DarcyFlow<2> flow = flow_of<2>(body, boundary, Method::forward_euler, 0.0, 0.3);
    flow.initialize(0.0);
    const double before = scalar(flow, "pore_fluid_mass");
    const double step = flow.stable_time_step();
    for (int n = 0; n < 100'000 / steps; ++n) {
      flow.advance({n * steps * step, (n + 1) * steps * step});
    }
    EXPECT_NEAR(scalar(flow, "integrator_steps"), 100'000.0, 10.0);  // short ones at the start
    const double stored = scalar(flow, "pore_fluid_mass");
    const double error = stored - before - scalar(flow, "pore_fluid_gained");
    // Darcy's law through the whole box.
    const double through =
        some_rock.fluid_density * some_rock.mobility * 0.6 / 3.0 * 2.0 * 1e5 * step;
    EXPECT_GT(through, 100.0 * stored);
    RecordProperty(fmt::format("drift_in_windows_of_{}", steps),
                   fmt::format("{:.1e}", error / through));
    EXPECT_LE(std::abs(error), 1e-14 * through);
  }
}

}  // namespace
}  // namespace perifrac
