#include "modules/solid/material/stress_at_rest.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "core/body/fluid_weight.hpp"
#include "core/body/highest_corner.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

namespace {

constexpr const char* effective_key = "confining_stress";
constexpr const char* total_key = "total_stress";
constexpr const char* gradient_key = "stress_gradient";
constexpr const char* datum_key = "stress_datum";
/// Of the rock's weight: so much the vertical gradient may be off it.
constexpr double weight_tolerance = 0.01;

std::string in_region(const std::string& name, const char* key) {
  return "regions." + name + "." + key;
}

/// The first path, of the whole body or of a region, that says it by this key.
std::optional<std::string> path_of(const Section& section, const char* key) {
  if (section.has(key)) return key;
  if (!section.has("regions")) return {};
  for (const std::string& name : section.names("regions")) {
    if (section.has(in_region(name, key))) return in_region(name, key);
  }
  return {};
}

bool writes_pore_pressure(const Section& scene) {
  return std::ranges::count(scene.names("pore_flow"), "initial_pressure") > 0;
}

/// Which of the two keys the scene says it by; null: neither.
const char* stress_key(const Section& section) {
  const auto total = path_of(section, total_key);
  const auto effective = path_of(section, effective_key);
  if (!total && !effective && section.has(gradient_key)) {
    section.fail(gradient_key, "beside no stress at rest", "confining_stress or total_stress");
  }
  if (section.has(gradient_key) && !section.has(datum_key)) {
    section.fail(gradient_key, "no stress_datum says where the stress is as said",
                 "solid.stress_datum, a height in m");
  }
  if (!total) return effective ? effective_key : nullptr;
  if (path_of(section, effective_key)) {
    section.fail(*total, "beside confining_stress, which is the effective stress",
                 "one of the two: total_stress holds alpha times the pore pressure, "
                 "confining_stress does not");
  }
  const Section scene = section.scene();
  if (!scene.has("pore_flow")) return total_key;
  if (!writes_pore_pressure(scene)) {
    section.fail(*total, "beside pore_flow, and nothing says which pore pressure is in it",
                 "pore_flow.initial_pressure, or confining_stress, the effective stress");
  }
  if (scene.word("pore_flow.initial_state") == "hydrostatic" &&
      scene.word("pore_flow.fluid.equation_of_state") != "linear") {
    section.fail(*total, "beside a fluid whose weight changes with depth",
                 "pore_flow.fluid.equation_of_state: linear, or confining_stress, the effective "
                 "stress");
  }
  if (scene.word("solid.type") == "dynamic") {
    section.fail(*total, "beside pore_flow in a solid with inertia",
                 "confining_stress, the effective stress: total less alpha times pore pressure");
  }
  return total_key;
}

template <int D>
Vector<D> read_tension(const Section& section, const std::string& path) {
  Vector<D> stress;
  std::ranges::transform(section.numbers(path), stress.begin(), std::negate());
  return stress;
}

/// The first region that has a stress of its own.
std::optional<std::string> stressed_region(const Section& section, const char* key) {
  if (!section.has("regions")) return {};
  for (const std::string& name : section.names("regions")) {
    if (section.has(in_region(name, key))) return in_region(name, key);
  }
  return {};
}

/// With gravity the gradient is the rock's weight: the body is at rest under both.
template <int D>
void require_weight(const Section& section, const char* key) {
  const Section scene = section.scene();
  if (!scene.has("gravity") || !section.has("density")) return;
  if (key == std::string_view(effective_key) && scene.has("pore_flow")) {
    section.fail(gradient_key, "of the effective stress, beside gravity", "total_stress");
  }
  std::vector<double> force = scene.numbers("gravity");
  for (double& f : force) f *= section.number("density");
  const double grows = section.numbers(gradient_key)[D - 1], weight = -force[D - 1];
  const bool is_upright =
      std::all_of(force.begin(), force.end() - 1, [](double f) { return f == 0.0; });
  if (is_upright && std::abs(grows - weight) <= weight_tolerance * std::abs(weight)) return;
  section.fail(
      gradient_key,
      fmt::format("{:g} Pa/m along {}, which is not the weight of the rock", grows, "xyz"[D - 1]),
      is_upright ? fmt::format("{:g} Pa/m there, solid.density times gravity", weight)
                 : fmt::format("gravity along {} alone", "xyz"[D - 1]));
}

template <int D>
void read_gradient(const Section& section, const char* key, const Body<D>& body,
                   InitialStress<D>& stress) {
  if (!section.has(gradient_key)) return;
  if (body.has_cutouts()) {
    section.fail(gradient_key, "in a body with cutouts", "the same stress at all heights");
  }
  require_weight<D>(section, key);
  std::ranges::copy(section.numbers(gradient_key), stress.by_height.begin());
  stress.datum = section.number(datum_key);
}

/// A region whose faces lie within the body bears what the rest bears across them.
template <int D>
void require_rest(const Section& section, const std::string& path, const Region<D>& region,
                  const Vector<D>& inside, const Vector<D>& elsewhere, const Points<D>& points) {
  for (int a = 0; a < D; ++a) {
    const auto [least, largest] = std::ranges::minmax(points.position[a]);
    const bool ends = region.from[a] > least || region.to[a] < largest;
    if (!ends || inside[a] == elsewhere[a]) continue;
    section.fail(path,
                 fmt::format("a stress along {} that jumps across a face of the region",
                             std::string(1, "xyz"[a])),
                 fmt::format("{:g} Pa along it, as elsewhere", -elsewhere[a]));
  }
}

}  // namespace

