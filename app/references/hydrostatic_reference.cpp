#include <cmath>

#include "app/references/comparison.hpp"
#include "app/references/free_fluid.hpp"
#include "app/references/moving_points.hpp"
#include "app/references/reference_types.hpp"

namespace perifrac {

namespace {

const std::string hydrostatic_problem = "fluid at rest in a tank";

Box read_tank(const Section& scene) {
  require_absent(scene, hydrostatic_problem,
                 {"body", "fluid.walls", "fluid.inlets", "fluid.outlets"});
  require_word(scene, hydrostatic_problem, "fluid.container.faces.top", {"open"});
  const Box block = read_block(scene, hydrostatic_problem);
  const Box container = read_box(scene, "fluid.container");
  const std::size_t vertical = block.from.size() - 1;
  bool covers = block.from == container.from;
  for (std::size_t a = 0; a < vertical; ++a) covers = covers && block.to[a] == container.to[a];
  if (!covers || scene.number("fluid.blocks[0].pressure") != 0.0) {
    scene.fail("reference.type", "this scene is not " + hydrostatic_problem,
               "a block without pressure above it that covers the container's floor");
  }
  return block;
}

/// Root mean square over the points.
template <class Deviation>
double root_mean_square(std::size_t count, Deviation deviation) {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += deviation(i) * deviation(i);
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

std::unique_ptr<Reference> make_hydrostatic_reference(const Section& scene,
                                                      const Simulation& simulation) {
  const Box tank = read_tank(scene);
  const FreeFluid fluid = read_free_fluid(scene);
  const double gravity = read_weight(scene, hydrostatic_problem);
  const int vertical = scene.integer("dimension") - 1;
  const double floor = tank.from[vertical], surface = tank.to[vertical];
  const double depth = surface - floor;
  const double weight = fluid.density * gravity * depth;
  const Field pressure = field_named(*simulation.manager, "fluid_pressure");
  const Field velocity = field_named(*simulation.manager, "fluid_velocity");
  const auto exact = [=](double z) { return fluid.pressure_at_rest(surface - z, gravity); };

  auto reference = std::make_unique<Reference>("hydrostatic", "A fluid at rest under its weight",
                                               std::sqrt(depth / gravity));
  reference->add(Reference::Error{
      "pressure_error", [=](double) {
        const auto z = pressure.points().position[vertical];
        const auto p = pressure.values();
        return root_mean_square(z.size(), [&](std::size_t i) { return p[i] - exact(z[i]); }) /
               weight;
      }});
  reference->add(Reference::Error{"velocity_error", [=](double) {
                                    const auto v = velocity.values();
                                    return root_mean_square(v.size(),
                                                            [&](std::size_t k) { return v[k]; }) /
                                           std::sqrt(gravity * depth);
                                  }});
  const double lowest = floor + 0.5 * fluid.spacing;
  reference->add(
      Reference::History{"fluid pressure at the floor", "Pa",
                         mean_between(pressure, 0, vertical, floor, floor + fluid.spacing),
                         [=](double) { return exact(lowest); }});
  reference->add(Reference::History{"height at the surface", "m",
                                    edge_of(pressure, vertical, fluid.spacing),
                                    [=](double) { return surface; }});
  reference->add(profile_over_layers(pressure, 0, vertical, floor, surface, fluid.spacing,
                                     "fluid pressure", [=](double z, double) { return exact(z); }));
  return reference;
}

}  // namespace perifrac
