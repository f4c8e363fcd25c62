#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/crack_viscosity.hpp"
#include "app/references/growth_step.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/kgd_solution.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

namespace {

const std::string kgd_problem = "one wing of a crack that fluid drives from an axis of symmetry";

KgdProblem read_kgd(const Section& scene) {
  require_word(scene, kgd_problem, "solid.type", {"quasi_static"});
  require_word(scene, kgd_problem, "solid.boundary.left.type", {"roller"});
  require_word(scene, kgd_problem, "crack_fluid.leak_off", {"none"});
  require_word(scene, kgd_problem, "crack_fluid.counts", {"both"});
  require_absent(
      scene, kgd_problem,
      {"pore_flow", "solid.regions", "damage.regions", "solid.stress_gradient", "gravity"});
  if (!writes(scene, "damage") || scene.count("crack_fluid.inlets") != 1 ||
      scene.count("crack_fluid.wells") > 0 || !scene.has("crack_fluid.inlets[0].rate")) {
    scene.fail("reference.type", "this scene is not " + kgd_problem,
               "damage, and one inlet with a rate");
  }
  return {read_elastic_rock(scene).plane_strain_modulus(), read_fracture_energy(scene),
          crack_viscosity(scene), scene.number("crack_fluid.inlets[0].rate")};
}

KgdSolution solve(const Section& scene, const KgdProblem& driven) {
  try {
    return KgdSolution(driven);
  } catch (const std::domain_error& error) {
    scene.fail("reference.type", error.what(), "a toughness that the solution is known for");
  }
}

}  // namespace

std::unique_ptr<Reference> make_kgd_reference(const Section& scene, const Simulation& simulation) {
  const KgdProblem driven = read_kgd(scene);
  const KgdSolution solution = solve(scene, driven);
  const auto& manager = *simulation.manager;
  const double spacing = scene.number("body.spacing");
  const double end = scene.number("time.end");
  const auto stated = read_stated_stress(scene);
  const double stress = stated ? stated->total[1] : 0.0;
  const std::string inlet = scene.text("crack_fluid.inlets[0].name");
  const Field length = field_named(manager, "crack_length");
  const Field pressure = field_named(manager, fmt::format("inlet_{}_pressure", inlet));
  const Field opening = field_named(manager, "crack_opening");

  // Length goes with t^(2/3).
  const auto step = [=](double t) { return 1.5 * t * spacing / solution.length(t); };
  auto reference = std::make_unique<Reference>(
      "kgd",
      fmt::format("two wings in an infinite body, K_m = {:.3g}", driven.dimensionless_toughness()),
      0.0);
  const auto compare = [&](const OfGrowth& compared) {
    compare_growth(*reference, compared, step, end);
  };
  compare({.quantity = "length",
           .place = "the tip",
           .unit = "m",
           .between = BetweenRows::held,
           .computed = [=] { return length.values()[0]; },
           .exact = [=](double t) { return solution.length(t); }});
  compare({.quantity = "pressure",
           .place = "the inlet",
           .unit = "Pa",
           .computed = [=] { return pressure.values()[0] - stress; },
           .exact = [=](double t) { return solution.pressure(t); }});
  // The first facet begins at the inlet.
  compare({.quantity = "opening",
           .place = "the inlet",
           .unit = "m",
           .computed = [=] { return opening.values()[0]; },
           .exact = [=](double t) { return solution.opening(t); }});
  return reference;
}

}  // namespace perifrac
