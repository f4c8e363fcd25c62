#include "modules/crack_fluid/uniform_pressure/uniform_pressure_type.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "core/body/crack_list.hpp"
#include "core/config/mistakes.hpp"
#include "modules/crack_fluid/crack_fluid_keys.hpp"
#include "modules/crack_fluid/uniform_pressure/uniform_pressure.hpp"

namespace perifrac {

namespace {

KeyTable uniform_pressure_keys() {
  KeyTable keys = crack_fluid_keys();
  keys.insert(keys.begin() + 1, {.path = "viscosity",
                                 .unit = "Pa s",
                                 .range = "(0, inf)",
                                 .meaning = "Not used: there is none. As network takes it, so that "
                                            "one word swaps them."});
  return keys;
}

template <int D>
std::size_t nearest_to(const Vector<D>& x, const std::vector<CrackFacet<D>>& facets) {
  const auto off = [&](const CrackFacet<D>& facet) { return norm(middle<D>(facet) - x); };
  return std::ranges::min_element(facets, {}, off) - facets.begin();
}

/// Between two pressures in one crack fluid without viscosity would flow without end.
template <int D>
void check_pressures(const Section& section, const Body<D>& body) {
  const std::vector<CrackFacet<D>> facets = all_facets<D>(read_cracks<D>(section.scene(), body));
  if (facets.empty()) return;  // which the solid says, or cracks that begin by themselves
  const CrackGraph graph{std::span<const CrackFacet<D>>(facets)};
  std::map<Index, std::string> held;  // by crack: the inlet
  Mistakes mistakes;
  for (std::size_t k = 0; k < section.count("inlets"); ++k) {
    const std::string inlet = fmt::format("inlets[{}]", k);
    if (section.word(inlet + ".holds") != "pressure") continue;
    Vector<D> at;
    std::ranges::copy(section.numbers(inlet + ".at"), at.begin());
    const auto facet = static_cast<Index>(nearest_to<D>(at, facets));
    const auto found = held.try_emplace(graph.crack(facet), section.text(inlet + ".name"));
    if (found.second) continue;
    const std::string& other = found.first->second;
    mistakes.note([&] {
      section.fail(inlet,
                   fmt::format("holds a pressure in the crack in which '{}' holds one, and fluid "
                               "without viscosity has one",
                               other),
                   "one such inlet a crack, or type: network");
    });
  }
  mistakes.throw_if_any();
}

template <int D>
std::unique_ptr<PhysicsModule> make_uniform_pressure(const Section& section,
                                                     std::shared_ptr<const Body<D>> body) {
  const CrackLiquid liquid = read_crack_liquid(section, 0.0);
  auto fluid =
      make_crack_fluid<D>(section, body, liquid, std::make_unique<UniformPressure>(liquid));
  check_pressures<D>(section, *body);
  return fluid;
}

}  // namespace

ModuleType uniform_pressure_type() {
  return {.section = "crack_fluid",
          .name = "uniform_pressure",
          .meaning =
              "Fluid in cracks that has no viscosity: one pressure in all that hangs "
              "together, full to its tips. Implicit.",
          .keys = uniform_pressure_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit(
                [&](const auto& body) { return make_uniform_pressure(section, body); }, any);
          }};
}

}  // namespace perifrac
