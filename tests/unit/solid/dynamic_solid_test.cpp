#include "modules/solid/dynamic_solid.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/solid/layered_box.hpp"
#include "tests/unit/solid/moving_solid.hpp"

namespace perifrac {
namespace {

using test::density;
using test::lambda;
using test::Moving;
using test::mu;
using test::speed;

/// Rollers along the sides, so that all is uniaxial along x.
Moving<2> bar(int cells, double spacing) {
  Moving<2> bar({cells, 6}, spacing);
  bar.boundary.roller(2, 0.0);
  bar.boundary.roller(3, 0.0);
  return bar;
}

/// A pull at the right end that grows over `rise` and stays: d'Alembert's wave to the left,
/// u = c / (lambda + 2 mu) times the impulse that has arrived.
double wave_error(int cells) {
  const double length = 20.0, rise = 4.0 / speed, pull = 0.3;
  Moving<2> solid = bar(cells, length / cells);
  solid.boundary.roller(0, 0.0);
  solid.boundary.traction(1, {pull, 0.0}, Schedule::ramp(rise));
  solid.start();
  solid.advance(0.8 * length / speed);
  const auto u = solid.port("displacement").value;
  double worst = 0.0, largest = 0.0;
  for (Index i = 0; i < solid.body->points().size(); ++i) {
    const double since = solid.time - (length - solid.body->points().position[0][i]) / speed;
    const double impulse = since < 0.0    ? 0.0
                           : since < rise ? pull * since * since / (2.0 * rise)
                                          : pull * (since - 0.5 * rise);
    const double exact = speed / (lambda + 2.0 * mu) * impulse;
    worst = std::max(worst, std::abs(u[i] - exact));
    largest = std::max(largest, exact);
  }
  return worst / largest;
}

TEST(DynamicSolid, AWaveArrivesWithItsSpeedAndSize) {
  const double coarse = wave_error(40), fine = wave_error(80);
  EXPECT_LT(fine, 5e-3);
  EXPECT_LT(fine, 0.5 * coarse);
}

/// Both ends held: sin(pi x / L) is a vibration of the lattice itself. Its acceleration over its
/// displacement is its frequency squared.
double frequency(Moving<2>& solid, double length) {
  solid.boundary.roller(0, 0.0);
  solid.boundary.roller(1, 0.0);
  solid.start();
  solid.deflect([=](double x) { return 1e-3 * std::sin(std::numbers::pi * x / length); });
  solid.advance(0.0);
  const auto u = solid.port("displacement").value;
  return std::sqrt(-solid.field("acceleration")[7] / u[7]);
}

TEST(DynamicSolid, FrequencyConvergesWithTheSquareOfTheSpacing) {
  const double length = 10.0, exact = std::numbers::pi * speed / length;
  const auto error = [&](int cells) {
    Moving<2> solid = bar(cells, length / cells);
    return std::abs(frequency(solid, length) / exact - 1.0);
  };
  const double coarse = error(20), fine = error(40);
  EXPECT_LT(fine, 5e-3);
  EXPECT_GE(std::log2(coarse / fine), 1.9);
}

TEST(DynamicSolid, PhaseConvergesWithTheSquareOfTheStep) {
  std::vector<double> errors;
  for (const double safety : {0.8, 0.4, 0.2}) {
    Moving<2> solid = bar(20, 0.5);
    solid.safety = safety;
    const double w = frequency(solid, 10.0);
    const double start = solid.port("displacement").value[7];
    solid.advance(4.5 * std::numbers::pi / w);  // back in the middle
    const double steps = solid.value("integrator_steps");
    errors.push_back(solid.port("displacement").value[7] / start * steps * steps);
  }
  EXPECT_NEAR(errors[1] / errors[2], 1.0, 0.02);
  EXPECT_NEAR(errors[0] / errors[2], 1.0, 0.1);
}

/// Suddenly loaded: energies meet the work with the square of the step, and what the scheme itself
/// keeps, with kinetic energy - h^2/8 sum m a^2, does so to rounding.
TEST(DynamicSolid, EnergyMeetsTheWorkOfASuddenLoad) {
  std::vector<double> errors;
  for (const double safety : {0.8, 0.4, 0.2}) {
    Moving<2> solid = bar(20, 0.5);
    solid.safety = safety;
    solid.boundary.roller(0, 0.0);
    solid.boundary.traction(1, {0.3, 0.1});
    solid.start();
    solid.advance(0.0);
    const double window = 30.0 / speed;
    double step = 0.0;
    const auto shadow = [&] {
      double sum = 0.0;
      for (const double a : solid.field("acceleration")) sum += a * a;
      return solid.energy_error() - step * step / 8.0 * density * 0.25 * sum;
    };
    step = window / std::ceil(window / solid.module->stable_time_step());
    const double before = shadow();
    double worst = 0.0;
    for (int n = 0; n < 5; ++n) {
      solid.advance(window);
      EXPECT_NEAR(shadow(), before, 1e-12 * solid.value("kinetic_energy"));
      worst = std::max(worst, std::abs(solid.energy_error()));
    }
    EXPECT_DOUBLE_EQ(solid.value("integrator_steps"), std::round(5.0 * window / step));
    errors.push_back(worst / solid.value("elastic_energy"));
  }
  EXPECT_LT(errors[0], 0.1);
  EXPECT_GT(errors[0] / errors[1], 3.0);
  EXPECT_GT(errors[1] / errors[2], 3.0);
}

TEST(DynamicSolid, EnergyMeetsTheWorkOfAMovingFaceAndAPlateUnderDamping) {
  std::vector<double> errors;
  for (const double safety : {0.8, 0.4}) {
    Moving<3> solid({8, 6, 6});
    solid.safety = safety;
    solid.damping = 0.4;
    solid.boundary.fixed(0, {0.01, 0.02, 0.0}, {}, Schedule::ramp(3.0));
    solid.boundary.rigid_plate(1, 0.2, Schedule::ramp(2.0));
    solid.start();
    solid.advance(20.0);
    EXPECT_GT(solid.value("damped_energy"), 0.1 * solid.value("external_work"));
    errors.push_back(std::abs(solid.energy_error()) / solid.value("external_work"));
  }
  EXPECT_LT(errors[0], 1e-2);
  EXPECT_GT(errors[0] / errors[1], 3.0);
}

TEST(DynamicSolid, AFreeBodyGainsTheImpulseOfItsLoads) {
  Moving<3> solid(test::ball_body<3>(2.0, 0.5));
  const Vector<3> load = {0.1, -0.2, 0.3};
  solid.boundary.body_force(load);
  solid.start();
  solid.advance(4.0);
  const auto v = solid.port("velocity").value;
  const Index n = solid.body->points().size();
  for (int a = 0; a < 3; ++a) {
    double momentum = 0.0, volume = 0.0;
    for (Index i = 0; i < n; ++i) {
      momentum += density * solid.body->points().volume[i] * v[a * n + i];
      volume += solid.body->points().volume[i];
    }
    EXPECT_NEAR(momentum / (4.0 * volume), load[a], 1e-12);
  }
}

/// Ends where QuasiStaticSolid is at once, under the same boundary and pore stress.
template <int D>
void expect_quasi_static_limit(std::shared_ptr<const Body<D>> body,
                               const std::function<void(SolidBoundary<D>&)>& hold) {
  Moving<D> moving(body);
  hold(moving.boundary);
  moving.damping = 1.0;
  moving.start();
  test::Solid<D> still(body);
  hold(still.boundary);
  still.start();
  for (const PortView& input : {moving.port("pore_stress"), still.port("pore_stress")}) {
    for (std::size_t i = 0; i < input.value.size(); ++i) {
      input.value[i] = 0.05 * std::sin(0.3 * static_cast<double>(i));
    }
  }
  moving.advance(150.0);
  still.step(150.0);
  const auto ports = still.module->ports();
  for (std::size_t id = 0; id < ports.size(); ++id) {
    if (ports[id].direction == PortDirection::in || ports[id].role != PortRole::field) continue;
    const auto expected = still.module->port(static_cast<PortId>(id)).value;
    const auto found = moving.port(ports[id].name).value;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], 1e-6 * test::largest(expected)) << ports[id].name;
    }
  }
}

