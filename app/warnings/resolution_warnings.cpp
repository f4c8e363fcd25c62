#include "app/warnings/resolution_warnings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "app/warnings/body_box.hpp"
#include "app/warnings/inlet_places.hpp"
#include "app/warnings/mirrors_at.hpp"
#include "app/warnings/pressure_swing.hpp"
#include "core/time/schedule.hpp"
#include "modules/pore_flow/material/mobility.hpp"
#include "modules/pore_flow/material/pore_material.hpp"

namespace perifrac {

namespace {

constexpr double least_filled = 4.0;  // spacings a wing
// In radius: of 2.5, the middle of one full of water is 10 % too narrow, of one full of oil 27.
constexpr double least_disc = 3.0;
constexpr double least_wet = 2.0;    // spacings
constexpr double far_ahead = 0.2;    // of what is wet
constexpr double least_waves = 5.0;  // spacings: by half of one, energies are a tenth off then
// What leaves by a face that a layer carries is too much by what a spacing of depth holds.
constexpr double least_depth_behind_layer = 5.0;  // spacings
// Half of the first step of pressures that have gone 2.5 spacings from where they jumped.
constexpr double steep = 0.1;
constexpr double no_strain = 1e-9;
constexpr double most_residual = 0.5;  // of the widest opening; volumes are 3 % off then

/// Of a field; 0 where there is none.
double largest_of(const Simulation& simulation, const std::string& name) {
  const auto field = find_field(*simulation.manager, name);
  double largest = 0.0;
  if (field) {
    for (const double value : field->values()) largest = std::max(largest, value);
  }
  return largest;
}

/// Of a total, of the balances or not; 0 where there is none.
double total_of(const Simulation& simulation, const std::string& name) {
  for (const LedgerColumn& column : simulation.manager->ledger().columns()) {
    if (column.name == name) return column.value;
  }
  const auto field = find_field(*simulation.manager, name);
  return field ? field->values().front() : 0.0;
}

/// Within a spacing of where a crack in 2D begins or ends, or of a face of the body.
bool is_at_an_end(const Section& scene, const std::vector<double>& place) {
  const double spacing = scene.number("body.spacing");
  if (distance_to_faces(scene, place) <= spacing) return true;
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::string key = fmt::format("cracks[{}].path", k);
    if (!scene.has(key)) continue;
    const std::vector<double> path = scene.numbers(key);
    for (const std::size_t first : {std::size_t{0}, path.size() - 2}) {
      if (std::hypot(place[0] - path[first], place[1] - path[first + 1]) <= spacing) return true;
    }
  }
  return false;
}

/// How many ways fluid takes from where it comes in: in 2D to both sides, or to one from an end;
/// in 3D discs.
double wings_from_inlets(const Section& scene) {
  double wings = 0.0;
  for (const std::vector<double>& place : inlet_places(scene)) {
    wings += scene.integer("dimension") == 2 && !is_at_an_end(scene, place) ? 2.0 : 1.0;
  }
  return std::max(1.0, wings);
}

/// A length of what is `wetted_` or `open_crack_` in 2D; in 3D the radius of a disc that makes as
/// much, with its images beyond what mirrors it where fluid comes in first [m].
double size_of(const std::string& what, const Section& scene, const Simulation& simulation) {
  if (scene.integer("dimension") == 2) return largest_of(simulation, what + "length");
  const auto places = inlet_places(scene);
  const double images = places.empty() ? 1.0 : std::exp2(mirrors_at(scene, places.front()).size());
  return std::sqrt(images * largest_of(simulation, what + "area") / M_PI);
}

/// For each way that fluid takes, of what all of them make [1].
double share_of_wing(const Section& scene) {
  const double share = 1.0 / wings_from_inlets(scene);
  return scene.integer("dimension") == 2 ? share : std::sqrt(share);
}

bool pumps_at_a_rate(const Section& scene) {
  for (std::size_t k = 0; k < scene.count("crack_fluid.inlets"); ++k) {
    const std::string rate = fmt::format("crack_fluid.inlets[{}].rate", k);
    if (scene.has(rate) && scene.number(rate) > 0.0) return true;
  }
  return false;
}

/// What was pumped in, if anything, flows back or leaks off by then: cracks end as empty as they
/// come.
bool is_emptied(const Section& scene, double time) {
  if (scene.count("crack_fluid.inlets") == 0) return false;
  bool empties = scene.word("crack_fluid.leak_off") != "none";
  for (std::size_t k = 0; k < scene.count("crack_fluid.inlets"); ++k) {
    const std::string inlet = fmt::format("inlets[{}]", k);
    if (!scene.has("crack_fluid." + inlet + ".rate")) return false;
    const double flow = scene.number("crack_fluid." + inlet + ".rate") *
                        read_schedule(scene.at("crack_fluid"), inlet).factor(time);
    if (flow > 0.0) return false;
    empties = empties || flow < 0.0;
  }
  return empties;
}

/// Pores that deform along one axis alone [m^2/s]; the largest of its directions and the first of
/// its regions.
template <int D>
double diffusivity(const Section& scene) {
  const Section flow = scene.at("pore_flow");
  const PoreFluid fluid = read_pore_fluid(flow);
  const PoreMaterial pores = read_pore_materials(flow, fluid)[0];
  const Tensor<D, D> mobility = read_mobilities<D>(flow, fluid.viscosity)[0];
  double largest = 0.0;
  for (int a = 0; a < D; ++a) largest = std::max(largest, mobility[(D + 1) * a]);
  double storage = pores.storage;
  if (has_elastic_rock(scene)) {
    storage += pores.biot_coefficient * pores.biot_coefficient /
               read_elastic_rock(scene).uniaxial_modulus();
  }
  return largest / storage;
}

/// Cracks load rock far from its faces: little flows through one that holds what was there before.
bool is_left_as_it_was(const Section& scene, const std::string& face) {
  return writes(scene, "cracks") && !writes(scene, face + ".schedule") &&
         scene.number(face + ".pressure") == scene.number("pore_flow.initial_pressure");
}

/// Where fluid seeps, and how many spacings deep for its rate to be known.
struct Seepage {
  std::string through;
  double least_depth = 1.0;
  bool may_be_steady = false;  ///< a scene may begin with the flow that comes to be
};

/// Through a face whose pressure is given, cracks that leak off into pores, or where free fluid,
/// whose points lie half a spacing before it, touches the body; empty where there is none of them.
Seepage where_fluid_seeps(const Section& scene) {
  if (!writes(scene, "pore_flow")) return {};
  if (writes(scene, "crack_fluid") && scene.word("crack_fluid.leak_off") == "pores") {
    return {"the faces of cracks"};
  }
  if (writes(scene, "fluid") && scene.word("interface.exchange") != "none") {
    return {"what free fluid touches", 2.5, true};
  }
  if (!writes(scene, "pore_flow.boundary")) return {};
  for (const std::string& name : scene.names("pore_flow.boundary")) {
    const std::string face = "pore_flow.boundary." + name;
    if (scene.word(face + ".type") == "pressure" && !is_left_as_it_was(scene, face)) {
      return {fmt::format("face '{}'", name),
              is_layer(scene, name) ? least_depth_behind_layer : 1.0};
    }
  }
  return {};
}

}  // namespace

