#include "modules/pore_flow/darcy_flow.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/state/snapshot.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Method;
using test::scalar;

/// Pressures that are anything but uniform, put in through the state.
class RandomStart final : public StateVisitor {
 private:
  void real(const std::string& name, std::vector<double>& values) override {
    if (name == "fluid_content") {
      const std::vector<double> random = test::random_values(points_);
      std::ranges::copy(random, values.begin());
    }
  }
  void integer(const std::string&, std::vector<std::int64_t>&) override {}

 public:
  explicit RandomStart(std::size_t points) : points_(points) {}

 private:
  std::size_t points_;
};

template <int D>
void expect_mass_kept(const std::shared_ptr<const Body<D>>& body, const PoreBoundary<D>& boundary,
                      const std::string& what) {
  for (std::size_t m = 0; m < test::methods.size(); ++m) {
    DarcyFlow<D> flow(body, test::darcy_system<D>(*body, boundary), {0.5},
                      test::integrator_maker<D>(test::methods[m], 1e-5));
    flow.initialize(0.0);
    RandomStart start(body->points().volume.size());
    flow.visit_state(start);
    flow.on_restored(0.0);
    const double before = scalar(flow, "pore_fluid_mass");
    double moved = 0.0;
    for (const double zeta : test::port(flow, "fluid_content").value) moved += std::abs(zeta);
    moved *= test::some_rock.fluid_density * body->points().volume[0];
    double drift = 0.0, t = 0.0;
    for (int window = 0; window < 40; ++window) {
      const double end = t + 0.01 * std::pow(1.15, window);
      flow.advance({t, end});
      t = end;
      drift = std::max(drift, std::abs(scalar(flow, "pore_fluid_mass") - before -
                                       scalar(flow, "pore_fluid_gained")));
    }
    ::testing::Test::RecordProperty(fmt::format("drift_{}_{}D_{}", what, D, test::method_names[m]),
                                    fmt::format("{:.1e}", drift / moved));
    EXPECT_LE(drift, 1e-12 * moved) << what << ", " << test::method_names[m];
    if (what != "closed") {
      EXPECT_GT(std::abs(scalar(flow, "pore_fluid_gained")), 1e-3 * moved);
    }
  }
}

TEST(DarcyFlow, KeepsItsMassInAClosedBox) {
  const auto square = test::box_body<2>({14, 11}, 0.5);
  expect_mass_kept<2>(square, PoreBoundary<2>(*square), "closed");
  const auto cube = test::box_body<3>({6, 5, 6}, 0.5);
  expect_mass_kept<3>(cube, PoreBoundary<3>(*cube), "closed");
}

TEST(DarcyFlow, StoresWhatComesThroughItsFaces) {
  const auto square = test::box_body<2>({14, 11}, 0.5);
  PoreBoundary<2> boundary(*square);
  boundary.pressure(1, 0.7);
  boundary.pressure(2, -0.3);
  boundary.flux(0, 0.02);
  boundary.source(40, 0.05);
  expect_mass_kept<2>(square, boundary, "open");
  const auto cube = test::box_body<3>({6, 5, 6}, 0.5);
  PoreBoundary<3> around(*cube);
  for (const int face : {0, 2, 5}) around.pressure(face, 0.1 * face);
  expect_mass_kept<3>(cube, around, "open");
}

double error_of_drainage(int count, Method method) {
  const auto body = test::box_body<2>({count, 4}, 1.0 / count);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(1, 0.0);
  DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {1.0},
                    test::integrator_maker<2>(method, 1e-7, 0.1));
  flow.initialize(0.0);
  const double diffusivity = test::some_rock.mobility / test::some_rock.storage;
  double t = 0.0, worst = 0.0;
  for (const double time_factor : {0.1, 0.5}) {
    flow.advance({t, time_factor / diffusivity});
    t = time_factor / diffusivity;
    const auto p = test::port(flow, "pore_pressure").value;
    for (Index i = 0; i < body->points().size(); ++i) {
      const double x = body->points().position[0][i];
      worst = std::max(worst, std::abs(p[i] - test::drained_column(x, time_factor)));
    }
  }
  return worst;
}

