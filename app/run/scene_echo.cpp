#include "app/run/scene_echo.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "app/run/written_keys.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_list.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

namespace {

constexpr std::size_t most_cracks = 8;

/// Of geometry, times and output everybody sees what they are.
constexpr auto sections = std::to_array<const char*>(
    {"solid", "damage", "pore_flow", "crack_fluid", "fluid", "interface"});

/// `210000 Pa`, `(210000, 105000) Pa`.
std::string quantity(const Section& scene, const Key& key, const std::string& path) {
  std::string unit = key.unit;
  if (const auto bar = unit.find('|'); bar != std::string::npos) {
    unit = scene.integer("dimension") == 2 ? unit.substr(0, bar) : unit.substr(bar + 1);
  }
  if (key.type == KeyType::number) return fmt::format("{:.6g} {}", scene.number(path), unit);
  return fmt::format("({:.6g}) {}", fmt::join(scene.numbers(path), ", "), unit);
}

/// What is written in a section and has a unit, places apart.
std::vector<std::string> quantities(const Section& scene, const std::string& section) {
  std::vector<std::string> read;
  for_each_written(scene, section, [&](const std::string& path, const Key& key) {
    const bool is_quantity =
        key.type == KeyType::number || key.type == KeyType::vector || key.type == KeyType::numbers;
    if (!is_quantity || key.unit.empty() || key.unit == "m" || key.unit == "s") return;
    read.push_back(path.substr(section.size() + 1) + " " + quantity(scene, key, path));
  });
  return read;
}

std::string in_megapascal(const std::vector<double>& stress) {
  std::vector<double> mega;
  for (const double s : stress) mega.push_back(1e-6 * s);
  return fmt::format("({:.6g}) MPa", fmt::join(mega, ", "));
}

/// By how much the stress grows with depth, and where it is as said.
std::string growth_of(const StatedStress& stated) {
  if (stated.gradient.empty()) return "";
  std::vector<double> mega;
  for (const double s : stated.gradient) mega.push_back(1e-6 * s);
  return fmt::format("; at the height of {:.6g} m, and ({:.6g}) MPa more a metre below",
                     stated.datum, fmt::join(mega, ", "));
}

std::string describe_at_datum(const StatedStress& stated) {
  if (stated.pores_vary) {
    const bool is_total = stated.key == "total_stress";
    return fmt::format(
        "stress at rest: {} {}, and a pore pressure that differs from place to place",
        is_total ? "total" : "effective",
        in_megapascal(is_total ? stated.total : stated.effective));
  }
  const std::string pores = fmt::format("{:.6g} of {:.6g} MPa in the pores",
                                        stated.biot_coefficient, 1e-6 * stated.pore_pressure);
  if (stated.key == "total_stress") {
    return fmt::format("stress at rest: total {}, less {} leaves an effective {}",
                       in_megapascal(stated.total), pores, in_megapascal(stated.effective));
  }
  if (stated.pore_pressure == 0.0) {
    return fmt::format("stress at rest: effective {}, and no pore pressure",
                       in_megapascal(stated.effective));
  }
  return fmt::format(
      "stress at rest: effective {}, with {} a total of {} where faces are held; "
      "solid.total_stress gives the total one",
      in_megapascal(stated.effective), pores, in_megapascal(stated.total));
}

std::string describe(const StatedStress& stated) {
  return describe_at_datum(stated) + growth_of(stated);
}

/// The total stress across each crack.
template <int D>
void append_closure(const Section& scene, const Body<D>& body, const StatedStress& stated,
                    std::vector<std::string>& lines) {
  const auto stress = read_initial_stress<D>(scene.at("solid"), body);
  const double of_water =
      stated.total[0] - (stated.key == "total_stress" ? stated.total[0] : stated.effective[0]);
  const auto cracks = read_cracks<D>(scene, body);
  for (std::size_t k = 0; k < std::min(cracks.size(), most_cracks); ++k) {
    double least = INFINITY, most = -INFINITY;
    for (const CrackFacet<D>& facet : cracks[k]) {
      const Vector<D> normal = frame<D>(facet)[0], there = stress->at(middle<D>(facet));
      const double across = of_water - dot(normal, componentwise(there, normal));
      least = std::min(least, across);
      most = std::max(most, across);
    }
    const bool is_one = most - least <= 1e-9 * std::abs(most);
    lines.push_back(
        fmt::format("crack '{}' is closed by {} MPa", scene.text(fmt::format("cracks[{}].name", k)),
                    is_one ? fmt::format("{:.6g}", 1e-6 * most)
                           : fmt::format("{:.6g} to {:.6g}", 1e-6 * least, 1e-6 * most)));
  }
}

std::string describe_toughness(const Section& scene) {
  const double energy = read_fracture_energy(scene);
  const double modulus =
      read_isotropic_elasticity<3>(scene.at("solid"), "material").plane_strain_modulus();
  return fmt::format(
      "toughness: fracture energy {:.6g} J/m^2, with E' = {:.6g} Pa a K_IC of {:.6g} MPa*sqrt(m)",
      energy, modulus, 1e-6 * std::sqrt(energy * modulus));
}

}  // namespace

std::vector<std::string> what_was_read(const Section& scene, const Simulation& simulation) {
  std::vector<std::string> lines;
  for (const std::string section : sections) {
    if (!writes(scene, section)) continue;
    if (const auto read = quantities(scene, section); !read.empty()) {
      lines.push_back(fmt::format("read {}: {}", section, fmt::join(read, ", ")));
    }
  }
  if (!has_elastic_rock(scene)) return lines;
  if (const auto stated = read_stated_stress(scene)) {
    lines.push_back(describe(*stated));
    std::visit([&](const auto& body) { append_closure(scene, *body, *stated, lines); },
               simulation.body);
  }
  if (writes(scene, "damage") && !scene.has("damage.stretch")) {
    lines.push_back(describe_toughness(scene));
  }
  return lines;
}

}  // namespace perifrac