TEST(DynamicSolid, ComesToRestInEquilibriumUnderTwoPlates) {
  expect_quasi_static_limit<2>(test::box_body<2>({9, 7}, 0.5), [](SolidBoundary<2>& boundary) {
    boundary.roller(0, 0.01, 0.0, Schedule::ramp(5.0));
    boundary.fixed(2, {0.0, 0.0});
    boundary.rigid_plate(1, 0.3, Schedule::ramp(5.0));
    boundary.rigid_plate(3, 0.5, Schedule::ramp(5.0));
  });
}

TEST(DynamicSolid, ComesToRestInEquilibriumOnLayers) {
  const auto body = test::layered_box<2>({10, 9}, 0.5, {0, 3});
  expect_quasi_static_limit<2>(body, [](SolidBoundary<2>& boundary) {
    boundary.fixed(0, {0.01, 0.0}, {}, Schedule::ramp(5.0));
    boundary.rigid_plate(3, 0.5, Schedule::ramp(5.0));
  });
}

/// A mirrored plate has no mass: at every time its own row balances its load.
TEST(DynamicSolid, APlateIsInEquilibriumWhileTheBodyMoves) {
  Moving<2> solid({9, 7});
  solid.boundary.roller(0, 0.0);
  solid.boundary.rigid_plate(1, 0.3);
  solid.boundary.rigid_plate(3, -0.2);
  solid.start();
  for (int n = 0; n < 3; ++n) {
    solid.advance(0.37 * n);
    const std::vector<double> u = solid.field("displacement");
    auto elastic = test::elastic<2>(*solid.body, solid.boundary, solid.law);
    std::vector<double> force(u.size()), theta(solid.body->points().size());
    elastic->apply(u, {}, force, theta);
    const auto reaction = [&](const std::string& name) {
      const auto at = std::ranges::find(u, solid.value(name)) - u.begin();
      return force[at];
    };
    EXPECT_NEAR(reaction("right_plate_displacement"), -0.3, 1e-12);
    EXPECT_NEAR(reaction("top_plate_displacement"), 0.2, 1e-12);
  }
}

