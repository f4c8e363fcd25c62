#include "app/simulation/scene_checks.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/body/crack_seeds.hpp"
#include "core/config/mistakes.hpp"

namespace perifrac {

namespace {

/// Neither section says anything wrong, and together they make no scene.
struct Rule {
  std::string key;  ///< what is refused
  bool (*broken)(const Section& scene);
  const char* problem;
  const char* expected;
};

constexpr const char* critical_stretch = "critical_stretch";

bool is(const Section& scene, const char* key, const char* word) {
  return scene.has(key) && scene.word(key) == word;
}

bool has_holes(const Section& scene) {
  if (!scene.has("body.cutouts")) return false;
  return std::ranges::any_of(scene.names("body.cutouts"), [&](const std::string& name) {
    return scene.has("body.cutouts." + name + ".radius");
  });
}

bool is_flat(const Section& scene) { return scene.integer("dimension") == 2; }

bool has_friction(const Section& scene) { return scene.has("solid.crack_friction"); }

bool turns_far(const Section& scene) { return is(scene, "solid.kinematics", "corotational"); }

bool is_dynamic(const Section& scene) { return is(scene, "solid.type", "dynamic"); }

/// In this order: of those with one key the first that is broken is told.
// NOLINTNEXTLINE(readability-function-size): a table
const std::vector<Rule>& rules() {
  static const std::vector<Rule> all = {
      {"fluid", [](const Section& scene) { return scene.has("fluid") && has_holes(scene); },
       "beside a round cut-out of the body, which free fluid does not fill",
       "cut-outs that are boxes, or the pressure of the hole under 'boundary'"},
      {"solid.crack_friction",
       [](const Section& scene) { return has_friction(scene) && is_dynamic(scene); },
       "in a solid with inertia", "type: quasi_static, or a solid without crack_friction"},
      {"solid.crack_friction",
       [](const Section& scene) { return has_friction(scene) && !has_cracks(scene); },
       "without cracks",
       "a list 'cracks' with one crack or more, or a solid without crack_friction"},
      {"solid.crack_friction",
       [](const Section& scene) { return has_friction(scene) && !is_flat(scene); }, "in 3D",
       "dimension: 2, or a solid without crack_friction"},
      {"solid.crack_friction",
       [](const Section& scene) {
         return has_friction(scene) && scene.has("pore_flow") && !scene.has("crack_fluid");
       },
       "beside pore flow and dry cracks, whose faces do not feel the pressure of pores",
       "crack_fluid, such as one with leak_off: pores, or a solid without crack_friction"},
      {"solid.kinematics",
       [](const Section& scene) { return turns_far(scene) && !is_dynamic(scene); },
       "'corotational' of a solid in equilibrium", "type: dynamic, or small"},
      {"solid.kinematics",
       [](const Section& scene) { return turns_far(scene) && scene.has("fluid"); },
       "'corotational' beside free fluid, whose walls do not turn", "small"},
      {"solid.kinematics",
       [](const Section& scene) {
         return turns_far(scene) && scene.has("gravity") && scene.has("pore_flow");
       },
       "'corotational' beside pores that gravity acts in",
       "a scene without gravity or without pore_flow, or small"},
      {"solid.kinematics",
       [](const Section& scene) {
         return turns_far(scene) && has_cracks(scene) &&
                !is(scene, "damage.type", critical_stretch);
       },
       "'corotational' beside cracks whose faces do not turn",
       "damage.type: critical_stretch, or small"},
      {"solid.density",
       [](const Section& scene) {
         return scene.has("gravity") && scene.has("solid") && !is(scene, "solid.type", "rigid") &&
                !scene.has("solid.density");
       },
       "missing, and gravity is on", "the bulk density of the rock"},
      {"damage.tensile_strength",
       [](const Section& scene) {
         return scene.has("damage.tensile_strength") && is_dynamic(scene) &&
                is(scene, "damage.type", "energy_release");
       },
       "in a dynamic solid", "solid.type: quasi_static, or none"},
      {"crack_fluid",
       [](const Section& scene) {
         return scene.has("crack_fluid") && scene.has("solid") && scene.count("cracks") == 0;
       },
       "no crack that it could be in", "a list 'cracks' with one crack or more"},
      {"crack_fluid.counts",
       [](const Section& scene) {
         return is(scene, "crack_fluid.counts", "both") && !is_flat(scene);
       },
       "'both' in 3D", "one_wing: the rate of the part that the scene holds"},
      {"crack_fluid.type",
       [](const Section& scene) {
         return is(scene, "crack_fluid.type", "uniform_pressure") && scene.has("gravity");
       },
       "'uniform_pressure' of fluid that gravity acts on", "network, or a scene without gravity"},
      {"crack_fluid.leak_off",
       [](const Section& scene) {
         return is(scene, "crack_fluid.leak_off", "pores") && !scene.has("pore_flow");
       },
       "the scene has no section 'pore_flow'", "none or carter"},
      {"damage.type",
       [](const Section& scene) {
         return is(scene, "damage.type", critical_stretch) && is_dynamic(scene) &&
                scene.has("crack_fluid");
       },
       "'critical_stretch' beside fluid in cracks",
       "energy_release, whose cracks are facets that fluid may fill"},
  };
  return all;
}

/// Repeating a window changes the steps that CVODE chooses, and its answer by its own tolerance:
/// iterations cannot agree any better.
void refuse_unreachable_tolerance(const Section& scene) {
  if (!scene.has("coupling.iterations.max") || scene.integer("coupling.iterations.max") == 1 ||
      !scene.has("solid") || !scene.has("pore_flow.integrator.type") ||
      scene.word("pore_flow.integrator.type") != "cvode") {
    return;
  }
  const double wanted = scene.number("coupling.iterations.tolerance");
  const double accuracy = scene.number("pore_flow.integrator.tolerance");
  if (wanted < accuracy) {
    scene.fail(
        "coupling.iterations.tolerance",
        fmt::format("{:g} is tighter than pore_flow.integrator.tolerance, {:g}", wanted, accuracy),
        "a coupling that asks for no more accuracy than the integrator gives");
  }
}

/// Where fluid touches a body, the scene says how; elsewhere there is nothing to say.
void check_interface(const Section& scene) {
  if (scene.has("fluid") && scene.has("body") && !scene.has("interface")) {
    scene.fail("fluid", "a fluid beside a body, and nothing says how they meet",
               "a section interface");
  }
  for (const char* side : {"fluid", "body"}) {
    if (!scene.has("interface") || scene.has(side)) continue;
    scene.fail("interface", fmt::format("the scene has no section '{}'", side),
               "an interface where free fluid meets a body");
  }
}

/// Mass that goes from a fluid to pores is measured by one density at no pressure.
void check_density(const Section& scene, const std::string& fluid) {
  const double outside = scene.number(fluid + ".density");
  const double in_pores = scene.number("pore_flow.fluid.density");
  if (std::abs(outside - in_pores) <= 1e-12 * in_pores) return;
  scene.fail(fluid + ".density",
             fmt::format("{:g} kg/m^3 of the fluid that flows into the pores", outside),
             fmt::format("pore_flow.fluid.density, {:g} kg/m^3", in_pores));
}

/// What cracks take from free fluid is of its kind, in 2D.
void check_mouth(const Section& scene, const std::string& inlet) {
  if (!is(scene, (inlet + ".holds").c_str(), "fluid")) return;
  if (!scene.has("fluid")) {
    scene.fail(inlet + ".holds", "the scene has no section 'fluid'", "rate or pressure");
  }
  if (!is_flat(scene)) scene.fail(inlet + ".holds", "'fluid' in 3D", "rate or pressure");
  const double outside = scene.number("fluid.density");
  const double inside = scene.number("crack_fluid.density");
  if (std::abs(outside - inside) <= 1e-12 * outside) return;
  scene.fail("crack_fluid.density",
             fmt::format("{:g} kg/m^3 of what comes from the free fluid", inside),
             fmt::format("fluid.density, {:g} kg/m^3", outside));
}

/// What flows into the pores is of their kind.
void check_exchange(const Section& scene) {
  if (!scene.has("pore_flow")) return;
  const bool free = scene.has("fluid") && scene.word("interface.exchange") != "none";
  const bool in_cracks = scene.has("crack_fluid") && scene.word("crack_fluid.leak_off") == "pores";
  if (free) check_density(scene, "fluid");
  if (in_cracks) check_density(scene, "crack_fluid");
}

}  // namespace

bool check_sections_together(const Section& scene, Mistakes& mistakes) {
  std::set<std::string> refused;
  for (const Rule& rule : rules()) {
    if (refused.contains(rule.key) || !rule.broken(scene)) continue;
    refused.insert(rule.key);
    mistakes.note([&] { scene.fail(rule.key, rule.problem, rule.expected); });
  }
  mistakes.note([&] { refuse_unreachable_tolerance(scene); });
  for (std::size_t k = 0; k < scene.count("crack_fluid.inlets"); ++k) {
    mistakes.note([&] { check_mouth(scene, fmt::format("crack_fluid.inlets[{}]", k)); });
  }
  const bool cracks_lie_in_rock = mistakes.note([&] {
    if (scene.count("cracks") == 0 || scene.has("solid")) return;
    scene.fail("cracks", "the scene has no section 'solid', whose bonds they cut",
               "a solid, of type: rigid where nothing is to deform");
  });
  const bool fluid_meets_a_body = mistakes.note([&] { check_interface(scene); });
  if (fluid_meets_a_body) mistakes.note([&] { check_exchange(scene); });
  return cracks_lie_in_rock && fluid_meets_a_body;
}

}  // namespace perifrac
