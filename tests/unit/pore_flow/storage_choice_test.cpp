#include "modules/pore_flow/storage/storage_choice.hpp"

#include <gtest/gtest.h>

#include "modules/pore_flow/storage/stabilised_storage.hpp"
#include "tests/contract/scene_text.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

constexpr double biot = 0.8, storage = 0.03;

const std::string scene_text = R"(
dimension: 2
body: {shape: box, size: [8 m, 7 m], spacing: 1 m}
time: {end: 1 s}
solid: {type: quasi_static, material: {youngs_modulus: 15 GPa, poisson_ratio: 0.25}}
pore_flow:
  {type: darcy, permeability: 1e-15 m^2, porosity: 0.2, fluid: {bulk_modulus: 2.2 GPa, viscosity: 1 mPa s}}
)";

/// What the scene leaves open, for rock whose dilatation answers everywhere by this over what would
/// make biot^2 slope a quarter of the storage.
struct Choice {
  std::shared_ptr<const Body<2>> body = test::box_body<2>({8, 7}, 1.0);
  std::vector<double> value = std::vector<double>(56), rate = value, slope;
  PoreMaterials materials{{{biot, 0.2, 0.0, storage}}, std::vector<std::uint8_t>(56)};
  std::unique_ptr<PoreStorage> made;

  explicit Choice(double part) : slope(56, part * 0.25 * storage / (biot * biot)) {
    const Section scene = read_scene_text(scene_text);
    made = storage_choice<2>(scene.at("pore_flow"), body, materials)(slope);
  }
  double energy_between(PoreStorage& stored) const {
    stored.set_dilatation({value, rate, slope, 0.0});
    return stored.energy_between_points(test::random_values(56, 1));
  }
};

TEST(StorageChoice, StabilisesByAQuarterWhereCouplingIsStrongerThanAQuarter) {
  EXPECT_EQ(Choice(0.99).made, nullptr);
  const Choice choice(1.01);
  ASSERT_NE(choice.made, nullptr);
  StabilisedStorage<2> quarter(choice.materials, choice.body->family(0), 0.25, 1.0);
  const double expected = choice.energy_between(quarter);
  EXPECT_GT(expected, 0.0);
  EXPECT_EQ(choice.energy_between(*choice.made), expected);
}

}  // namespace
}  // namespace perifrac
