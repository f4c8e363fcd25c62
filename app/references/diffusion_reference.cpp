#include <algorithm>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/slab_drainage.hpp"

namespace perifrac {

namespace {

const std::string diffusion_problem = "diffusion from one face";

/// A slab between a face at a pressure and a sealed one.
struct Slab {
  int axis;
  double sealed;    ///< coordinate of the sealed end [m]
  double drained;   ///< coordinate of the other [m]
  double initial;   ///< pressure [Pa]
  double pressure;  ///< from t = 0 on at the drained end [Pa]
  double diffusivity;
  std::vector<double> weight;  ///< of the fluid at rest, d(pressure)/d(coordinate) [Pa/m]
  std::vector<double> top;     ///< where it is 0

  /// What depth adds to the pressure of fluid at rest.
  double by_depth(const PointSet& points, Index i) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < weight.size(); ++a) {
      sum += weight[a] * (points.position[a][i] - top[a]);
    }
    return sum;
  }
  double length() const { return std::abs(drained - sealed); }
  double time_scale() const { return length() * length() / diffusivity; }
  double at(double x, double t) const {
    return pressure + (initial - pressure) *
                          slab_drainage::value(std::abs(x - sealed) / length(), t / time_scale());
  }
};

/// Gravity must leave the fluid at rest: only the drop of pressure diffuses then.
void add_weight(const Section& scene, const std::string& face, Slab& slab) {
  if (!writes(scene, "gravity")) return;
  const Section flow = scene.at("pore_flow");
  require_word(scene, diffusion_problem, "pore_flow.initial_state", {"hydrostatic"});
  if (!flow.boolean(face + ".hydrostatic")) {
    scene.fail("reference.type", "this scene is not " + diffusion_problem,
               fmt::format("pore_flow.{}.hydrostatic: true", face));
  }
  const std::vector<double> size = scene.numbers("body.size");
  for (const double gravity : scene.numbers("gravity")) {
    slab.weight.push_back(flow.number("fluid.density") * gravity);
    slab.top.push_back(gravity > 0.0 ? 0.0 : size[slab.top.size()]);
  }
  if (slab.weight[slab.axis] != 0.0) {
    scene.fail("reference.type", "this scene is not " + diffusion_problem,
               "gravity across the flow");
  }
}

Slab read_slab(const Section& scene) {
  require_word(scene, diffusion_problem, "body.shape", {"box"});
  require_section(scene, diffusion_problem, "pore_flow");
  require_absent(scene, diffusion_problem,
                 {"solid.regions", "pore_flow.regions", "pore_flow.initial_gradient"});
  if (scene.has("solid") && scene.word("solid.type") != "rigid") {
    scene.fail("reference.type", "this scene is not " + diffusion_problem,
               "no solid, or solid.type: rigid");
  }
  const Section flow = scene.at("pore_flow");
  std::vector<std::string> faces = flow.names("boundary");
  std::erase_if(faces, [&](const std::string& face) {
    return flow.word(fmt::format("boundary.{}.type", face)) == "sealed";
  });
  if (faces.size() != 1) {
    scene.fail("reference.type", "this scene is not " + diffusion_problem,
               "one face with type: pressure under pore_flow.boundary, the others sealed");
  }
  const std::string face = "boundary." + faces[0];
  require_word(scene, diffusion_problem, "pore_flow." + face + ".type", {"pressure"});
  const bool low = faces[0] == "left" || faces[0] == "front" || faces[0] == "bottom";
  const bool sideways = faces[0] == "left" || faces[0] == "right";
  const bool vertical = faces[0] == "bottom" || faces[0] == "top";
  const int axis = sideways ? 0 : vertical ? scene.integer("dimension") - 1 : 1;
  const double size = scene.numbers("body.size")[axis];
  const double beyond = outside(scene, faces[0]);
  const PorousRock pore = read_porous_rock(scene);
  if (flow.number("initial_pressure") == flow.number(face + ".pressure")) {
    scene.fail("pore_flow.initial_pressure", "nothing would flow", "not the pressure on the face");
  }
  Slab slab{.axis = axis,
            .sealed = low ? size : 0.0,
            .drained = low ? -beyond : size + beyond,
            .initial = flow.number("initial_pressure"),
            .pressure = flow.number(face + ".pressure"),
            .diffusivity = pore.mobility / pore.storage,
            .weight = {},
            .top = {}};
  add_weight(scene, face, slab);
  return slab;
}

}  // namespace

std::unique_ptr<Reference> make_diffusion_reference(const Section& scene,
                                                    const Simulation& simulation) {
  const Slab slab = read_slab(scene);
  const PointSet& points = simulation.points();
  const std::span<const double> x = points.position[slab.axis];
  const Field pressure = field_named(*simulation.manager, "pore_pressure");
  const auto exact = once_each([=](double at, double t) { return slab.at(at, t); });
  auto reference =
      std::make_unique<Reference>("diffusion", "Diffusion from one face", slab.time_scale());
  reference->add(Reference::Error{
      "pressure_error",
      largest_error(pressure, 0, points_inside(scene, points),
                    std::abs(slab.initial - slab.pressure),
                    [=](Index i, double t) { return exact(x[i], t) + slab.by_depth(points, i); })});
  const std::vector<Index> row =
      points_along(scene, points, slab.axis, std::vector(points.dimension, 0.0));
  const double depth = slab.by_depth(points, row.front());  // gravity is across the row
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const double place = slab.drained + part * (slab.sealed - slab.drained);
    reference->add(Reference::History{
        part == 1.0 ? "pore pressure at the sealed end"
                    : fmt::format("pore pressure at {} L", part),
        "Pa", value_at(simulation, pressure, place_on(row, points, slab.axis, place)),
        [=](double t) { return exact(place, t) + depth; }});
  }
  reference->add(profile_along(row, points, slab.axis, "pore pressure", "Pa", pressure,
                               [=](double at, double t) { return exact(at, t) + depth; }));
  return reference;
}

}  // namespace perifrac
