#include "modules/fluid/as_published/damaged_walls.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tests/port_named.hpp"
#include "tests/unit/fluid/fluid_run.hpp"

/// Rock that fluid may enter where its bonds are broken, as published.
namespace perifrac::test {
namespace {

/// A jet of two rows thrown at the flat top of a rock, at a tenth of the speed of sound.
std::string scene(const std::string& interface) {
  return fmt::format(R"(
dimension: 2
time: {{end: 1 s}}
body: {{shape: box, size: [2 m, 1 m], spacing: 0.1 m}}
solid:
  type: dynamic
  density: 2000 kg/m^3
  material: {{youngs_modulus: 1 GPa, poisson_ratio: 0.25}}
damage: {{type: critical_stretch, stretch: 0.01}}
interface: {}
fluid:
  type: semi_lagrangian
  bulk_modulus: 1 MPa
  viscosity: 1 cP
  blocks: [{{name: jet, from: [0.9 m, 1.1 m], to: [1.1 m, 1.5 m], velocity: [0.5 m/s, -3 m/s]}}]
)",
                     interface);
}

struct Outcome {
  double lowest;      ///< of all points [m]; the rock's top is at 1 m
  double mass_error;  ///< over all mass
  double momentum_error;
};

/// What becomes of the jet in so many steps where all points of the rock but the lowest rows are
/// damaged so far.
Outcome thrown(const std::string& interface, double damage, int steps = 200) {
  FluidRun run(scene(interface));
  if (run.has("damage")) {
    const PortView view = test::port_named(run.module(), "damage");
    for (std::size_t i = 0; i < view.value.size(); ++i) {
      view.value[i] = view.points->position[1][i] > 0.4 ? damage : 0.0;
    }
  }
  const double mass = run.value("free_fluid_mass");
  const double before = run.momentum(1);
  Outcome result{.lowest = 2.0, .mass_error = 0.0, .momentum_error = 0.0};
  double given = 0.0;
  for (int n = 0; n < steps; ++n) {
    run.steps(1);
    const auto impulse = run.values("interface_impulse");
    for (std::size_t k = impulse.size() / 2; k < impulse.size(); ++k) given += impulse[k];
    result.lowest = std::min(result.lowest, std::ranges::min(run.field("position_y")));
  }
  result.mass_error = std::abs(run.value("free_fluid_mass") / mass - 1.0);
  result.momentum_error = std::abs((run.momentum(1) + given) / before - 1.0);
  EXPECT_GT(std::abs(given / before), 1e-3) << "the jet met no rock";
  return result;
}

const char* const no_repulsion = "{force: one_sided, repulsion: 0, damaged_rock: open}";

TEST(DamagedWalls, FluidEntersBrokenRock) {
  const Outcome broken = thrown(no_repulsion, 0.9);
  EXPECT_LT(broken.lowest, 0.8);
  EXPECT_LT(broken.mass_error, 1e-14);
  EXPECT_LT(broken.momentum_error, 1e-12);
}

TEST(DamagedWalls, FluidStaysOutOfIntactRock) {
  const Outcome intact = thrown(no_repulsion, 0.0);
  EXPECT_GT(intact.lowest, 1.0);
  EXPECT_LT(intact.momentum_error, 1e-12);
}

/// What damage makes permeable, the repulsion of Eq 24 keeps shut.
TEST(DamagedWalls, RepulsionKeepsFluidOut) {
  EXPECT_GT(thrown("{force: one_sided, repulsion: 1, damaged_rock: open}", 0.9).lowest, 1.0);
}

TEST(DamagedWalls, AskForNothingWhereFluidStaysOut) {
  FluidRun run(scene("{force: one_sided}"));
  EXPECT_FALSE(run.has("damage"));
}

/// A point stands in for fluid by the bonds that it has left, and gets its surface back where a
/// window is taken back.
TEST(DamagedWalls, ArePureFunctionsOfDamage) {
  WallCloud<2> cloud;
  cloud.add({0.0, 0.0}, {0.0, 1.0}, 0.5, 2.0, false, 0);  // rigid: never damaged
  cloud.rigid_count = 1;
  cloud.add({1.0, 0.0}, {0.0, 1.0}, 0.5, 2.0, false, 0);
  cloud.add({2.0, 0.0}, {0.0, 1.0}, 1.5, 2.0, false, 1);
  const WallCloud<2> before = cloud;
  DamagedWalls<2> walls(cloud);
  EXPECT_TRUE(walls.apply(std::vector{0.25, 0.0}, cloud));
  EXPECT_FALSE(walls.apply(std::vector{0.25, 0.0}, cloud));
  EXPECT_EQ(cloud.volume, (std::vector{2.0, 1.5, 2.0}));
  EXPECT_EQ(cloud.normal[1], (std::vector{1.0, 0.0, 1.0}));
  EXPECT_EQ(cloud.depth, (std::vector{0.5, 0.0, 1.5}));
  EXPECT_TRUE(walls.apply(std::vector{0.0, 0.0}, cloud));
  EXPECT_EQ(cloud.volume, before.volume);
  EXPECT_EQ(cloud.normal, before.normal);
  EXPECT_EQ(cloud.depth, before.depth);
}

}  // namespace
}  // namespace perifrac::test
