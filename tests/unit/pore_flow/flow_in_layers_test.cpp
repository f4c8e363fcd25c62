#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Method;
using test::scalar;

/// Errors against Terzaghi's series of a column that drains through a layer, with the drained face
/// at the nominal plane and at the centres of the layer's first points.
struct DrainageErrors {
  double nominal = 0.0;
  double first_centres = 0.0;
};

DrainageErrors errors_of_drainage(int count, FlowScheme scheme, Method method) {
  const double spacing = 1.0 / count;
  const auto body = test::body_with_layer_on_top<2>({4, count}, spacing);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(3, 0.0);
  DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary, test::some_rock, scheme), {1.0},
                    test::integrator_maker<2>(method, 1e-7, 0.2));
  flow.initialize(0.0);
  const double diffusivity = test::some_rock.mobility / test::some_rock.storage;
  const double height = 1.0 + 0.5 * spacing;
  DrainageErrors errors;
  double t = 0.0;
  for (const double time_factor : {0.1, 0.5}) {
    flow.advance({t, time_factor / diffusivity});
    t = time_factor / diffusivity;
    const auto p = test::port(flow, "pore_pressure").value;
    for (Index i = 0; i < body->points().size(); ++i) {
      const double z = body->points().position[1][i];
      if (z > 1.0) {
        EXPECT_EQ(p[i], 0.0);
        continue;
      }
      const double in_column = test::drained_column(z, time_factor);
      const double to_centres = test::drained_column(z / height, time_factor / (height * height));
      errors.nominal = std::max(errors.nominal, std::abs(p[i] - in_column));
      errors.first_centres = std::max(errors.first_centres, std::abs(p[i] - to_centres));
    }
  }
  return errors;
}

TEST(FlowInLayers, DrainsAsFromTheCentresOfTheFirstPoints) {
  for (const FlowScheme scheme : {FlowScheme::conservative, FlowScheme::bond}) {
    for (const Method method : test::methods) {
      const DrainageErrors coarse = errors_of_drainage(20, scheme, method);
      const DrainageErrors fine = errors_of_drainage(40, scheme, method);
      const double order = std::log2(coarse.nominal / fine.nominal);
      const double order_of_centres = std::log2(coarse.first_centres / fine.first_centres);
      RecordProperty(fmt::format("drained_{}_{}", test::name_of(scheme), static_cast<int>(method)),
                     fmt::format("nominal {:.2e}, order {:.2f}; first centres {:.2e}, order {:.2f}",
                                 fine.nominal, order, fine.first_centres, order_of_centres));
      EXPECT_GT(order, 0.9) << test::name_of(scheme);
      EXPECT_LT(order, 1.1) << test::name_of(scheme);
      // A kink in the pressure at the first centres shifts the face by some hundredths of a
      // spacing.
      EXPECT_LT(fine.first_centres, 0.15 * fine.nominal) << test::name_of(scheme);
      EXPECT_GT(order_of_centres, 0.9) << test::name_of(scheme);
    }
  }
}

/// Dilatation that changes from window to window, and jumps between them as corrected inputs do.
void squeeze(DarcyFlow<2>& flow, double begin, double end) {
  const PortView dilatation = test::port(flow, "dilatation");
  for (std::size_t i = 0; i < dilatation.value.size(); ++i) {
    dilatation.value[i] = 0.3 * std::sin(0.7 * static_cast<double>(i) + 9.0 * end);
    dilatation.rate[i] = end > begin ? 0.2 / (end - begin) : 0.0;
    dilatation.slope[i] = 0.1;
  }
}

TEST(FlowInLayers, KeepMassAndPressureWhileTheyAreSqueezed) {
  for (const Method method : test::methods) {
    const auto body = test::body_with_layer_on_top<2>({8, 9}, 0.5);
    PoreBoundary<2> boundary(*body);
    boundary.pressure(3, 0.6);
    boundary.pressure(0, -0.2);
    boundary.source(7, 0.05);
    DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {0.5},
                      test::integrator_maker<2>(method, 1e-5));
    flow.initialize(0.0);
    const double before = scalar(flow, "pore_fluid_mass");
    double moved = 0.0, drift = 0.0, t = 0.0;
    squeeze(flow, 0.0, 0.0);
    flow.advance({0.0, 0.0});
    EXPECT_EQ(scalar(flow, "pore_fluid_gained"), 0.0) << "nothing flows in no time";
    for (int window = 1; window <= 30; ++window) {
      const double end = 0.02 * window;
      squeeze(flow, t, end);
      flow.advance({t, end});
      t = end;
      for (const Index i : body->layer(3)) {
        EXPECT_EQ(test::port(flow, "pore_pressure").value[i], 0.6);
      }
      const double gained = scalar(flow, "pore_fluid_gained");
      moved = std::max(moved, std::abs(gained));
      drift = std::max(drift, std::abs(scalar(flow, "pore_fluid_mass") - before - gained));
    }
    EXPECT_GT(moved, 0.5) << "too little for the drift to mean something";
    EXPECT_LT(drift, 1e-12 * moved) << static_cast<int>(method);

    // The layer's fluid has followed its pressure and dilatation.
    const auto [alpha, storage, mobility, density] = test::some_rock;
    const PortView dilatation = test::port(flow, "dilatation");
    for (const Index i : body->layer(3)) {
      const double theta = dilatation.value[i] + dilatation.slope[i] * alpha * 0.6;
      const double content = alpha * theta + storage * 0.6;
      EXPECT_NEAR(test::port(flow, "fluid_content").value[i], content,
                  method == Method::forward_euler ? 1e-13 : 0.02);
    }
  }
}

