#include "tests/fuzz/read_any_scene.hpp"

#include <cmath>

#include "app/run/output_times.hpp"
#include "app/run/recorder.hpp"
#include "app/run/scene_keys.hpp"
#include "app/simulation/scene_checks.hpp"
#include "app/simulation/simulation.hpp"
#include "core/base/errors.hpp"
#include "core/config/scene.hpp"
#include "coupling/coupling_keys.hpp"

namespace perifrac {
namespace {

constexpr double most_points = 400.0;

/// About how many points the body has, layers included; of a file: none, for it is what it is.
double body_points(const Section& body, int dimension) {
  if (!body.has("size") && !body.has("radius")) return 0.0;
  if (!body.has("spacing")) return 0.0;
  const double layers = 2.0 * body.number("horizon_ratio");
  double points = 1.0;
  for (int a = 0; a < dimension; ++a) {
    const double length =
        body.has("radius") ? 2.0 * body.number("radius") : body.numbers("size")[a];
    points *= length / body.number("spacing") + layers;
  }
  return points;
}

double box_points(const Section& box, double spacing) {
  const std::vector<double> from = box.numbers("from");
  const std::vector<double> to = box.numbers("to");
  double points = 1.0;
  for (std::size_t a = 0; a < from.size(); ++a) points *= std::abs(to[a] - from[a]) / spacing + 4.0;
  return points;
}

double fluid_points(const Section& fluid, double spacing_of_body) {
  const double spacing = fluid.has("spacing") ? fluid.number("spacing") : spacing_of_body;
  double points = fluid.has("container.from") ? box_points(fluid.at("container"), spacing) : 0.0;
  for (const char* list : {"blocks", "walls"}) {
    for (const std::string& item : fluid.names(list)) {
      points += box_points(fluid.at(list + item), spacing);
    }
  }
  return points;
}

bool is_small(const Section& scene) {
  double points = 0.0;
  const int dimension = scene.integer("dimension");
  if (scene.has("body")) points += body_points(scene.at("body"), dimension);
  const double spacing = scene.has("body.spacing") ? scene.number("body.spacing") : 1e300;
  if (scene.has("fluid")) points += fluid_points(scene.at("fluid"), spacing);
  return points < (dimension == 2 ? most_points : 0.5 * most_points);
}

}  // namespace

void read_any_scene(const std::string& file) {
  try {
    const Section scene = read_scene(file, {}, scene_catalogue());
    const double end = scene.number("time.end");
    read_output_times(scene.at("output"), end);
    read_coupling_options(scene.at("coupling"), end);
    Mistakes mistakes;
    check_sections_together(scene, mistakes);
    if (!is_small(scene)) return;
    Simulation simulation = make_simulation(scene);
    initialize(scene, simulation);
    const Recorder recorder(scene, "", simulation);
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
}

}  // namespace perifrac
