#include <cmath>

#include "app/references/comparison.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/cantilever_solution.hpp"
#include "app/references/solutions/oscillation.hpp"

namespace perifrac {

namespace {

const std::string cantilever_problem = "a cantilever under a sudden load";

CantileverProblem read_cantilever(const Section& scene) {
  if (scene.integer("dimension") != 2) {
    scene.fail("reference.type", "the beam is plane", "dimension: 2");
  }
  require_word(scene, cantilever_problem, "body.shape", {"box"});
  require_word(scene, cantilever_problem, "solid.type", {"dynamic"});
  require_word(scene, cantilever_problem, "solid.boundary.left.type", {"fixed"});
  require_absent(scene, cantilever_problem,
                 {"pore_flow", "solid.regions", "gravity", "solid.damping"});
  if (!writes(scene, "solid.body_force")) {
    scene.fail("reference.type", "this scene is not " + cantilever_problem, "solid.body_force");
  }
  const ElasticRock elasticity = read_elastic_rock(scene);
  const std::vector<double> size = scene.numbers("body.size");
  return {.youngs_modulus = elasticity.youngs_modulus(),
          .poisson_ratio = elasticity.poisson_ratio(),
          .density = scene.number("solid.density"),
          .length = size[0] + outside(scene, "left"),
          .height = size[1],
          .load = scene.numbers("solid.body_force")[1]};
}

}  // namespace

std::unique_ptr<Reference> make_cantilever_reference(const Section& scene,
                                                     const Simulation& simulation) {
  const CantileverProblem beam = read_cantilever(scene);
  const CantileverSolution solution(beam);
  const Field displacement = field_named(*simulation.manager, "displacement");
  const std::vector<double> tip = {scene.numbers("body.size")[0], 0.5 * beam.height};
  auto reference =
      std::make_unique<Reference>("cantilever", "Timoshenko's beam, first mode", solution.period());
  reference->add(Reference::History{"deflection at the tip", "m",
                                    value_at(simulation, displacement, tip, 1),
                                    [=](double t) { return solution.deflection(t); }});
  const double level = solution.static_deflection();
  const auto measured = [=](auto times, auto values) {
    // Upwards whatever the sign of the load.
    std::vector<double> deflection(values.begin(), values.end());
    for (double& value : deflection) value /= level;
    return oscillation(times, deflection, 1.0, 0.5);
  };
  reference->add(
      Reference::Figure{.name = "period of the tip",
                        .unit = "s",
                        .exact = solution.period(),
                        .scale = solution.period(),
                        .history = 0,
                        .computed = [=](auto times, auto values) -> std::optional<double> {
                          if (const auto found = measured(times, values)) return found->period;
                          return {};
                        }});
  reference->add(
      Reference::Figure{.name = "mean deflection of the tip",
                        .unit = "m",
                        .exact = level,
                        .scale = std::abs(level),
                        .history = 0,
                        .computed = [=](auto times, auto values) -> std::optional<double> {
                          if (const auto found = measured(times, values))
                            return found->mean * level;
                          return {};
                        }});
  return reference;
}

}  // namespace perifrac
