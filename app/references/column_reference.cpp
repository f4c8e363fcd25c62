#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/layered_column_solution.hpp"
#include "app/references/solutions/terzaghi_solution.hpp"

namespace perifrac {

namespace {

/// What a column scene says, besides its materials.
struct Column {
  int vertical;   ///< axis
  double height;  ///< from the floor to the plane that drains [m]
  double floor;   ///< how far the plane that holds the solid lies below the bottom [m]
  double load;    ///< presses on the top [Pa]
};

Column read_column(const Section& scene, const std::string& problem) {
  const int vertical = scene.integer("dimension") - 1;
  require_word(scene, problem, "body.shape", {"box"});
  require_word(scene, problem, "solid.type", {"quasi_static", "dynamic"});
  require_section(scene, problem, "pore_flow");
  for (const char* const side : {"left", "right", "front", "back"}) {
    if (vertical == 1 && side[0] == 'f') break;
    require_word(scene, problem, fmt::format("solid.boundary.{}.type", side), {"roller"});
  }
  require_word(scene, problem, "solid.boundary.bottom.type", {"roller", "fixed"});
  require_word(scene, problem, "solid.boundary.top.type", {"traction"});
  require_word(scene, problem, "pore_flow.boundary.top.type", {"pressure"});
  require_absent(scene, problem, {"solid.body_force", "gravity", "pore_flow.initial_gradient"});
  if (scene.number("pore_flow.boundary.top.pressure") != 0.0) {
    scene.fail("pore_flow.boundary.top.pressure", "this scene is not " + problem, "0 Pa");
  }
  return {vertical, scene.numbers("body.size")[vertical] + outside(scene, "top"),
          outside(scene, "bottom"), -scene.numbers("solid.boundary.top.traction")[vertical]};
}

/// The material of the column, or of a region in it, as a layer of this thickness [m].
ColumnLayer read_layer(const Section& scene, double thickness, const std::string& region = "") {
  const ElasticRock elasticity = read_elastic_rock(scene, region);
  const PorousRock pore = read_porous_rock(scene, region);
  return {.thickness = thickness,
          .uniaxial_modulus = elasticity.uniaxial_modulus(),
          .biot_coefficient = pore.biot_coefficient,
          .storage = pore.storage,
          .mobility = pore.mobility};
}

/// The one region of the scene, which must be the column from some height up.
std::string upper_region(const Section& scene, const Column& column, const std::string& problem) {
  const std::vector<std::string> names = scene.names("body.regions");
  const std::string from = names.empty() ? "" : "body.regions." + names[0] + ".from";
  if (names.size() != 1 || !writes(scene, from) ||
      writes(scene, "body.regions." + names[0] + ".to") ||
      scene.numbers(from)[column.vertical] <= 0.0) {
    scene.fail("reference.type", "this scene is not " + problem,
               "one region under body.regions, the upper layer, with `from` and without `to`");
  }
  return names[0];
}

/// Pressures over `scale`, displacements over the final settlement.
template <class Solution>
std::unique_ptr<Reference> compare(const Section& scene, const Simulation& simulation,
                                   const Column& column, std::unique_ptr<Reference> reference,
                                   const Solution& solution, double scale) {
  const int axis = column.vertical;
  const PointSet& points = simulation.points();
  const std::span<const double> z = points.position[axis];
  const Field pressure = field_named(*simulation.manager, "pore_pressure");
  const Field displacement = field_named(*simulation.manager, "displacement");
  const std::vector<Index> inside = points_inside(scene, points);
  const auto exact_pressure =
      once_each([=](double at, double t) { return solution.pressure(at, t); });
  // Below the bottom no pore pressure carries: a strip that shortens once.
  const double sunk = solution.drained_strain() * column.floor;
  const auto exact_displacement =
      once_each([=](double at, double t) { return sunk + solution.displacement(at, t); });
  reference->add(Reference::Error{
      "pressure_error", largest_error(pressure, 0, inside, scale,
                                      [=](Index i, double t) { return exact_pressure(z[i], t); })});
  reference->add(Reference::Error{
      "settlement_error",
      largest_error(displacement, axis, inside, solution.final_settlement(),
                    [=](Index i, double t) { return exact_displacement(z[i], t); })});
  const std::vector<Index> row = points_along(scene, points, axis, std::vector(axis + 1, 0.0));
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    const double at = part * column.height;
    reference->add(Reference::History{
        part == 0.0 ? "pore pressure at the floor" : fmt::format("pore pressure at {} H", part),
        "Pa", value_at(simulation, pressure, place_on(row, points, axis, at)),
        [=](double t) { return exact_pressure(at, t); }});
  }
  const double top = scene.numbers("body.size")[axis];
  reference->add(
      Reference::History{"vertical displacement at the top", "m",
                         value_at(simulation, displacement, place_on(row, points, axis, top), axis),
                         [=](double t) { return exact_displacement(top, t); }});
  reference->add(profile_along(row, points, axis, "pore pressure", "Pa", pressure, exact_pressure));
  return reference;
}

}  // namespace

std::unique_ptr<Reference> make_terzaghi_reference(const Section& scene,
                                                   const Simulation& simulation) {
  const std::string problem = "Terzaghi's problem";
  const Column column = read_column(scene, problem);
  require_absent(scene, problem, {"solid.regions", "pore_flow.regions"});
  const ColumnLayer layer = read_layer(scene, column.height);
  const TerzaghiSolution solution({layer.uniaxial_modulus, layer.biot_coefficient, layer.storage,
                                   layer.mobility, layer.thickness, column.load});
  return compare(scene, simulation, column,
                 std::make_unique<Reference>("terzaghi", "Terzaghi's analytic solution",
                                             solution.time_scale()),
                 solution, solution.initial_pressure());
}

std::unique_ptr<Reference> make_layered_column_reference(const Section& scene,
                                                         const Simulation& simulation) {
  const std::string problem = "a column of two layers";
  const Column column = read_column(scene, problem);
  const std::string upper = upper_region(scene, column, problem);
  const double interface = scene.numbers("body.regions." + upper + ".from")[column.vertical];
  const LayeredColumnSolution solution(read_layer(scene, interface),
                                       read_layer(scene, column.height - interface, upper),
                                       column.load);
  return compare(scene, simulation, column,
                 std::make_unique<Reference>("layered_column", "Consolidation of two layers",
                                             solution.time_scale()),
                 solution, solution.initial_pressure(0));
}

}  // namespace perifrac