TEST(DarcyFlow, DrainsALayerAsTheSeriesSays) {
  for (std::size_t m = 0; m < test::methods.size(); ++m) {
    const double coarse = error_of_drainage(20, test::methods[m]);
    const double fine = error_of_drainage(40, test::methods[m]);
    RecordProperty(
        fmt::format("drained_layer_{}", test::method_names[m]),
        fmt::format("error {:.2e} {:.2e}, order {:.2f}", coarse, fine, std::log2(coarse / fine)));
    EXPECT_LT(fine, 2e-4) << test::method_names[m];
    EXPECT_GE(std::log2(coarse / fine), 1.9) << test::method_names[m];
  }
}

/// Linear between two faces of prescribed pressure is where flow is steady: a warm start stays.
template <int D>
void expect_warm_start(const std::array<int, D>& counts) {
  const auto body = test::box_body<D>(counts, 0.5);
  const double length = 0.5 * counts[0];
  PoreBoundary<D> boundary(*body);
  boundary.pressure(0, 0.4);
  boundary.pressure(1, 0.4 - 0.2 * length);
  for (const Method method : test::methods) {
    DarcyFlow<D> flow(body, test::darcy_system<D>(*body, boundary), {0.4, {-0.2}},
                      test::integrator_maker<D>(method, 1e-5));
    flow.initialize(0.0);
    flow.advance({0.0, 5.0});
    const auto p = test::port(flow, "pore_pressure").value;
    for (Index i = 0; i < body->points().size(); ++i) {
      EXPECT_NEAR(p[i], 0.4 - 0.2 * body->points().position[0][i], 1e-9);
    }
    EXPECT_NEAR(scalar(flow, "pore_fluid_gained"), 0.0, 1e-9);
  }
}

TEST(DarcyFlow, StaysWhereItWasStartedWarm) {
  expect_warm_start<2>({9, 6});
  expect_warm_start<3>({7, 5, 5});
}

TEST(DarcyFlow, BalancesEnergy) {
  const auto body = test::box_body<2>({14, 11}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(1, 0.7);
  boundary.source(40, 0.05);
  // Explicit steps balance to first order; CVODE to its tolerance.
  for (const double tolerance : {1e-5, 1e-8}) {
    DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {0.2},
                      test::integrator_maker<2>(Method::direct, tolerance));
    flow.initialize(0.0);
    const double before = scalar(flow, "pore_fluid_energy");
    flow.advance({0.0, 2.0});
    const double gained = scalar(flow, "pore_fluid_work");
    const double gap =
        scalar(flow, "pore_fluid_energy") - before - gained + scalar(flow, "darcy_dissipation");
    RecordProperty(fmt::format("energy_gap_at_{:.0e}", tolerance),
                   fmt::format("{:.1e}", gap / gained));
    EXPECT_LT(std::abs(gap), 100.0 * tolerance * gained);
    EXPECT_GT(scalar(flow, "darcy_dissipation"), 0.1 * gained);
  }
}

/// A window of no length asks for the undrained answer: nothing flows, dilatation alone lowers the
/// pressure.
TEST(DarcyFlow, AnswersAJumpOfDilatationUndrained) {
  const auto body = test::box_body<2>({8, 8}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(1, 0.0);
  for (const Method method : test::methods) {
    DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {1.0},
                      test::integrator_maker<2>(method, 1e-5));
    flow.initialize(0.0);
    std::ranges::fill(test::port(flow, "dilatation").value, -0.05);
    flow.advance({0.0, 0.0});
    const PortView port = test::port(flow, "pore_stress");
    const auto stress = port.value, slope = port.slope;
    const auto [alpha, storage, mobility, density] = test::some_rock;
    for (std::size_t i = 0; i < stress.size(); ++i) {
      EXPECT_NEAR(stress[i], alpha * (1.0 + alpha * 0.05 / storage), 1e-13);
      EXPECT_NEAR(stress[i], alpha - 0.05 * slope[i], 1e-13) << "the port's slope";
    }
    EXPECT_EQ(scalar(flow, "pore_fluid_gained"), 0.0);
  }
}

