#include "app/warnings/validity_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/free_fluid.hpp"
#include "app/warnings/fluid_in_rock.hpp"
#include "app/warnings/mean_dissipation.hpp"
#include "app/warnings/places_of.hpp"
#include "app/warnings/pressure_swing.hpp"
#include "app/warnings/small_strains.hpp"
#include "core/base/errors.hpp"
#include "core/io/log.hpp"
#include "modules/pore_flow/storage/storage_choice.hpp"

namespace perifrac {

namespace {

constexpr double large_rotation = 0.1;  ///< [rad]; taken for strains, it makes half its square
constexpr double far_density = 0.1;     ///< of free fluid, relative
constexpr double far_pressure = 0.18;   ///< over the bulk modulus: Tait's density is 5 % less there
constexpr double large_fall = 0.05;     ///< of all energy that there is or was
constexpr double large_swing = 0.05;    ///< of all that pressures range over; they are off by half
constexpr double large_drag = 0.25;     ///< of artificial viscosity, of what drives the fluid
constexpr double large_drag_in_fall = 0.35;  ///< where nothing but its weight does
constexpr double far_flow = 5.0;             ///< [spacings]; fluid at rest trembles
constexpr double fast_flow = 0.05;           ///< of what falls freely

std::string place_of(const PointSet& points, std::size_t i) {
  std::vector<double> place;
  for (int a = 0; a < points.dimension; ++a) place.push_back(points.position[a][i]);
  return describe_point(i, place);
}

/// Of a vector, component by component.
double mean_size(std::span<const double> vectors, const PointSet& points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.count; ++i) {
    double square = 0.0;
    for (int a = 0; a < points.dimension; ++a) {
      const double component = vectors[a * points.count + i];
      square += component * component;
    }
    sum += std::sqrt(square);
  }
  return sum / static_cast<double>(points.count);
}

/// From one end of what they take up to the other, along the axis where that is most [m].
double extent_of(const PointSet& points) {
  double extent = 0.0;
  for (int a = 0; a < points.dimension; ++a) {
    const auto [low, high] = std::ranges::minmax(points.position[a]);
    extent = std::max(extent, high - low);
  }
  return extent;
}

/// Of a fluid whose pressure is linear in its density.
std::optional<std::string> density_warning(const Field& pressure, double bulk_modulus,
                                           const char* advice) {
  const auto values = pressure.values();
  if (values.empty()) return {};
  const auto farthest = std::ranges::max_element(values, {}, [](double p) { return std::abs(p); });
  const double off = *farthest / bulk_modulus;
  if (!(std::abs(off) > far_pressure)) return {};
  return fmt::format(
      "{} is {:.2g} of the fluid's bulk modulus at {}: its density is far from what it was taken "
      "for; {}",
      pressure.port.name, off, place_of(pressure.points(), farthest - values.begin()), advice);
}

}  // namespace

ValidityWatch::ValidityWatch(const Section& scene, const Simulation& simulation) {
  watch_strains(scene, simulation);
  watch_pores(scene, simulation);
  watch_swings(scene, simulation);
  watch_density(scene, simulation);
  watch_rubble(scene, simulation);
  watch_leaks(scene, simulation);
  watch_viscosity(scene, simulation);
}

std::vector<std::string> ValidityWatch::look(bool is_output) {
  std::vector<std::string> warnings;
  std::erase_if(limits_, [&](Limit& limit) {
    const auto warning = limit.find();
    if (!warning) return false;
    if (limit.may_pass && !is_output) {
      if (!std::exchange(limit.is_told, true)) log_info(*warning);
      return false;
    }
    warnings.push_back(*warning);
    return true;
  });
  return warnings;
}

void ValidityWatch::watch_strains(const Section& scene, const Simulation& simulation) {
  const auto field = find_field(*simulation.manager, "displacement");
  if (!field || !simulation.has_body()) return;
  const bool turns =
      scene.has("solid.kinematics") && scene.word("solid.kinematics") == "corotational";
  const auto largest = [field, &body = simulation.body] {
    return std::visit(
        [&](const auto& b) {
          return largest_strain(*b, field->values(), 0.1 * large_strain * b->spacing());
        },
        body);
  };
  limits_.push_back({[=]() -> std::optional<std::string> {
    const LargestStrain found = largest();
    if (!(found.strain > large_strain)) return {};
    return fmt::format(
        "strains reach {:.2g} at {}, and the solid is for small ones, up to {}: its answer is off "
        "by as much; lower the loads, or look for a stiffness that is not meant",
        found.strain, place_of(field->points(), found.strained), large_strain);
  }});
  if (turns) return;
  limits_.push_back({[=]() -> std::optional<std::string> {
    const LargestStrain found = largest();
    if (!(found.rotation > large_rotation)) return {};
    return fmt::format(
        "rotations reach {:.2g} at {}, and `solid.kinematics: small` takes them for strains of "
        "{:.2g}; take `type: dynamic` with `kinematics: corotational`",
        found.rotation, place_of(field->points(), found.rotated),
        0.5 * found.rotation * found.rotation);
  }});
}

