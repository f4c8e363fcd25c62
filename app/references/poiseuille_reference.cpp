#include <algorithm>
#include <cmath>

#include "app/references/comparison.hpp"
#include "app/references/free_fluid.hpp"
#include "app/references/moving_points.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/solutions/poiseuille_solution.hpp"

namespace perifrac {

namespace {

const std::string poiseuille_problem = "flow between two plates";

PoiseuilleProblem read_poiseuille(const Section& scene, const FreeFluid& fluid) {
  if (scene.integer("dimension") != 2) {
    scene.fail("reference.type", "the slit is plane", "dimension: 2");
  }
  require_absent(scene, poiseuille_problem,
                 {"body", "fluid.walls", "fluid.inlets", "fluid.outlets",
                  "fluid.container.faces.bottom", "fluid.container.faces.top"});
  require_word(scene, poiseuille_problem, "fluid.container.faces.left", {"periodic"});
  require_word(scene, poiseuille_problem, "fluid.container.slip", {"no_slip"});
  const Box block = read_block(scene, poiseuille_problem);
  const Box container = read_box(scene, "fluid.container");
  const std::vector<double> gravity =
      scene.has("gravity") ? scene.numbers("gravity") : std::vector{0.0, 0.0};
  if (gravity[0] == 0.0 || gravity[1] != 0.0 || block.from != container.from ||
      block.to != container.to) {
    scene.fail("reference.type", "this scene is not " + poiseuille_problem,
               "gravity along x, and a block that fills the container");
  }
  return {.gap = container.size(1),
          .viscosity = fluid.viscosity / fluid.density,
          .acceleration = gravity[0]};
}

}  // namespace

std::unique_ptr<Reference> make_poiseuille_reference(const Section& scene,
                                                     const Simulation& simulation) {
  const FreeFluid fluid = read_free_fluid(scene);
  const PoiseuilleProblem slit = read_poiseuille(scene, fluid);
  const PoiseuilleSolution solution(slit);
  const double floor = scene.numbers("fluid.container.from")[1];
  const Field velocity = field_named(*simulation.manager, "fluid_velocity");
  const auto exact = [=](double y, double t) { return solution.velocity(y - floor, t); };

  auto reference = std::make_unique<Reference>("poiseuille", "Poiseuille's flow from rest",
                                               solution.time_scale());
  const auto largest = [=](int component, auto expected) {
    return [=](double t) {
      const auto y = velocity.points().position[1];
      const auto values = velocity.values().subspan(component * y.size());
      double error = 0.0;
      for (std::size_t i = 0; i < y.size(); ++i) {
        error = std::max(error, std::abs(values[i] - expected(y[i], t)));
      }
      return error / std::abs(solution.peak());
    };
  };
  reference->add(Reference::Error{"velocity_error", largest(0, exact)});
  reference->add(
      Reference::Error{"cross_velocity_error", largest(1, [](double, double) { return 0.0; })});
  const double middle = floor + 0.5 * slit.gap;
  // The two rows beside the middle.
  reference->add(Reference::History{
      "velocity at the middle", "m/s",
      mean_between(velocity, 0, 1, middle - fluid.spacing, middle + fluid.spacing),
      [=](double t) { return exact(middle - 0.5 * fluid.spacing, t); }});
  reference->add(profile_over_layers(velocity, 0, 1, floor, floor + slit.gap, fluid.spacing,
                                     "velocity", exact));
  return reference;
}

}  // namespace perifrac
