#include "app/warnings/sharp_wave_warning.hpp"

#include <fmt/format.h>

#include "app/references/comparison.hpp"

namespace perifrac {

namespace {

/// Empty: none.
std::string struck_face(const Section& scene) {
  if (!writes(scene, "solid.boundary")) return {};
  for (const std::string& face : scene.names("solid.boundary")) {
    const std::string velocity = "solid.boundary." + face + ".normal_velocity";
    if (scene.has(velocity) && scene.number(velocity) != 0.0) return face;
  }
  return {};
}

/// A probe without a field reads all of them. Empty: none.
std::string stress_probe(const Section& scene) {
  for (std::size_t n = 0; n < scene.count("output.probes"); ++n) {
    const std::string probe = fmt::format("output.probes[{}]", n);
    if (!scene.has(probe + ".field") || scene.text(probe + ".field").ends_with("stress")) {
      return scene.text(probe + ".name");
    }
  }
  return {};
}

}  // namespace

std::optional<std::string> sharp_wave_warning(const Section& scene) {
  if (!has_elastic_rock(scene) || scene.word("solid.type") != "dynamic") return {};
  const std::string face = struck_face(scene), probe = stress_probe(scene);
  if (face.empty() || probe.empty()) return {};
  return fmt::format(
      "face '{}' begins to move at once: waves go out from it as steep as points allow, and the "
      "stress at probe '{}' at one moment depends on body.spacing by a tenth to a third; compare "
      "energies, paths, or means over a few of them",
      face, probe);
}

}  // namespace perifrac
