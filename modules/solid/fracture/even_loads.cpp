#include "modules/solid/fracture/even_loads.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace perifrac {

std::optional<EvenLoads> ask_even_loads(CutBody<2>& cracked, const EnergyRelease& energy_release,
                                        const CrackTip& at, std::span<const Index> crack) {
  if (!energy_release.is_straight(at, bent)) return {};
  const std::vector<Index> named = energy_release.looks_at(at);
  std::vector<double> unknowns(cracked.elastic().size(), 0.0);
  std::optional<double> volume;
  const auto under = [&](const Vector<2>& traction) -> std::optional<TipLoad> {
    volume = cracked.find_answer(crack, traction, named, unknowns);
    if (!volume) return {};
    return energy_release.under(at, unknowns, crack, traction);
  };
  const auto intensity = [](const TipLoad& load) {
    return std::sqrt(std::max(0.0, load.energy_release));
  };
  const Index behind = at.before != no_facet ? at.before : at.facet;
  const auto pressed = under({1.0, 0.0});
  if (!pressed) return {};
  EvenLoads even{.root_of_j = intensity(*pressed),
                 .volume = *volume,
                 .opening = cracked.jump(behind, unknowns)[0] + cracked.pressed_by(behind),
                 .sliding = 0.0};
  const auto sheared = under({0.0, 1.0});
  const double mode_two = intensity(*sheared), slid = std::abs(sheared->sliding);
  const double apart = pressed->opening + cracked.pressed_by(behind);
  if (std::min({even.root_of_j, mode_two, apart, slid}) > 0.0) {
    even.sliding = slid / mode_two * even.root_of_j / apart;
  }
  return even;
}

}  // namespace perifrac
