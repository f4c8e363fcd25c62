#include <algorithm>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/plate_solution.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

const std::string drained_plate_problem = "a plate under uniform tractions";

std::array<double, 3> read_strain(const Section& scene) {
  const int dimension = scene.integer("dimension");
  require_word(scene, drained_plate_problem, "body.shape", {"box"});
  require_word(scene, drained_plate_problem, "solid.type", {"quasi_static"});
  require_absent(scene, drained_plate_problem,
                 {"pore_flow", "solid.regions", "solid.body_force", "solid.confining_stress",
                  "solid.total_stress", "gravity"});
  const auto names = dimension == 2 ? face_names<2>() : face_names<3>();
  std::array<double, 3> stress{};
  for (int axis = 0; axis < dimension; ++axis) {
    const std::string high = "solid.boundary." + names[2 * axis + 1];
    require_word(scene, drained_plate_problem,
                 fmt::format("solid.boundary.{}.type", names[2 * axis]), {"roller"});
    if (!scene.has(high)) continue;
    require_word(scene, drained_plate_problem, high + ".type", {"traction", "free"});
    if (scene.word(high + ".type") == "traction") {
      stress[axis] = scene.numbers(high + ".traction")[axis];
    }
  }
  const ElasticRock elasticity = read_elastic_rock(scene);
  return uniform_strain(elasticity.youngs_modulus(), elasticity.poisson_ratio(), stress, dimension);
}

}  // namespace

std::unique_ptr<Reference> make_drained_plate_reference(const Section& scene,
                                                        const Simulation& simulation) {
  const std::array<double, 3> strain = read_strain(scene);
  const std::vector<double> size = scene.numbers("body.size");
  const PointSet& points = simulation.points();
  const Field displacement = field_named(*simulation.manager, "displacement");
  auto reference =
      std::make_unique<Reference>("drained_plate", "Uniform strain under uniform tractions", 0.0);
  double largest = 0.0;
  for (int a = 0; a < points.dimension; ++a) {
    largest = std::max(largest, std::abs(strain[a]) * size[a]);
  }
  constexpr std::array axis = {"x", "y", "z"};
  for (int a = 0; a < points.dimension; ++a) {
    const std::span<const double> x = points.position[a];
    reference->add(
        Reference::Error{fmt::format("displacement_{}_error", axis[a]),
                         largest_error(displacement, a, points_inside(scene, points), largest,
                                       [=](Index i, double) { return strain[a] * x[i]; })});
  }
  const std::vector<Index> row = points_along(scene, points, 0, std::vector(points.dimension, 0.0));
  reference->add(profile_along(row, points, 0, "displacement x", "m", displacement,
                               [=](double x, double) { return strain[0] * x; }));
  return reference;
}

}  // namespace perifrac
