#include "app/references/solutions/layered_column_solution.hpp"

#include <gtest/gtest.h>

#include "app/references/solutions/terzaghi_solution.hpp"
#include "tests/unit/references/semi_discrete.hpp"

namespace perifrac {
namespace {

constexpr double traction = 1e6;
const ColumnLayer stiff{.thickness = 20.0,
                        .uniaxial_modulus = 1e10,
                        .biot_coefficient = 0.8,
                        .storage = 1.4e-10,
                        .mobility = 1e-8};
const ColumnLayer soft{.thickness = 30.0,
                       .uniaxial_modulus = 2e9,
                       .biot_coefficient = 1.0,
                       .storage = 2e-10,
                       .mobility = 1e-9};

double capacity(const ColumnLayer& layer) {
  return layer.storage + layer.biot_coefficient * layer.biot_coefficient / layer.uniaxial_modulus;
}

TEST(LayeredColumnSolution, OfEqualLayersIsTerzaghis) {
  for (const double thickness : {10.0, 25.0, 40.0}) {
    ColumnLayer lower = stiff;
    ColumnLayer upper = stiff;
    lower.thickness = thickness;
    upper.thickness = 50.0 - thickness;
    const LayeredColumnSolution layered(lower, upper, traction);
    const TerzaghiSolution terzaghi({stiff.uniaxial_modulus, stiff.biot_coefficient, stiff.storage,
                                     stiff.mobility, 50.0, traction});
    EXPECT_NEAR(layered.final_settlement(), terzaghi.final_settlement(), 1e-15);
    for (const double t : {0.0, 0.5, 5.0, 50.0}) {
      for (const double z : {1.0, 24.0, 26.0, 49.0}) {
        EXPECT_NEAR(layered.pressure(z, t), terzaghi.pressure(z, t), 1e-9 * traction);
        EXPECT_NEAR(layered.displacement(z, t), terzaghi.displacement(z, t), 1e-12);
      }
    }
  }
}

/// In either order, so that each layer lies at the drained end once.
class TwoLayers : public testing::TestWithParam<std::pair<ColumnLayer, ColumnLayer>> {};

TEST_P(TwoLayers, KeepPressureAndFluxContinuous) {
  const auto& [lower, upper] = GetParam();
  const LayeredColumnSolution column(lower, upper, traction);
  const double z = lower.thickness;
  const double h = 1e-3;
  for (const double t : {2.0, 20.0, 200.0}) {
    const double p = column.pressure(z, t);
    EXPECT_NEAR(column.pressure(z - 1e-12, t), p, 1e-9 * traction);
    const auto slope = [&](double s) {  // to second order, on the side of s
      return (4.0 * column.pressure(z + s, t) - 3.0 * p - column.pressure(z + 2.0 * s, t)) /
             (2.0 * s);
    };
    EXPECT_NEAR(lower.mobility * slope(-h), upper.mobility * slope(h),
                1e-4 * lower.mobility * std::abs(slope(-h)) + 1e-12 * traction * lower.mobility);
    EXPECT_NEAR(column.pressure(z + upper.thickness, t), 0.0, 1e-9 * traction);
    EXPECT_NEAR(column.pressure(h, t), column.pressure(-h, t), 1e-9 * traction);
  }
}

TEST_P(TwoLayers, StartUndrainedLayerByLayer) {
  const auto& [lower, upper] = GetParam();
  const LayeredColumnSolution column(lower, upper, traction);
  const auto expect_undrained = [&](const ColumnLayer& layer, double middle) {
    const double undrained =
        layer.biot_coefficient * traction / (layer.uniaxial_modulus * capacity(layer));
    EXPECT_NEAR(column.pressure(middle, 0.0), undrained, 1e-9 * traction);
    EXPECT_NEAR(column.pressure(middle, 0.02), undrained, 1e-4 * traction);
  };
  expect_undrained(lower, 0.5 * lower.thickness);
  expect_undrained(upper, lower.thickness + 0.5 * upper.thickness);
}

TEST_P(TwoLayers, AgreeWithCells) {
  const ColumnLayer& lower = GetParam().first;  // clang lets no lambda capture a binding
  const ColumnLayer& upper = GetParam().second;
  const LayeredColumnSolution column(lower, upper, traction);
  constexpr int cells = 250;  // of 0.2 m: the layers meet between two
  const double h = (lower.thickness + upper.thickness) / cells;
  const auto layer = [&](int i) -> const ColumnLayer& {
    return (i + 0.5) * h < lower.thickness ? lower : upper;
  };
  Eigen::MatrixXd storage = Eigen::MatrixXd::Zero(cells, cells);
  Eigen::MatrixXd flow = storage;
  Eigen::VectorXd start(cells);
  for (int i = 0; i < cells; ++i) {
    storage(i, i) = h * capacity(layer(i));
    start(i) =
        layer(i).biot_coefficient * traction / (layer(i).uniaxial_modulus * capacity(layer(i)));
    if (i == 0) continue;
    test::add_flow(flow, i - 1, i, 2.0 / (h / layer(i - 1).mobility + h / layer(i).mobility));
  }
  flow(cells - 1, cells - 1) += 2.0 * upper.mobility / h;
  const test::SemiDiscrete discrete(storage, flow, start);
  for (const double t : {5.0, 20.0, 100.0, 400.0}) {
    const Eigen::VectorXd p = discrete.at(t);
    double settlement = 0.0;
    for (int i = 0; i < cells; ++i) {
      EXPECT_NEAR(column.pressure((i + 0.5) * h, t), p(i), 1e-3 * start.maxCoeff()) << t;
      settlement += h * (traction - layer(i).biot_coefficient * p(i)) / layer(i).uniaxial_modulus;
    }
    EXPECT_NEAR(column.displacement(cells * h, t), -settlement, 3e-4 * settlement);
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, TwoLayers,
                         testing::Values(std::pair{stiff, soft}, std::pair{soft, stiff}));

}  // namespace
}  // namespace perifrac
