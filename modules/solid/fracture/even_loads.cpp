#include "modules/solid/fracture/even_loads.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace perifrac {

TipJump ModeAnswer::without_teeth(const TipJump& jump) const {
  const double alone = 1.0 - opens * slides;
  return {(jump.opening - opens * jump.sliding) / alone,
          (jump.sliding - slides * jump.opening) / alone, jump.turn_to};
}

double ModeAnswer::ratio(const TipJump& jump) const {
  const TipJump own = without_teeth(jump);
  if (!jump.is_open() || !(own.opening > 0.0)) return 0.0;
  return (sliding > 0.0 ? own.sliding / sliding : modes_of(own).sliding) / own.opening;
}

double ModeAnswer::mode_two(const TipJump& jump, double mode_one, double toughness) const {
  const double by_ratio = mode_one * ratio(jump);
  if (!(std::min(sliding, root_of_j) > 0.0)) return by_ratio;
  const double alone = std::abs(without_teeth(jump).sliding) / sliding * root_of_j / toughness;
  return std::clamp(by_ratio, -alone, alone);
}

std::optional<EvenLoads> ask_even_loads(CutBody<2>& cracked, const EnergyRelease& energy_release,
                                        const CrackTip& at, std::span<const Index> crack) {
  if (!energy_release.is_straight(at, bent)) return {};
  const std::vector<Index> named = energy_release.looks_at(at);
  std::vector<double> by_pressure(cracked.elastic().size(), 0.0), by_shear = by_pressure;
  const auto volume = cracked.find_even_answers(crack, named, by_pressure, by_shear);
  if (!volume) return {};
  const auto intensity = [](const TipLoad& load) {
    return std::sqrt(std::max(0.0, load.energy_release));
  };
  const Index behind = at.before != no_facet ? at.before : at.facet;
  const TipLoad pressed = energy_release.under(at, by_pressure, crack, {1.0, 0.0});
  EvenLoads even{.root_of_j = intensity(pressed),
                 .volume = *volume,
                 .opening = cracked.jump(behind, by_pressure)[0] + cracked.pressed_by(behind),
                 .modes = {},
                 .slid = 0.0,
                 .opening_by_shear = 0.0};
  const TipLoad sheared = energy_release.under(at, by_shear, crack, {0.0, 1.0});
  const double mode_two = intensity(sheared), slid = std::abs(sheared.sliding);
  const double apart = pressed.opening + cracked.pressed_by(behind);
  if (std::min({even.root_of_j, mode_two, apart, slid}) > 0.0) {
    even.modes.sliding = slid / mode_two * even.root_of_j / apart;
    even.modes.root_of_j = even.root_of_j / apart;
    if (is_line(cracked, at, crack)) {  // else the pressure has a K_II
      even.modes.opens = sheared.opening / sheared.sliding;
      even.modes.slides = pressed.sliding / apart;
      even.slid = sheared.sliding;
      even.opening_by_shear = cracked.jump(behind, by_shear)[0];
    }
  }
  return even;
}

}  // namespace perifrac
