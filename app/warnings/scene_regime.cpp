#include "app/warnings/scene_regime.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/crack_viscosity.hpp"
#include "app/references/rock.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/time/schedule.hpp"
#include "modules/pore_flow/material/mobility.hpp"
#include "modules/pore_flow/material/pore_material.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

namespace {

/// A body as good as infinite: its faces are eight times the crack's length off, in round numbers.
constexpr double enough = 7.5;
/// A dry tip shorter than this part of the crack does not count.
constexpr double small_lag = 0.01;
/// One that no points resolve changes length, opening and pressure by less than 5 % up to here.
constexpr double large_lag = 0.2;

using Place = Vector<2>;

/// The leg of a crack that an inlet lies nearest to.
struct Mouth {
  Place normal;
  bool at_end;  ///< of the crack: what is pumped in drives one wing
};

bool drives_a_crack(const Section& scene) {
  return scene.integer("dimension") == 2 && writes(scene, "damage") &&
         scene.word("damage.type") == "energy_release" && writes(scene, "crack_fluid") &&
         scene.count("crack_fluid.inlets") == 1 && scene.count("crack_fluid.wells") == 0 &&
         scene.word("crack_fluid.inlets[0].holds") == "rate" &&
         scene.number("crack_fluid.inlets[0].rate") > 0.0;
}

Place read_inlet(const Section& scene) {
  const std::vector<double> at = scene.numbers("crack_fluid.inlets[0].at");
  return {at[0], at[1]};
}

Mouth find_mouth(const Section& scene, const Place& inlet) {
  Mouth mouth{};
  double nearest = INFINITY;
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::vector<Place> corners = read_crack_corners(scene, k);
    for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
      const Place along = corners[n + 1] - corners[n], off = inlet - corners[n];
      const double length = norm(along);
      const double share = std::clamp(dot(off, along) / squared_norm(along), 0.0, 1.0);
      const double distance = norm(off - share * along);
      if (distance >= nearest) continue;
      nearest = distance;
      mouth = {.normal = perpendicular(along) / length,
               .at_end = (n == 0 && share == 0.0) || (n + 2 == corners.size() && share == 1.0)};
    }
  }
  return mouth;
}

/// Pores under `excess` [Pa] at a face take in as Carter says, deforming along its normal alone.
double leak_off_into_pores(const Section& flow, const ElasticRock& rock, const Place& normal,
                           double excess) {
  const PoreFluid fluid = read_pore_fluid(flow);
  const PoreMaterial pores = read_pore_materials(flow, fluid)[0];
  const Tensor<2, 2> mobility = read_mobilities<2>(flow, fluid.viscosity)[0];
  const double across = dot(normal, mobility * normal);
  const double storage =
      pores.storage + pores.biot_coefficient * pores.biot_coefficient / rock.uniaxial_modulus();
  return std::max(excess, 0.0) * std::sqrt(across * storage / M_PI);
}

/// When the most has been pumped in, as a time at full rate.
double pumping_time(const Section& scene) {
  const Schedule schedule = read_schedule(scene.at("crack_fluid"), "inlets[0]");
  const double end = scene.number("time.end");
  double most = schedule.integral(0.0, end);
  for (const double t : schedule.break_points()) {
    if (t > 0.0 && t < end) most = std::max(most, schedule.integral(0.0, t));
  }
  return most;
}

/// From the inlet to the nearest face of the body, but for the one that it lies on [m].
double distance_to_faces(const PointSet& points, const Place& inlet, double spacing) {
  double least = INFINITY;
  for (int a = 0; a < 2; ++a) {
    const auto [low, high] = std::ranges::minmax(points.position[a].first(points.count));
    for (const double distance : {inlet[a] - low, high - inlet[a]}) {
      if (distance > spacing) least = std::min(least, distance + 0.5 * spacing);
    }
  }
  return least;
}

/// `notes` are about the figures of the regime alone, which runs do not depend on.
void warn(const Section& scene, double to_faces, SceneRegime& regime) {
  const double spacing = scene.number("body.spacing");
  const double length = expected_crack(regime.fracture, regime.time).length;
  const double lag = largest_lag(regime.fracture, regime.time);
  const std::string reference = writes(scene, "reference") ? scene.word("reference.type") : "";
  if (!regime.is_as_in_infinite_body) {
    (reference == "kgd" ? regime.warnings : regime.notes)
        .push_back(fmt::format("faces of the body are only {:.2g} times the crack's length from "
                               "the inlet: the figures{} "
                               "are those of an infinite body, good from 8 times on",
                               to_faces / length,
                               reference == "kgd" ? " and the reference `kgd`" : ""));
  }
  if (lag > small_lag * length && reference == "kgd") {
    regime.warnings.push_back(fmt::format(
        "the closing stress leaves a dry tip of up to {:.2g} of the crack: the reference `kgd` has "
        "no fluid lag",
        lag / length));
  }
  if (lag > large_lag * length && lag < 2.0 * spacing) {
    regime.warnings.push_back(
        fmt::format("body.spacing is too coarse for a fluid lag of {:.2g} m, which counts: two "
                    "spacings a lag are the least",
                    lag));
  }
}

}  // namespace

std::optional<SceneRegime> regime_of(const Section& scene, const Simulation& simulation) {
  if (!drives_a_crack(scene) || !has_elastic_rock(scene)) return std::nullopt;
  const ElasticRock rock = read_elastic_rock(scene);
  const Place inlet = read_inlet(scene);
  const Mouth mouth = find_mouth(scene, inlet);
  // A rate into one wing is half of that into two.
  const bool feeds_both = scene.word("crack_fluid.counts") == "both" || !mouth.at_end;
  SceneRegime regime{.fracture = {.driven = {rock.plane_strain_modulus(),
                                             read_fracture_energy(scene), crack_viscosity(scene),
                                             (feeds_both ? 1.0 : 2.0) *
                                                 scene.number("crack_fluid.inlets[0].rate")}},
                     .wings = mouth.at_end ? 1 : 2,
                     .time = pumping_time(scene),
                     .is_as_in_infinite_body = false,
                     .warnings = {},
                     .notes = {}};
  if (!(regime.time > 0.0)) return std::nullopt;
  HydraulicFracture& fracture = regime.fracture;
  if (const auto stated = read_stated_stress(scene)) {
    for (int a = 0; a < 2; ++a) {
      fracture.closing_stress += mouth.normal[a] * mouth.normal[a] * stated->total_at(a, inlet[1]);
    }
  }
  const std::string leak_off = scene.word("crack_fluid.leak_off");
  if (leak_off == "carter") {
    fracture.leak_off_coefficient = scene.number("crack_fluid.leak_off_coefficient");
  } else if (leak_off == "pores") {
    const double pressure = fracture.closing_stress +
                            storage_solution(fracture.driven, regime.time).pressure -
                            scene.number("pore_flow.initial_pressure");
    fracture.leak_off_coefficient =
        leak_off_into_pores(scene.at("pore_flow"), rock, mouth.normal, pressure);
  }
  const double to_faces =
      distance_to_faces(simulation.points(), inlet, scene.number("body.spacing"));
  regime.is_as_in_infinite_body = to_faces >= enough * expected_crack(fracture, regime.time).length;
  warn(scene, to_faces, regime);
  return regime;
}

}  // namespace perifrac