void FillingWatch::look() {
  if (!simulation_.has_body() || !scene_.has("crack_fluid")) return;
  const double time = simulation_.manager->time();
  if (is_emptied(scene_, time)) return;
  time_ = time;
  filled_ = share_of_wing(scene_) * size_of("wetted_", scene_, simulation_);
  dry_ = scene_.integer("dimension") == 2 ? largest_of(simulation_, "fluid_lag")
                                          : std::sqrt(largest_of(simulation_, "dry_area"));
}

std::optional<std::string> FillingWatch::warning() const {
  if (!(filled_ > 0.0)) return {};
  const double spacing = scene_.number("body.spacing");
  // A line of few facets that fluid fills opens as it should, a disc does not.
  double least = least_filled;
  if (!(dry_ > spacing)) least = scene_.integer("dimension") == 2 ? 0.0 : least_disc;
  if (filled_ >= least * spacing) return {};
  const bool is_end = time_ == simulation_.manager->time();
  return fmt::format(
      "fluid fills {:.2g} m of the cracks {}{}, {:.1f} spacings: its pressure and what it opens "
      "are those of facets as long as body.spacing, not of a crack; a later time.end or a finer "
      "body.spacing",
      filled_, is_end ? "in the end" : fmt::format("by t = {:.3g} s, and then less", time_),
      wings_from_inlets(scene_) > 1.0 ? " for each wing" : "", filled_ / spacing);
}

std::optional<std::string> closed_front_warning(const Section& scene,
                                                const Simulation& simulation) {
  if (!simulation.has_body() || !scene.has("crack_fluid")) return {};
  if (scene.word("crack_fluid.leak_off") == "none") return {};
  const double wet = size_of("wetted_", scene, simulation);
  const double open = size_of("open_crack_", scene, simulation);
  const double spacing = scene.number("body.spacing");
  const double ahead = share_of_wing(scene) * (wet - open);
  const bool few_open = share_of_wing(scene) * open < least_filled * spacing && wet < 2.0 * open;
  // What goes farther flows through cracks that stay closed, as it should.
  if (!(open > 0.0) || (ahead > 1.5 * spacing && !few_open)) return {};
  const double part =
      scene.integer("dimension") == 2 ? 1.0 - open / wet : 1.0 - open * open / (wet * wet);
  if (!(part > far_ahead)) return {};
  return fmt::format(
      "{:.0f} % of what fluid wets in the end are closed cracks, few facets before each front: "
      "what leaks off there depends on how long facets are; a finer body.spacing, or look at later "
      "times",
      100.0 * part);
}

