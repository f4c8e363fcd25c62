#include "app/references/free_fluid.hpp"

#include <cmath>

#include "app/references/comparison.hpp"

namespace perifrac {

double FreeFluid::pressure_at_rest(double depth, double gravity) const {
  // dp/d(depth) = gravity density (1 + gamma p / K)^(1/gamma), integrated.
  const double rise = density * gravity * depth / bulk_modulus;
  const double gamma = tait_exponent;
  if (gamma == 1.0) return bulk_modulus * std::expm1(rise);
  return bulk_modulus / gamma *
         std::expm1(gamma / (gamma - 1.0) * std::log1p((gamma - 1.0) * rise));
}

FreeFluid read_free_fluid(const Section& scene) {
  const Section fluid = scene.at("fluid");
  const bool linear = fluid.word("equation_of_state") == "linear";
  return {.density = fluid.number("density"),
          .bulk_modulus = fluid.number("bulk_modulus"),
          .tait_exponent = linear ? 1.0 : fluid.number("tait_exponent"),
          .viscosity = fluid.number("viscosity"),
          .spacing = fluid.has("spacing") ? fluid.number("spacing") : scene.number("body.spacing")};
}

double read_weight(const Section& scene, const std::string& problem) {
  const auto refuse = [&] {
    scene.fail("reference.type", "this scene is not " + problem, "gravity straight down");
  };
  if (!scene.has("gravity")) refuse();
  std::vector<double> gravity = scene.numbers("gravity");
  const double down = -gravity.back();
  gravity.pop_back();
  for (const double sideways : gravity) {
    if (sideways != 0.0) refuse();
  }
  if (down <= 0.0) refuse();
  return down;
}

Box read_box(const Section& scene, const std::string& path) {
  return {scene.numbers(path + ".from"), scene.numbers(path + ".to")};
}

Box read_block(const Section& scene, const std::string& problem) {
  if (scene.count("fluid.blocks") != 1) {
    scene.fail("reference.type", "this scene is not " + problem, "one item under fluid.blocks");
  }
  return read_box(scene, "fluid.blocks[0]");
}

}  // namespace perifrac
