#include "app/run/coarse_twin.hpp"

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/run/output_times.hpp"
#include "app/run/scene_keys.hpp"
#include "app/simulation/simulation.hpp"
#include "core/base/errors.hpp"
#include "core/base/ranks.hpp"
#include "core/config/scene.hpp"
#include "coupling/processor_time.hpp"

namespace perifrac {

namespace {

/// How many times as far apart points are; the first that a scene can be had with. Crack seeds and
/// sizes ask for whole spacings.
constexpr int factors[] = {5, 4, 3, 2};

/// Cracks of fewer facets at the start are another scene's.
constexpr Index least_facets = 2;

/// Runs it.
std::optional<double> crack_size(const Section& twin, Simulation& simulation, double seconds) {
  const double begin = processor_time();
  CouplingManager& manager = *simulation.manager;
  manager.settle();
  for (const double output : read_output_times(twin.at("output"), simulation.end)) {
    while (manager.time() < output) {
      if (ranks::of_first(processor_time() - begin) > seconds) return {};
      manager.advance(output);
    }
  }
  return static_cast<double>(facet_count(simulation)) * facet_size(simulation);
}

}  // namespace

std::optional<double> crack_size_of_coarse_twin(const std::string& scene_file,
                                                std::vector<std::string> overrides,
                                                const Section& scene, double seconds) {
  if (!writes(scene, "damage") || scene.word("damage.type") != "energy_release") return {};
  overrides.emplace_back();
  for (const int factor : factors) {
    overrides.back() = fmt::format("body.spacing={:.17g} m", factor * scene.number("body.spacing"));
    try {
      const Section twin = read_scene(scene_file, overrides, scene_catalogue());
      Simulation simulation = make_simulation(twin);
      initialize(twin, simulation);
      if (facet_count(simulation) < least_facets * static_cast<Index>(scene.count("cracks")))
        continue;
      return crack_size(twin, simulation, seconds);
    } catch (const InputError&) {  // the next one
    } catch (const NumericalError&) {
      return {};
    }
  }
  return {};
}

}  // namespace perifrac