std::optional<std::string> leaked_away_warning(const Section& scene, const Simulation& simulation) {
  if (!simulation.has_body() || !scene.has("crack_fluid") || !has_elastic_rock(scene)) return {};
  const double pumped = total_of(simulation, "injected_crack_fluid_mass");
  const double leaked = -total_of(simulation, "leaked_crack_fluid_mass");
  if (!(pumped > 0.0) || leaked < 0.999 * pumped) return {};
  const double pressure = total_of(simulation, "crack_fluid_work") *
                          scene.number("crack_fluid.density") / pumped;  // mean where it came in
  if (pressure > no_strain * read_elastic_rock(scene).uniaxial_modulus()) return {};
  return "all that was pumped leaked off where it came in, and no pressure built up: a smaller "
         "leak-off, or a higher rate";
}

std::optional<std::string> residual_aperture_warning(const Section& scene,
                                                     const Simulation& simulation) {
  if (!simulation.has_body() || !scene.has("crack_fluid.residual_aperture")) return {};
  if (!writes(scene, "damage") || !pumps_at_a_rate(scene)) return {};
  if (size_of("wetted_", scene, simulation) < least_wet * scene.number("body.spacing")) return {};
  const double residual = scene.number("crack_fluid.residual_aperture");
  const double widest = largest_of(simulation, "crack_opening");
  if (residual <= most_residual * widest) return {};
  return fmt::format(
      "cracks are {:.2g} m open at the widest in the end, and crack_fluid.residual_aperture is "
      "{:.2g} m: fluid fills and flows through that, not what it opens; lower it to a tenth of the "
      "openings that are expected",
      widest, residual);
}

std::optional<std::string> wave_warning(const Section& scene, double time) {
  if (!has_elastic_rock(scene) || scene.word("solid.type") != "dynamic") return {};
  const double speed =
      std::sqrt(read_elastic_rock(scene).uniaxial_modulus() / scene.number("solid.density"));
  const double spacings = speed * time / scene.number("body.spacing");
  if (!(time > 0.0) || spacings >= least_waves) return {};
  return fmt::format(
      "waves go {:.2g} m into the rock by t = {:.3g} s, {:.1f} body.spacing: stresses and energies "
      "there depend on the spacing; bring points closer together, or look at later times",
      speed * time, time, spacings);
}

namespace {

/// `seeping`: how long, by `time` [s].
std::optional<std::string> seepage_warning(const Section& scene, double time, double seeping) {
  const Seepage seepage = where_fluid_seeps(scene);
  if (seepage.through.empty() || !scene.has("body.spacing")) return {};
  // Points that see farther than 2.5 spacings tell depths as if they lay as much farther apart.
  const double blur = std::max(1.0, scene.number("body.horizon_ratio") / 2.5);
  const double resolved = blur * scene.number("body.spacing");
  const bool is_flat = scene.integer("dimension") == 2;
  const double c = is_flat ? diffusivity<2>(scene) : diffusivity<3>(scene);
  const double depth = std::sqrt(c * seeping);
  if (!(depth < seepage.least_depth * resolved)) return {};
  return fmt::format(
      "pressure goes {:.2g} m into the pores by t = {:.3g} s, less than {:.3g} body.spacing: what "
      "flows through {} depends on the spacing; bring points closer together, or look at later "
      "times",
      depth, time, seepage.least_depth * blur, seepage.through);
}

/// By what has leaked off and what does: a crack may have grown late out of what is sealed [s].
double time_of_leak_off(const Simulation& simulation) {
  const double time = simulation.manager->time();
  const double leaked = total_of(simulation, "leak_off_volume");
  const double rate = total_of(simulation, "leak_off_rate");
  return leaked > 0.0 && rate > 0.0 ? std::min(time, leaked / rate) : time;
}

}  // namespace

std::optional<std::string> seepage_warning(const Section& scene, double time) {
  return seepage_warning(scene, time, time);
}

std::optional<std::string> seepage_warning(const Section& scene, const Simulation& simulation) {
  const auto warning =
      seepage_warning(scene, simulation.manager->time(), time_of_leak_off(simulation));
  const auto pressure = find_field(*simulation.manager, "pore_pressure");
  if (!warning || !pressure || !where_fluid_seeps(scene).may_be_steady) return warning;
  const double step = std::visit(
      [&](const auto& body) { return largest_step(*body, pressure->values()); }, simulation.body);
  return step > steep ? warning : std::nullopt;
}

}  // namespace perifrac