KeyTable stress_at_rest_keys() {
  const std::string in_a_region =
      "The same in a region of the body, beside cracks that grow by energy_release. What a layer "
      "bears across its faces is to be what the rest bears there.";
  return {{.path = effective_key,
           .type = KeyType::vector,
           .unit = "Pa",
           .meaning = "Effective normal stress of the body at rest along every axis, compressive "
                      "positive: total stress less alpha times pore pressure, which pore_flow "
                      "adds. What lies behind the faces bears it, and nothing of pore pressure."},
          {.path = total_key,
           .type = KeyType::vector,
           .unit = "Pa",
           .meaning = "In place of confining_stress: the total stress, of which alpha times "
                      "pore_flow.initial_pressure is the pore water's; all of it without pore_flow "
                      "is the rock's. What lies behind the faces bears it."},
          {.path = gradient_key,
           .type = KeyType::vector,
           .unit = "Pa/m",
           .meaning = "How either grows with depth, in regions too, beside cracks that grow by "
                      "energy_release: it counts times stress_datum less the height, y, in 3D z. "
                      "Beside gravity the vertical one is the weight of the rock, which is at "
                      "rest under both."},
          {.path = datum_key,
           .unit = "m",
           .meaning = "The height at which the stress is as said; stress_gradient needs it."},
          {.path = in_region("*", effective_key),
           .type = KeyType::vector,
           .unit = "Pa",
           .meaning = in_a_region},
          {.path = in_region("*", total_key),
           .type = KeyType::vector,
           .unit = "Pa",
           .meaning = in_a_region}};
}

std::optional<StatedStress> read_stated_stress(const Section& scene) {
  if (!scene.has("solid") || scene.word("solid.type") == "rigid") return {};
  const Section section = scene.at("solid");
  const char* const key = stress_key(section);
  if (key == nullptr || !section.has(key)) return {};
  StatedStress stated{.key = key,
                      .effective = section.numbers(key),
                      .total = section.numbers(key),
                      .biot_coefficient = 0.0,
                      .pore_pressure = 0.0};
  if (section.has(gradient_key)) {
    stated.gradient = section.numbers(gradient_key);
    stated.datum = section.number(datum_key);
  }
  if (!scene.has("pore_flow")) return stated;
  stated.pores_vary = scene.word("pore_flow.initial_state") != "uniform";
  stated.biot_coefficient = scene.number("pore_flow.biot_coefficient");
  stated.pore_pressure = scene.number("pore_flow.initial_pressure");
  const double of_water = stated.biot_coefficient * stated.pore_pressure;
  const bool is_total = key == std::string_view(total_key);
  for (double& stress : stated.effective) stress -= is_total ? of_water : 0.0;
  for (double& stress : stated.total) stress += is_total ? 0.0 : of_water;
  return stated;
}

