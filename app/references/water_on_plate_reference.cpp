#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/references/comparison.hpp"
#include "app/references/free_fluid.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/beam_section.hpp"

namespace perifrac {

namespace {

const std::string water_on_plate_problem = "water on a clamped plate";

/// Deflection in the middle [m], downwards negative.
double read_deflection(const Section& scene) {
  if (scene.integer("dimension") != 2) {
    scene.fail("reference.type", "the plate is plane", "dimension: 2");
  }
  require_word(scene, water_on_plate_problem, "body.shape", {"box"});
  require_word(scene, water_on_plate_problem, "solid.type", {"quasi_static", "dynamic"});
  for (const char* const side : {"left", "right"}) {
    require_word(scene, water_on_plate_problem, std::string("solid.boundary.") + side + ".type",
                 {"fixed"});
  }
  require_absent(scene, water_on_plate_problem,
                 {"pore_flow", "solid.regions", "solid.body_force", "solid.boundary.top",
                  "solid.boundary.bottom", "fluid.walls", "fluid.inlets", "fluid.outlets"});
  const std::vector<double> size = scene.numbers("body.size");
  const Box water = read_block(scene, water_on_plate_problem);
  if (water.from != std::vector{0.0, size[1]} || water.to[0] != size[0]) {
    scene.fail("reference.type", "this scene is not " + water_on_plate_problem,
               "a block of fluid that covers the body");
  }
  const double gravity = read_weight(scene, water_on_plate_problem);
  const double load = read_free_fluid(scene).pressure_at_rest(water.size(1), gravity) +
                      scene.number("solid.density") * gravity * size[1];
  const ElasticRock plate = read_elastic_rock(scene);
  const BeamSection section(plate.youngs_modulus(), plate.poisson_ratio(), size[1]);
  const double length = size[0] + outside(scene, "left") + outside(scene, "right");
  return -section.clamped_deflection(length, load);
}

}  // namespace

std::unique_ptr<Reference> make_water_on_plate_reference(const Section& scene,
                                                         const Simulation& simulation) {
  const double deflection = read_deflection(scene);
  const std::vector<double> size = scene.numbers("body.size");
  const Field displacement = field_named(*simulation.manager, "displacement");
  const auto computed = value_at(simulation, displacement, {0.5 * size[0], 0.5 * size[1]}, 1);

  auto reference =
      std::make_unique<Reference>("water_on_plate", "Timoshenko's beam, clamped at both ends", 0.0);
  reference->add(Reference::Error{"deflection_error",
                                  [=](double) { return std::abs(computed() / deflection - 1.0); }});
  const std::size_t history = reference->add(Reference::History{
      "deflection at the middle", "m", computed, [=](double) { return deflection; }});
  reference->add(Reference::Figure{
      .name = "late deflection",
      .unit = "m",
      .exact = deflection,
      .scale = std::abs(deflection),
      .history = history,
      .computed = [](auto times, auto values) -> std::optional<double> {
        const auto from = std::ranges::lower_bound(times, 0.75 * times.back()) - times.begin();
        const auto late = values.subspan(from);
        return std::reduce(late.begin(), late.end()) / static_cast<double>(late.size());
      }});
  return reference;
}

}  // namespace perifrac