/// A pore stress that falls by b with dilatation is a rock with lambda + b: the same motion and the
/// same stable step.
TEST(DynamicSolid, TheSlopeOfThePoreStressStiffensTheRock) {
  const double b = 7.0;
  const auto solid = [](double stiffening, double slope) {
    Moving<2> solid({9, 7});
    solid.boundary.roller(0, 0.0);
    solid.boundary.rigid_plate(3, 0.3);
    solid.boundary.traction(1, {0.1, 0.05});
    solid.law.lame_lambda += stiffening;
    solid.start();
    std::ranges::fill(solid.port("pore_stress").slope, slope);
    solid.advance(0.0);
    solid.advance(3.0);
    return solid;
  };
  Moving<2> stiff = solid(b, 0.0), coupled = solid(0.0, -b);
  EXPECT_NEAR(coupled.module->stable_time_step() / stiff.module->stable_time_step(), 1.0, 1e-12);
  EXPECT_LT(coupled.module->stable_time_step(), 0.8 * solid(0.0, 0.0).module->stable_time_step());
  const auto found = coupled.port("displacement").value,
             expected = stiff.port("displacement").value;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-11 * test::largest(expected));
  }
}

TEST(DynamicSolid, FollowsThePoreStressWithinAWindow) {
  const auto after = [](int windows) {
    Moving<2> solid({9, 7});
    solid.boundary.roller(0, 0.0);
    solid.start();
    const PortView input = solid.port("pore_stress");
    // From 0 at rate 0.1 per second, over eight steps.
    const double length = 8.0 * solid.module->stable_time_step();
    for (int n = 1; n <= windows; ++n) {
      std::ranges::fill(input.value, 0.1 * n * length / windows);
      std::ranges::fill(input.rate, 0.1);
      solid.advance(length / windows);
    }
    const auto u = solid.port("displacement").value;
    return std::vector<double>(u.begin(), u.end());
  };
  const auto once = after(1), often = after(8);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_NEAR(once[i], often[i], 1e-12 * test::largest(once));
  }
}

TEST(DynamicSolid, AWindowOfNoLengthMovesNothing) {
  Moving<2> solid({12, 7});
  solid.boundary.traction(1, {0.1, 0.05});
  solid.start();
  solid.advance(0.0);
  EXPECT_EQ(test::largest(solid.port("displacement").value), 0.0);
  EXPECT_GT(test::largest(solid.field("acceleration")), 0.0);
}

TEST(DynamicSolid, HeldPointsMoveWithTheirSchedule) {
  Moving<2> solid(test::layered_box<2>({10, 9}, 0.5, {0}));
  solid.boundary.fixed(0, {0.0, 0.0}, {0.02, -0.01});
  solid.start();
  solid.advance(2.0);
  const Index n = solid.body->points().size();
  for (const Index i : solid.body->layer(0)) {
    EXPECT_NEAR(solid.port("displacement").value[i], 0.04, 1e-15);
    EXPECT_NEAR(solid.port("velocity").value[i], 0.02, 1e-12);
    EXPECT_NEAR(solid.port("velocity").value[n + i], -0.01, 1e-12);
  }
}

}  // namespace
}  // namespace perifrac
