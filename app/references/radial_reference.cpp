#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/crack_viscosity.hpp"
#include "app/references/growth_step.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/radial_solution.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

namespace {

const std::string radial_problem =
    "a quarter of a crack that fluid drives from an edge of the body";

/// Of the whole crack's rate and area, what the scene holds.
constexpr double part_of_disc = 0.25;

/// All fluid enters by the one facet at the corner, a square that makes four with its mirror
/// images. With fluxes between neighbours of a square grid its pressure is that which a disc of
/// this radius, in spacings, has in the mean when fluid enters by it evenly.
constexpr double source = 0.9217;

/// As a plane of symmetry is written.
bool is_plane_of_symmetry(const Section& scene, const std::string& face) {
  const std::string path = "solid.boundary." + face + ".type";
  return writes(scene, path) && scene.word(path) == "roller";
}

/// The axis across the crack: along the two others the inlet lies on a plane of symmetry.
int normal_axis(const Section& scene) {
  static const std::array<std::array<std::string, 2>, 3> faces = {
      {{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};
  const std::vector<double> inlet = scene.numbers("crack_fluid.inlets[0].at");
  const std::vector<double> size = scene.numbers("body.size");
  const double near = 0.75 * scene.number("body.spacing");  // the first facet's centre is
  int normal = 3;
  int planes = 0;
  for (int a = 0; a < 3; ++a) {
    const bool low = inlet[a] < near && is_plane_of_symmetry(scene, faces[a][0]);
    const bool high = inlet[a] > size[a] - near && is_plane_of_symmetry(scene, faces[a][1]);
    low || high ? ++planes : normal = a;
  }
  if (planes != 2) {
    scene.fail("reference.type", "this scene is not " + radial_problem,
               "crack_fluid.inlets[0].at on two faces with boundary type roller");
  }
  return normal;
}

RadialProblem read_radial(const Section& scene) {
  if (scene.integer("dimension") != 3) {
    scene.fail("reference.type", "this scene is not " + radial_problem, "dimension: 3");
  }
  require_word(scene, radial_problem, "body.shape", {"box"});
  require_word(scene, radial_problem, "solid.type", {"quasi_static"});
  require_word(scene, radial_problem, "crack_fluid.leak_off", {"none"});
  require_absent(
      scene, radial_problem,
      {"pore_flow", "solid.regions", "damage.regions", "solid.stress_gradient", "gravity"});
  if (!writes(scene, "damage") || scene.count("crack_fluid.inlets") != 1 ||
      scene.count("crack_fluid.wells") > 0 || !scene.has("crack_fluid.inlets[0].volume_rate")) {
    scene.fail("reference.type", "this scene is not " + radial_problem,
               "damage, and one inlet with a volume_rate");
  }
  return {read_elastic_rock(scene).plane_strain_modulus(), read_fracture_energy(scene),
          crack_viscosity(scene), scene.number("crack_fluid.inlets[0].volume_rate") / part_of_disc};
}

}  // namespace

std::unique_ptr<Reference> make_radial_reference(const Section& scene,
                                                 const Simulation& simulation) {
  const RadialProblem driven = read_radial(scene);
  const RadialSolution solution(driven);
  const int normal = normal_axis(scene);
  const auto& manager = *simulation.manager;
  const double spacing = scene.number("body.spacing");
  const double end = scene.number("time.end");
  const auto stated = read_stated_stress(scene);
  const double stress = stated ? stated->total[normal] : 0.0;
  const std::string inlet = scene.text("crack_fluid.inlets[0].name");
  const Field area = field_named(manager, "crack_area");
  const Field pressure = field_named(manager, fmt::format("inlet_{}_pressure", inlet));
  const Field opening = field_named(manager, fmt::format("inlet_{}_opening", inlet));

  // The radius goes with t^(4/9) to t^(2/5).
  const auto step = [=](double t) { return 2.4 * t * spacing / solution.radius(t); };
  auto reference =
      std::make_unique<Reference>("radial",
                                  fmt::format("penny-shaped crack in an infinite body, K = {:.3g}",
                                              driven.dimensionless_toughness(end)),
                                  0.0);
  const auto compare = [&](const OfGrowth& compared) {
    compare_growth(*reference, compared, step, end);
  };
  compare({.quantity = "radius",
           .place = "the edge",
           .unit = "m",
           .between = BetweenRows::held,
           .computed = [=] { return std::sqrt(area.values()[0] / (part_of_disc * M_PI)); },
           .exact = [=](double t) { return solution.radius(t); }});
  compare({.quantity = "pressure",
           .place = "the inlet",
           .unit = "Pa",
           .computed = [=] { return pressure.values()[0] - stress; },
           .exact = [=](double t) { return solution.source_pressure(source * spacing, t); }});
  // In the middle of the facet at the corner.
  compare({.quantity = "opening",
           .place = "the inlet",
           .unit = "m",
           .computed = [=] { return opening.values()[0]; },
           .exact = [=](double t) { return solution.opening(std::sqrt(0.5) * spacing, t); }});
  return reference;
}

}  // namespace perifrac
