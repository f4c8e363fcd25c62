#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/free_fluid.hpp"
#include "app/references/moving_points.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/solutions/martin_moyce.hpp"

namespace perifrac {

namespace {

const std::string dam_break_problem = "the collapse of a column";

Box read_column(const Section& scene) {
  require_absent(scene, dam_break_problem,
                 {"body", "fluid.walls", "fluid.inlets", "fluid.outlets"});
  const Box column = read_block(scene, dam_break_problem);
  const int vertical = scene.integer("dimension") - 1;
  if (column.from != scene.numbers("fluid.container.from") ||
      std::abs(column.size(vertical) - 2.0 * column.size(0)) > 1e-6 * column.size(0)) {
    scene.fail("reference.type", "this scene is not " + dam_break_problem,
               "a block in the container's left corner that is twice as high as wide");
  }
  return column;
}

}  // namespace

std::unique_ptr<Reference> make_dam_break_reference(const Section& scene,
                                                    const Simulation& simulation) {
  const Box column = read_column(scene);
  const FreeFluid fluid = read_free_fluid(scene);
  const double width = column.size(0);
  const double time_scale = std::sqrt(0.5 * width / read_weight(scene, dam_break_problem));
  const Field pressure = field_named(*simulation.manager, "fluid_pressure");
  const Reference::Computed edge = edge_of(pressure, 0, fluid.spacing);
  const double left = column.from[0];
  const auto computed = [=] { return edge() - left; };
  const auto exact = [=](double t) { return width * martin_moyce::front(t / time_scale); };

  auto reference =
      std::make_unique<Reference>("dam_break", "Martin and Moyce's experiment", time_scale);
  reference->add(Reference::Error{
      "front_error", [=](double t) { return std::abs(computed() - exact(t)) / exact(t); }});
  reference->add(Reference::History{"front at the floor", "m", computed, exact});
  return reference;
}

}  // namespace perifrac
