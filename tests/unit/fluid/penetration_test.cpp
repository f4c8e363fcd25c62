#include <algorithm>

#include <fmt/format.h>

#include "tests/unit/fluid/fluid_run.hpp"

/// Fluid thrown at a wall does not enter it.
namespace perifrac::test {
namespace {

struct Throw {
  double mach;    ///< speed over that of sound
  double offset;  ///< of its points along the wall from those of the wall, in spacings
};

void PrintTo(const Throw& t, std::ostream* out) {
  *out << "mach " << t.mach << ", offset " << t.offset;
}

constexpr double sound_speed = 31.6227766;

constexpr const char* fluid = R"(
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 cP
)";

/// How deep any point came into the box from `low` to `high` in so many steps [m]; negative: none.
double deepest(const std::string& scene, const std::vector<double>& low,
               const std::vector<double>& high, int steps) {
  FluidRun run(scene);
  double most = -1.0;
  for (int n = 0; n < steps; ++n) {
    run.steps(1);
    std::vector<std::vector<double>> x;
    for (int a = 0; a < run.dimension(); ++a) {
      x.push_back(run.field(std::string("position_") + "xyz"[a]));
    }
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      double depth = 1.0;
      for (int a = 0; a < run.dimension(); ++a) {
        depth = std::min({depth, x[a][i] - low[a], high[a] - x[a][i]});
      }
      most = std::max(most, depth);
    }
  }
  return most;
}

class FluidThrownAtAWall : public testing::TestWithParam<Throw> {
 protected:
  double speed() const { return GetParam().mach * sound_speed; }
  double low() const { return 0.5 + 0.1 * GetParam().offset; }
  std::string jet_2d() const {
    return fmt::format(
        "  blocks: [{{name: jet, from: [0.3 m, {} m], to: [2 m, {} m], "
        "velocity: [{} m/s, 0 m/s]}}]\n",
        low(), low() + 0.4, -speed());
  }
};

TEST_P(FluidThrownAtAWall, StaysOutsideIn2D) {
  const std::string wall = "  walls: [{name: wall, from: [-0.3 m, -1 m], to: [0 m, 3 m]}]\n";
  EXPECT_LT(deepest("dimension: 2\ntime: {end: 10 s}\n" + (fluid + jet_2d()) + wall, {-0.3, -1.0},
                    {0.0, 3.0}, 500),
            0.0);
}

TEST_P(FluidThrownAtAWall, StaysOutsideOfAContainer) {
  const std::string container = "  container: {from: [0 m, 0 m], to: [2 m, 1.5 m]}\n";
  EXPECT_LT(deepest("dimension: 2\ntime: {end: 10 s}\n" + (fluid + jet_2d()) + container,
                    {-1.0, -1.0}, {0.0, 2.5}, 1000),
            0.0);
}

TEST_P(FluidThrownAtAWall, StaysOutsideIn3D) {
  const std::string scene = fmt::format(
      R"(dimension: 3
time: {{end: 10 s}}
{}  blocks: [{{name: jet, from: [0.3 m, {} m, {} m], to: [1.3 m, {} m, {} m], velocity: [{} m/s, 0 m/s, 0 m/s]}}]
  walls: [{{name: wall, from: [-0.3 m, -0.5 m, -0.5 m], to: [0 m, 2 m, 2 m]}}]
)",
      fluid, low(), low(), low() + 0.4, low() + 0.4, -speed());
  EXPECT_LT(deepest(scene, {-0.3, -0.5, -0.5}, {0.0, 2.0, 2.0}, 250), 0.0);
}

/// One point by itself has no pressure that could stop it.
TEST_P(FluidThrownAtAWall, OnePointIsStoppedToo) {
  const std::string scene = fmt::format(
      "dimension: 2\ntime: {{end: 10 s}}\n{}  blocks: [{{name: drop, from: [0.3 m, {} m], to: [0.4 "
      "m, "
      "{} m], velocity: [{} m/s, 0 m/s]}}]\n  walls: [{{name: wall, from: [-0.3 m, -1 m], to: [0 "
      "m, 3 "
      "m]}}]\n",
      fluid, low(), low() + 0.1, -speed());
  EXPECT_LT(deepest(scene, {-0.3, -1.0}, {0.0, 3.0}, 300), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Fluid, FluidThrownAtAWall,
                         testing::Values(Throw{0.1, 0.0}, Throw{0.3, 0.0}, Throw{0.1, 0.5},
                                         Throw{0.3, 0.5}, Throw{0.3, 0.3}),
                         [](const auto& info) { return "throw_" + std::to_string(info.index); });

}  // namespace
}  // namespace perifrac::test