void ValidityWatch::watch_pores(const Section& scene, const Simulation& simulation) {
  const auto pressure = find_field(*simulation.manager, "pore_pressure");
  if (!pressure || !scene.has("pore_flow.fluid.cavitation_pressure")) return;
  const double least = scene.number("pore_flow.fluid.cavitation_pressure");
  limits_.push_back({[=]() -> std::optional<std::string> {
    const auto values = pressure->values();
    const auto lowest = std::ranges::min_element(values);
    if (lowest == values.end() || *lowest >= least) return {};
    return fmt::format(
        "pore_pressure falls to {:.3g} Pa at {}, below pore_flow.fluid.cavitation_pressure, {:g} "
        "Pa: fluid would boil, and the pores would not stay full, as they do here",
        *lowest, place_of(pressure->points(), lowest - values.begin()), least);
  }});
}

/// Rock that scatters, and points beside cracks, may have pressures that differ from one point to
/// the next for good reasons.
void ValidityWatch::watch_swings(const Section& scene, const Simulation& simulation) {
  const auto pressure = find_field(*simulation.manager, "pore_pressure");
  const bool scatters =
      writes(scene, "pore_flow.permeability_scatter") || writes(scene, "solid.material.scatter");
  if (!pressure || scatters || writes(scene, "cracks")) return;
  const bool is_of_ours = scene.has("pore_flow.fluid.equation_of_state");
  const bool can_be_stabler =
      is_of_ours &&
      std::visit([&](const auto& body) { return can_be_stabilised(scene.at("pore_flow"), *body); },
                 simulation.body);
  const char* const advice = can_be_stabler ? "raise pore_flow.undrained_stabilisation, or"
                                            : "drain it gradually, by a schedule, or";
  limits_.push_back(
      {.find = [=, &any = simulation.body]() -> std::optional<std::string> {
         const double swing = std::visit(
             [&](const auto& body) { return largest_swing(*body, pressure->values()); }, any);
         if (!(swing > large_swing)) return {};
         return fmt::format(
             "pore_pressure swings from point to point by {:.0f} % of what it ranges over: points "
             "are too far apart for what drained so suddenly; {} bring points closer together; "
             "later the swings die away",
             100.0 * swing, advice);
       },
       .may_pass = true});
}

void ValidityWatch::watch_density(const Section& scene, const Simulation& simulation) {
  const auto in_pores = find_field(*simulation.manager, "pore_pressure");
  if (in_pores && scene.has("pore_flow.fluid.equation_of_state") &&
      scene.word("pore_flow.fluid.equation_of_state") == "linear") {
    const double bulk_modulus = scene.number("pore_flow.fluid.bulk_modulus");
    limits_.push_back({[=] {
      return density_warning(*in_pores, bulk_modulus,
                             "take `pore_flow.fluid.equation_of_state: tait`");
    }});
  }
  const auto in_cracks = find_field(*simulation.manager, "crack_pressure");
  if (in_cracks && writes(scene, "crack_fluid")) {
    const double bulk_modulus = scene.number("crack_fluid.bulk_modulus");
    limits_.push_back({[=] {
      return density_warning(*in_cracks, bulk_modulus, "raise `crack_fluid.bulk_modulus`");
    }});
  }
  const auto density = find_field(*simulation.manager, "fluid_density");
  if (!density) return;
  const double reference = scene.number("fluid.density");
  limits_.push_back({[=]() -> std::optional<std::string> {
    const auto values = density->values();
    const auto farthest =
        std::ranges::max_element(values, {}, [=](double rho) { return std::abs(rho - reference); });
    if (farthest == values.end() || std::abs(*farthest - reference) <= far_density * reference)
      return {};
    return fmt::format(
        "fluid_density is {:.4g} kg/m^3 at {}, far from fluid.density, {:g} kg/m^3; raise "
        "`fluid.bulk_modulus`, so that loads change it by a hundredth",
        *farthest, place_of(density->points(), farthest - values.begin()), reference);
  }});
}