template <int D>
std::optional<InitialStress<D>> read_initial_stress(const Section& section, const Body<D>& body) {
  const char* const key = stress_key(section);
  if (key == nullptr) return {};
  const auto stressed = stressed_region(section, key);
  if (!section.has(key)) {
    section.fail(*stressed, "beside no stress elsewhere", fmt::format("solid.{}", key));
  }
  if (stressed && body.has_cutouts()) {
    section.fail(*stressed, "in a body with cutouts", fmt::format("one solid.{}", key));
  }
  InitialStress<D> stress{{read_tension<D>(section, key)}};
  read_gradient<D>(section, key, body, stress);
  if (!stressed) return stress;
  auto& [elsewhere, inside] = stress.at_datum;
  region_of_points<D>(section, body.regions(), body.points());  // says which do not exist
  for (const std::string& name : section.names("regions")) {
    const std::string path = in_region(name, key);
    if (!section.has(path)) continue;
    const Region<D>& region = *std::ranges::find(body.regions(), name, &Region<D>::name);
    inside.emplace_back(region, read_tension<D>(section, path));
    require_rest<D>(section, path, region, inside.back().second, elsewhere, body.points());
  }
  return stress;
}

template <int D>
std::optional<Vector<D>> read_uniform_stress(const Section& section) {
  const char* const key = stress_key(section);
  if (key == nullptr) return {};
  if (const auto path = stressed_region(section, key)) {
    section.fail(*path, "without cracks that grow by energy_release", fmt::format("solid.{}", key));
  }
  if (section.has(gradient_key)) {
    section.fail(gradient_key, "without cracks that grow by energy_release",
                 "the same stress at all heights");
  }
  return read_tension<D>(section, key);
}

namespace {

/// p0 + gradient . (x - origin).
template <int D>
struct PorePressureAtRest {
  double pressure;
  Vector<D> gradient{};
  Vector<D> origin{};
};

template <int D>
PorePressureAtRest<D> read_pore_pressure_at_rest(const Section& flow, const Body<D>& body) {
  PorePressureAtRest<D> at_rest{.pressure = flow.number("initial_pressure")};
  const std::string state = flow.word("initial_state");
  if (state == "linear") {
    std::ranges::copy(flow.numbers("initial_gradient"), at_rest.gradient.begin());
  } else if (state == "hydrostatic" && flow.scene().has("gravity")) {
    const auto gravity = read_gravity<D>(flow);
    at_rest.gradient = flow.number("fluid.density") * gravity;
    at_rest.origin = highest_corner<D>(body, gravity);
  }
  return at_rest;
}

}  // namespace

template <int D>
std::vector<double> read_pore_stress_at_rest(const Section& section, const Body<D>& body) {
  const Section scene = section.scene();
  const char* const key = stress_key(section);
  if (key == nullptr || key != std::string_view(total_key) || !scene.has("pore_flow")) return {};
  const Section flow = scene.at("pore_flow");
  std::vector<double> biot = {flow.number("biot_coefficient")};
  for (const std::string& name : flow.names("regions")) {
    const std::string path = in_region(name, "biot_coefficient");
    biot.push_back(flow.has(path) ? flow.number(path) : biot.front());
  }
  const auto [pressure, gradient, origin] = read_pore_pressure_at_rest<D>(flow, body);
  const std::vector<std::uint8_t> region = region_of_points<D>(flow, body.regions(), body.points());
  std::vector<double> stress(region.size());
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const Vector<D> off = body.points().at(static_cast<Index>(i)) - origin;
    stress[i] = biot[region[i]] * (pressure + dot(gradient, off));
  }
  return stress;
}

template std::optional<InitialStress<2>> read_initial_stress<2>(const Section&, const Body<2>&);
template std::optional<InitialStress<3>> read_initial_stress<3>(const Section&, const Body<3>&);
template std::optional<Vector<2>> read_uniform_stress<2>(const Section&);
template std::optional<Vector<3>> read_uniform_stress<3>(const Section&);
template std::vector<double> read_pore_stress_at_rest<2>(const Section&, const Body<2>&);
template std::vector<double> read_pore_stress_at_rest<3>(const Section&, const Body<3>&);

}  // namespace perifrac