/// A pulse far shorter than the window: steps of the integrator's own choice would miss it.
TEST(DarcyFlow, StepsOverNoKinkOfASchedule) {
  const auto body = test::box_body<2>({10, 6}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.source(20, 0.05, Schedule::table({5.0, 5.005, 5.01}, {0.0, 1.0, 0.0}));
  for (const Method method : test::methods) {
    DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {0.0},
                      test::integrator_maker<2>(method, 1e-5));
    flow.initialize(0.0);
    flow.advance({0.0, 10.0});
    const double pulse = test::some_rock.fluid_density * 0.05 * 0.005;
    EXPECT_NEAR(scalar(flow, "pore_fluid_gained"), pulse, 0.02 * pulse);
    EXPECT_NEAR(scalar(flow, "pore_fluid_mass"), scalar(flow, "pore_fluid_gained"), 1e-12 * pulse);
  }
}

/// A face whose pressure jumps from 0 to 1 at `jump`, and what is known of its explicit flow.
struct Jumping {
  static constexpr double jump = 0.731;
  std::shared_ptr<const Body<2>> body = test::box_body<2>({20, 4}, 0.5);
  std::unique_ptr<DarcyFlow<2>> flow;
  Jumping() {
    PoreBoundary<2> boundary(*body);
    boundary.pressure(0, 1.0, Schedule::table({jump - 1e-9, jump}, {0.0, 1.0}));
    flow = std::make_unique<DarcyFlow<2>>(body, test::darcy_system<2>(*body, boundary),
                                          InitialPressure<2>{0.0},
                                          test::integrator_maker<2>(Method::forward_euler, 0.0));
    flow->initialize(0.0);
  }
  double highest() { return std::ranges::max(test::port(*flow, "pore_pressure").value); }
  std::vector<double> pressure() {
    const auto values = test::port(*flow, "pore_pressure").value;
    return {values.begin(), values.end()};
  }
};

/// From the jump on steps are short, in whichever window they lie and after a restart too.
TEST(DarcyFlow, FollowsAJumpInShortStepsAcrossWindowsAndRestarts) {
  Jumping run;
  const double longest = run.flow->stable_time_step();
  double t = Jumping::jump - 0.1 * longest;
  run.flow->advance({0.0, t});
  const double before = scalar(*run.flow, "integrator_steps");
  for (int n = 0; n < 8; ++n) {
    Snapshot state;
    state.save([&](StateVisitor& visitor) { run.flow->visit_state(visitor); });
    Jumping other;
    state.restore([&](StateVisitor& visitor) { other.flow->visit_state(visitor); });
    other.flow->on_restored(t);
    const TimeWindow window{t, t + 0.7 * longest};
    run.flow->advance(window);
    other.flow->advance(window);
    EXPECT_EQ(run.pressure(), other.pressure()) << n;
    EXPECT_LT(run.highest(), 1.01);
    t = window.end;
  }
  EXPECT_GE(scalar(*run.flow, "integrator_steps") - before, 8 + 5);
  EXPECT_LE(scalar(*run.flow, "integrator_steps") - before, 8 + 12);
}

TEST(DarcyFlow, ShowsDarcysVelocity) {
  const auto body = test::box_body<2>({10, 6}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(0, 1.0);
  boundary.pressure(1, 0.0);
  DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {0.5},
                    test::integrator_maker<2>(Method::direct, 1e-8));
  flow.initialize(0.0);
  flow.advance({0.0, 1000.0});
  const auto velocity = test::port(flow, "darcy_velocity").value;
  const Index n = body->points().size();
  for (Index i = 0; i < n; ++i) {
    EXPECT_NEAR(velocity[i], 0.7 / 5.0, 1e-6);
    EXPECT_NEAR(velocity[n + i], 0.0, 1e-6);
  }
}

}  // namespace
}  // namespace perifrac