/// Points with few bonds left take strains from what is left of their families, and breaking the
/// rest may release less than nothing.
void ValidityWatch::watch_rubble(const Section& scene, const Simulation& simulation) {
  if (!scene.has("damage.type") || scene.word("damage.type") != "critical_stretch") return;
  limits_.push_back({[&ledger = simulation.manager->ledger(),
                      most = 0.0]() mutable -> std::optional<std::string> {
    const auto columns = ledger.columns();
    const auto broken = std::ranges::find(columns, "fracture_energy", &LedgerColumn::name);
    const auto energy = ledger.energy();
    if (broken == columns.end() || !energy) return {};
    most = std::max(most, broken->value);
    const double all = std::max(std::abs(energy->stored), std::abs(energy->gained));
    if (most - broken->value <= large_fall * all) return {};
    return fmt::format(
        "fracture_energy falls from {:.3g} to {:.3g} {}: rock has come apart into points that hold "
        "to few others, for which bonds say nothing of a crack; lower the loads, end before that, "
        "or take `damage.type: energy_release`",
        most, broken->value, broken->unit);
  }});
}

/// Rock that is `open` where it is damaged lets points in on purpose.
void ValidityWatch::watch_leaks(const Section& scene, const Simulation& simulation) {
  const auto fluid = find_field(*simulation.manager, "fluid_density");
  if (!fluid || !simulation.has_body()) return;
  if (scene.has("interface.damaged_rock") && scene.word("interface.damaged_rock") == "open") return;
  const auto moved = find_field(*simulation.manager, "displacement");
  limits_.push_back({[=, &any = simulation.body]() -> std::optional<std::string> {
    const FluidInRock found = std::visit(
        [&]<int D>(const std::shared_ptr<const Body<D>>& body) {
          return fluid_in_rock<D>(*body, moved ? moved->values() : std::span<const double>(),
                                  places_of<D>(fluid->points()));
        },
        any);
    if (found.count == 0) return {};
    return fmt::format(
        "{} of the points of free fluid are in the rock, a spacing deep and more, one at {}: they "
        "have passed through a wall; shorter steps (`fluid.courant`), or body.spacing finer where "
        "walls are thin or meet",
        found.count, place_of(fluid->points(), found.one));
  }});
}

/// Fluid under pressure or weight hardly feels what a channel's flow is held back by. Pressure that
/// swings through 0 drives as it did. What falls is driven by its weight alone, and held back as
/// soon as sound has told all of it to.
void ValidityWatch::watch_viscosity(const Section& scene, const Simulation& simulation) {
  const auto velocity = find_field(*simulation.manager, "fluid_velocity");
  const auto pressure = find_field(*simulation.manager, "fluid_pressure");
  if (!velocity || !pressure || !scene.has("fluid.artificial_viscosity")) return;
  const FreeFluid fluid = read_free_fluid(scene);
  const double least = scene.number("fluid.artificial_viscosity") * fluid.spacing *
                       std::sqrt(fluid.density * fluid.bulk_modulus);
  if (least <= fluid.viscosity) return;
  const double sound = std::sqrt(fluid.bulk_modulus / fluid.density);
  double gravity = 0.0;
  if (scene.has("gravity")) {
    for (const double g : scene.numbers("gravity")) gravity = std::hypot(gravity, g);
  }
  limits_.push_back(
      {.find = [=, &manager = *simulation.manager,
                highest = 0.0]() mutable -> std::optional<std::string> {
         const PointSet& points = velocity->points();
         for (const double p : pressure->values()) highest = std::max(highest, std::abs(p));
         if (points.count < 2) return {};
         const double speed = mean_size(velocity->values(), points);
         const double falling =
             std::min(gravity * manager.time(), std::sqrt(2.0 * gravity * extent_of(points)));
         const bool has_begun = sound * manager.time() > 2.0 * extent_of(points);
         const bool falls = has_begun && falling > 0.0 && speed > fast_flow * falling;
         if (!falls && !(manager.time() * speed > far_flow * fluid.spacing)) return {};
         const double reach = 2.0 * fluid.spacing;
         const double dissipation =
             points.dimension == 2
                 ? mean_dissipation<2>(places_of<2>(points), velocity->values(), reach)
                 : mean_dissipation<3>(places_of<3>(points), velocity->values(), reach);
         // Pressure falls by so much a length along a straight channel.
         const double fall = (least - fluid.viscosity) * dissipation / speed;
         const double pushed = falls ? 0.0 : highest / extent_of(points);
         const double share = fall / (fluid.density * gravity + pushed);
         if (!(share > (falls ? large_drag_in_fall : large_drag))) return {};
         return fmt::format(
             "artificial viscosity takes up {:.0f} % of what drives the fluid: between its points "
             "it is {:.2g} Pa s, and fluid.viscosity {:.2g}; velocities are off by as much and "
             "more; lower `fluid.spacing`, `fluid.bulk_modulus`, of whose root it is, or "
             "`fluid.artificial_viscosity`",
             100.0 * share, least, fluid.viscosity);
       },
       .may_pass = true});
}

}  // namespace perifrac