TEST(FlowInLayers, BalanceEnergyOfASteadySqueeze) {
  const auto body = test::body_with_layer_on_top<2>({8, 9}, 0.5);
  PoreBoundary<2> boundary(*body);
  boundary.pressure(3, 0.6);
  DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {0.2},
                    test::integrator_maker<2>(Method::direct, 1e-8));
  flow.initialize(0.0);
  const double before = scalar(flow, "pore_fluid_energy");
  flow.advance({0.0, 2.0});
  const double gained = scalar(flow, "pore_fluid_work");
  const double gap =
      scalar(flow, "pore_fluid_energy") - before - gained + scalar(flow, "darcy_dissipation");
  EXPECT_LT(std::abs(gap), 1e-6 * gained);
  EXPECT_GT(scalar(flow, "darcy_dissipation"), 0.1 * gained);
}

TEST(FlowInLayers, HoldALinearPressureToTheFirstCentres) {
  const auto body = test::body_with_layer_on_top<3>({6, 5, 14}, 0.5);
  PoreBoundary<3> boundary(*body);
  boundary.pressure(4, 1.0);
  boundary.pressure(5, 0.0);
  for (const FlowScheme scheme : test::schemes) {
    auto system = test::darcy_system<3>(*body, boundary, test::some_rock, scheme);
    std::vector<double> y(system.size(), 0.0), rate(system.size());
    // Exact where no family reaches past the first centres: flat behind, linear before.
    for (Index i = 0; i < system.points(); ++i) {
      y[i] = test::some_rock.storage * (1.0 - body->points().position[2][i] / 7.25);
    }
    system.rhs(0.0, y, rate);
    for (Index i = 0; i < system.points(); ++i) {
      if (body->points().position[2][i] > 7.0 - 2.0 * body->horizon()) continue;
      EXPECT_NEAR(rate[i], 0.0, 1e-12) << test::name_of(scheme);
    }
  }
}

TEST(FlowInLayers, AreDryWhereTheyAreSealed) {
  for (const Method method : test::methods) {
    const auto body = test::body_with_layer_on_top<2>({8, 9}, 0.5);
    PoreBoundary<2> boundary(*body);
    boundary.pressure(2, 0.6);
    DarcyFlow<2> flow(body, test::darcy_system<2>(*body, boundary), {0.2},
                      test::integrator_maker<2>(method, 1e-6));
    flow.initialize(0.0);
    const double before = scalar(flow, "pore_fluid_mass");
    flow.advance({0.0, 100.0});
    const auto p = test::port(flow, "pore_pressure").value;
    for (Index i = 0; i < body->points().size(); ++i) {
      const bool dry = body->points().position[1][i] > 4.5;
      EXPECT_NEAR(p[i], dry ? 0.0 : 0.6, dry ? 0.0 : 1e-4);
    }
    const double gained = scalar(flow, "pore_fluid_gained");
    EXPECT_NEAR(scalar(flow, "pore_fluid_mass") - before, gained, 1e-12 * gained);
  }
}

TEST(FlowInLayers, ShareTheInflowThroughTheirFace) {
  const auto body = test::body_with_layer_on_top<3>({6, 5, 7}, 0.5);
  PoreBoundary<3> boundary(*body);
  boundary.flux(5, 0.14);
  ASSERT_TRUE(boundary.has_sources());
  const Eigen::VectorXd sources = boundary.sources({}).at(0.0);
  EXPECT_NEAR(sources.sum(), 0.14 * 3.0 * 2.5, 1e-14);
  double in_layer = 0.0;
  for (const Index i : body->layer(5)) in_layer += sources[i];
  EXPECT_NEAR(in_layer, sources.sum(), 1e-14);
}

}  // namespace
}  // namespace perifrac
