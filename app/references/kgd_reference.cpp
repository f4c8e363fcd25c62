#include "app/references/kgd_reference.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/kgd_solution.hpp"
#include "app/references/rock.hpp"

namespace perifrac {

namespace {

const std::string problem = "one wing of a crack that fluid drives from an axis of symmetry";

KgdProblem read_problem(const Section& scene) {
  require_word(scene, problem, "solid.type", {"quasi_static"});
  require_word(scene, problem, "solid.boundary.left.type", {"roller"});
  require_word(scene, problem, "crack_fluid.leak_off", {"none"});
  require_word(scene, problem, "crack_fluid.counts", {"both"});
  require_absent(scene, problem, {"pore_flow", "solid.regions", "damage.regions", "gravity"});
  if (!writes(scene, "damage") || scene.count("crack_fluid.inlets") != 1 ||
      !scene.has("crack_fluid.inlets[0].rate")) {
    scene.fail("reference.type", "this scene is not " + problem,
               "damage, and one inlet with a rate");
  }
  return {read_elastic_rock(scene).plane_strain_modulus(), scene.number("damage.fracture_energy"),
          scene.number("crack_fluid.viscosity"), scene.number("crack_fluid.inlets[0].rate")};
}

KgdSolution solve(const Section& scene, const KgdProblem& driven) {
  try {
    return KgdSolution(driven);
  } catch (const std::domain_error& error) {
    scene.fail("reference.type", error.what(), "a toughness that the solution is known for");
  }
}

/// Growth comes in steps of a spacing, in which everything goes up and down: means over the time of
/// one step, as the solution has it, in the latter half of the run; of these, over the exact value,
/// the one that is farthest from 1.
auto worst_mean_of_growth(const KgdSolution& solution, double spacing, double end,
                          Reference::OfTime exact) {
  return
      [=](std::span<const double> times, std::span<const double> values) -> std::optional<double> {
        std::optional<double> worst;
        for (std::size_t middle = 0; middle < times.size(); ++middle) {
          const double t = times[middle];
          // Length goes with t^(2/3).
          const double step = 1.5 * t * spacing / solution.length(t);
          if (!(t - 0.5 * step >= 0.5 * end && t + 0.5 * step <= end)) continue;  // NaN at t = 0
          double sum = 0.0, time = 0.0;
          for (std::size_t k = 1; k < times.size(); ++k) {
            if (times[k] < t - 0.5 * step || times[k] > t + 0.5 * step) continue;
            sum += (times[k] - times[k - 1]) * values[k] / exact(times[k]);
            time += times[k] - times[k - 1];
          }
          if (!(time > 0.0)) continue;
          if (!worst || std::abs(sum / time - 1.0) > std::abs(*worst - 1.0)) worst = sum / time;
        }
        return worst;
      };
}

}  // namespace

std::unique_ptr<Reference> make_kgd_reference(const Section& scene, const Simulation& simulation) {
  const KgdProblem driven = read_problem(scene);
  const KgdSolution solution = solve(scene, driven);
  const auto& manager = *simulation.manager;
  const double spacing = scene.number("body.spacing");
  const double end = scene.number("time.end");
  const double stress =
      writes(scene, "solid.confining_stress") ? scene.numbers("solid.confining_stress")[1] : 0.0;
  const std::string inlet = scene.text("crack_fluid.inlets[0].name");
  const Field length = field_named(manager, "crack_length");
  const Field pressure = field_named(manager, fmt::format("inlet_{}_pressure", inlet));
  const Field opening = field_named(manager, "crack_opening");

  auto reference = std::make_unique<Reference>(
      "kgd",
      fmt::format("two wings in an infinite body, K_m = {:.3g}", driven.dimensionless_toughness()),
      0.0);
  const auto compare = [&](const std::string& quantity, const std::string& place,
                           const std::string& unit, Reference::Computed computed,
                           Reference::OfTime exact) {
    reference->add(Reference::Error{
        quantity + "_error", [=](double t) { return std::abs(computed() / exact(t) - 1.0); }});
    const std::size_t history =
        reference->add(Reference::History{quantity + " at " + place, unit, computed, exact});
    reference->add(
        Reference::Figure{.name = quantity + " over the exact, mean of a step",
                          .unit = "",
                          .exact = 1.0,
                          .scale = 1.0,
                          .history = history,
                          .computed = worst_mean_of_growth(solution, spacing, end, exact)});
  };
  compare(
      "length", "the tip", "m", [=] { return length.values()[0]; },
      [=](double t) { return solution.length(t); });
  compare(
      "pressure", "the inlet", "Pa", [=] { return pressure.values()[0] - stress; },
      [=](double t) { return solution.pressure(t); });
  // The first facet begins at the inlet.
  compare(
      "opening", "the inlet", "m", [=] { return opening.values()[0]; },
      [=](double t) { return solution.opening(t); });
  return reference;
}

}  // namespace perifrac
