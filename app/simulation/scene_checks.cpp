#include "app/simulation/scene_checks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/config/mistakes.hpp"

namespace perifrac {

namespace {

bool names(const Section& scene, const std::string& section) {
  return std::ranges::count(scene.names(""), section) > 0;
}

/// Repeating a window changes the steps that CVODE chooses, and its answer by its own tolerance:
/// iterations cannot agree any better.
void refuse_unreachable_tolerance(const Section& scene) {
  if (!scene.has("coupling.iterations.max") || scene.integer("coupling.iterations.max") == 1 ||
      !names(scene, "solid") || !names(scene, "pore_flow") ||
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
  if (names(scene, "fluid") && names(scene, "body") && !names(scene, "interface")) {
    scene.fail("fluid", "a fluid beside a body, and nothing says how they meet",
               "a section interface");
  }
  for (const char* side : {"fluid", "body"}) {
    if (!names(scene, "interface") || names(scene, side)) continue;
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

/// What cracks take from free fluid is of its kind.
void check_mouths(const Section& scene) {
  for (std::size_t k = 0; k < scene.count("crack_fluid.inlets"); ++k) {
    if (scene.word(fmt::format("crack_fluid.inlets[{}].holds", k)) != "fluid") continue;
    if (!names(scene, "fluid")) return;  // which crack_fluid says
    const double outside = scene.number("fluid.density");
    const double inside = scene.number("crack_fluid.density");
    if (std::abs(outside - inside) <= 1e-12 * outside) return;
    scene.fail("crack_fluid.density",
               fmt::format("{:g} kg/m^3 of what comes from the free fluid", inside),
               fmt::format("fluid.density, {:g} kg/m^3", outside));
  }
}

/// What flows into the pores is of their kind, and comes from one side.
void check_exchange(const Section& scene) {
  if (!names(scene, "pore_flow")) return;
  const bool free = names(scene, "fluid") && scene.word("interface.exchange") != "none";
  const bool in_cracks =
      names(scene, "crack_fluid") && scene.word("crack_fluid.leak_off") == "pores";
  if (free) check_density(scene, "fluid");
  if (in_cracks) check_density(scene, "crack_fluid");
  if (free && in_cracks) {
    scene.fail("crack_fluid.leak_off", "free fluid seeps into the pores already",
               "none, or interface.exchange: none");
  }
}

}  // namespace

void check_sections_together(const Section& scene) {
  Mistakes mistakes;
  mistakes.note([&] {
    if (scene.count("cracks") == 0 || names(scene, "solid")) return;
    scene.fail("cracks", "the scene has no section 'solid', whose bonds they cut",
               "a solid, of type: rigid where nothing is to deform");
  });
  mistakes.note([&] { refuse_unreachable_tolerance(scene); });
  if (mistakes.note([&] { check_interface(scene); })) {
    mistakes.note([&] { check_exchange(scene); });
  }
  mistakes.note([&] {
    if (names(scene, "crack_fluid")) check_mouths(scene);
  });
  mistakes.throw_if_any();
}

}  // namespace perifrac
