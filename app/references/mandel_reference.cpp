#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/mandel_solution.hpp"

namespace perifrac {

namespace {

const std::string mandel_problem = "Mandel's problem";

MandelProblem read_mandel(const Section& scene) {
  if (scene.integer("dimension") != 2) {
    scene.fail("reference.type", "Mandel's problem is plane", "dimension: 2");
  }
  require_word(scene, mandel_problem, "body.shape", {"box"});
  require_word(scene, mandel_problem, "solid.type", {"quasi_static", "dynamic"});
  require_section(scene, mandel_problem, "pore_flow");
  require_word(scene, mandel_problem, "solid.boundary.left.type", {"roller"});
  require_word(scene, mandel_problem, "solid.boundary.bottom.type", {"roller"});
  require_word(scene, mandel_problem, "solid.boundary.top.type", {"rigid_plate"});
  require_word(scene, mandel_problem, "pore_flow.boundary.right.type", {"pressure"});
  require_absent(scene, mandel_problem,
                 {"solid.regions", "pore_flow.regions", "gravity", "pore_flow.initial_gradient"});
  const ElasticRock elasticity = read_elastic_rock(scene);
  const PorousRock pore = read_porous_rock(scene);
  const std::vector<double> size = scene.numbers("body.size");
  return {elasticity.lame_lambda,
          elasticity.shear_modulus,
          pore.biot_coefficient,
          pore.storage,
          pore.mobility,
          size[0] + outside(scene, "right"),
          size[1] + outside(scene, "top"),
          scene.number("solid.boundary.top.force")};
}

/// The Mandel-Cryer peak of a history, once it was passed.
Reference::Figure peak(const MandelSolution& solution, double x) {
  const double passed = 0.1 / solution.dimensionless_time(1.0);
  return {.name = "Mandel-Cryer peak in the middle",
          .unit = "Pa",
          .exact = solution.peak_pressure(x),
          .scale = solution.initial_pressure(),
          .history = 0,
          .computed = [passed](auto times, auto values) -> std::optional<double> {
            if (times.empty() || times.back() <= passed) return {};
            return *std::ranges::max_element(values);
          }};
}

}  // namespace

std::unique_ptr<Reference> make_mandel_reference(const Section& scene,
                                                 const Simulation& simulation) {
  const auto solution = std::make_shared<const MandelSolution>(read_mandel(scene));
  const PointSet& points = simulation.points();
  const std::span<const double> x = points.position[0];
  const auto exact = once_each([=](double at, double t) { return solution->pressure(at, t); });
  const Field pressure = field_named(*simulation.manager, "pore_pressure");
  const Field plate = field_named(*simulation.manager, "top_plate_displacement");
  auto reference = std::make_unique<Reference>("mandel", "Mandel's analytic solution",
                                               1.0 / solution->dimensionless_time(1.0));
  const double scale = solution->initial_pressure();
  reference->add(Reference::Error{
      "pressure_error", largest_error(pressure, 0, points_inside(scene, points), scale,
                                      [=](Index i, double t) { return exact(x[i], t); })});
  reference->add(Reference::Error{"plate_error", [=](double t) {
                                    return std::abs(
                                        plate.values()[0] / solution->plate_displacement(t) - 1.0);
                                  }});
  const std::vector<Index> row = points_along(scene, points, 0, {0.0, 0.0});
  const double width = scene.numbers("body.size")[0];
  constexpr std::array places = {"the middle", "a/4", "a/2", "3a/4"};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double at = 0.25 * static_cast<double>(k) * width;
    reference->add(Reference::History{fmt::format("pore pressure at {}", places[k]), "Pa",
                                      value_at(simulation, pressure, place_on(row, points, 0, at)),
                                      [=](double t) { return solution->pressure(at, t); }});
  }
  reference->add(peak(*solution, 0.0));
  reference->add(profile_along(row, points, 0, "pore pressure", "Pa", pressure,
                               [=](double at, double t) { return solution->pressure(at, t); }));
  return reference;
}

}  // namespace perifrac
