#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/cryer_solution.hpp"

namespace perifrac {

namespace {

const std::string cryer_problem = "Cryer's problem";

CryerProblem read_cryer(const Section& scene) {
  if (scene.integer("dimension") != 3) {
    scene.fail("reference.type", "Cryer's problem is a ball", "dimension: 3");
  }
  require_word(scene, cryer_problem, "body.shape", {"ball"});
  require_word(scene, cryer_problem, "solid.type", {"quasi_static", "dynamic"});
  require_section(scene, cryer_problem, "pore_flow");
  require_word(scene, cryer_problem, "solid.boundary.surface.type", {"pressure"});
  require_word(scene, cryer_problem, "pore_flow.boundary.surface.type", {"pressure"});
  require_absent(scene, cryer_problem,
                 {"solid.regions", "pore_flow.regions", "solid.body_force", "gravity",
                  "pore_flow.initial_gradient"});
  const ElasticRock elasticity = read_elastic_rock(scene);
  const PorousRock pore = read_porous_rock(scene);
  return {.bulk_modulus = elasticity.bulk_modulus(),
          .shear_modulus = elasticity.shear_modulus,
          .biot_coefficient = pore.biot_coefficient,
          .storage = pore.storage,
          .mobility = pore.mobility,
          .radius = scene.number("body.radius"),
          .load = scene.number("solid.boundary.surface.pressure")};
}

Reference::Figure peak(const CryerSolution& solution) {
  const auto exact = solution.peak();
  return {.name = "peak in the middle",
          .unit = "Pa",
          .exact = exact.pressure,
          .scale = solution.initial_pressure(),
          .history = 0,
          .computed = [=](auto times, auto values) -> std::optional<double> {
            if (times.empty() || times.back() < 2.0 * exact.time) return {};
            return *std::ranges::max_element(values);
          }};
}

}  // namespace

std::unique_ptr<Reference> make_cryer_reference(const Section& scene,
                                                const Simulation& simulation) {
  const auto solution = std::make_shared<const CryerSolution>(read_cryer(scene));
  const PointSet& points = simulation.points();
  const auto radius = [points](Index i) {
    return std::hypot(points.position[0][i], points.position[1][i], points.position[2][i]);
  };
  const auto exact = once_each([=](double r, double t) { return solution->pressure(r, t); });
  const Field pressure = field_named(*simulation.manager, "pore_pressure");
  auto reference =
      std::make_unique<Reference>("cryer", "Cryer's analytic solution", solution->time_scale());
  reference->add(Reference::Error{
      "pressure_error",
      largest_error(pressure, 0, points_inside(scene, points), solution->initial_pressure(),
                    [=](Index i, double t) { return exact(radius(i), t); })});
  const std::vector<Index> row = points_along(scene, points, 0, {0.0, 0.0, 0.0});
  // The row lies beside the axis, so that its points have other distances from the middle.
  const double aside = std::hypot(points.position[1][row.front()], points.position[2][row.front()]);
  const double size = scene.number("body.radius");
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    const double r = std::hypot(part * size, aside);
    reference->add(Reference::History{
        part == 0.0 ? "pore pressure at the middle" : fmt::format("pore pressure at {} a", part),
        "Pa", value_at(simulation, pressure, place_on(row, points, 0, part * size)),
        [=](double t) { return solution->pressure(r, t); }});
  }
  reference->add(peak(*solution));
  reference->add(profile_along(
      row, points, 0, "pore pressure", "Pa", pressure,
      [=](double x, double t) { return solution->pressure(std::hypot(x, aside), t); }));
  return reference;
}

}  // namespace perifrac
