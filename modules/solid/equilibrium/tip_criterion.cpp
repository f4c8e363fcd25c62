#include "modules/solid/equilibrium/tip_criterion.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

TipCriterion::TipCriterion(const Body<2>& body, CrackedEquilibrium<2>& equilibrium,
                           const CrackTips& tips, const EnergyRelease& energy_release,
                           std::span<const Vector<2>> jumps, double window_length)
    : body_(body),
      equilibrium_(equilibrium),
      tips_(tips),
      energy_release_(energy_release),
      jumps_(jumps),
      fluid_weight_(equilibrium.state().fluid_weight),
      window_length_(window_length) {}

TipLaw TipCriterion::law(const MovingTip& tip) const {
  return tips_.law(equilibrium_.body().facets()[tip.facet], tip.nearest);
}

/// That of the last facet that is whole.
TipFluid TipCriterion::fluid(const MovingTip& tip) const {
  const CrackState<2> state = equilibrium_.state();
  const auto at = static_cast<std::size_t>(tip.at.facet);
  return {at < state.viscosity.size() ? state.viscosity[at] : 0.0,
          at < state.leak_off.size() ? state.leak_off[at] : 0.0};
}

double TipCriterion::speed(const MovingTip& tip, double part) const {
  return body_.spacing() * std::max(part - tip.part, 1e-12) / window_length_;
}

double TipCriterion::within_crack(const MovingTip& tip, double s) const {
  return perifrac::within_crack(s, tip.per_spacing / body_.spacing());
}

/// By an even load, the tip having crossed this part; 0: not known.
double TipCriterion::root_of_j(const MovingTip& tip, double part) const {
  const double growth = 1.0 + 0.5 * tip.per_spacing;
  const double begin = tip.even[0].root_of_j, end = tip.even[1].root_of_j;
  const double begins = begin > 0.0 ? begin : end / growth;
  const double ends = end > 0.0 ? end : begin * growth;
  return begins + part * (ends - begins);
}

/// By loads that would set `released` free by the whole facet, twice [J/m^2].
double TipCriterion::energy_release(const MovingTip& tip, double released) const {
  const double even = root_of_j(tip, tip.search.trial());
  if (even > 0.0 && tip.release > 0.0) return even * even * released / tip.release;
  const double slope = 1.0 + tip.per_spacing * (tip.search.trial() - 0.5);
  return 0.5 * slope * released / equilibrium_.body().jumps()[tip.facet].area;
}

/// An opening `behind` (0: of the last whole facet, 1: of the one before), over what holds a tip
/// that has crossed this part of its facet.
double TipCriterion::by_law(const MovingTip& tip, double part, int behind, double opening) const {
  const double s = (part + 0.5 + behind) * body_.spacing();
  const TipLaw held = law(tip);
  CrackTip at = tip.end(equilibrium_.body());
  at.place = at.place - (1.0 - part) * body_.spacing() * at.direction;
  const double open =
      opening - tips_.opening_by_layers(at, s, held, fluid_weight_, std::min(part, 1.0));
  return open / held.opening(within_crack(tip, s), s, fluid(tip), speed(tip, tip.search.trial()));
}

/// What an even load opens there, over the law of its K.
double TipCriterion::over_law(const MovingTip& tip, double part, int behind) const {
  const double root = root_of_j(tip, part);
  if (!(root > 0.0)) return 1.0;
  const double share = tip.opened(part), s = (part + 0.5 + behind) * body_.spacing();
  const double even = (1.0 - share) * tip.held[behind] + share * tip.cut[behind];
  const TipLaw unit{law(tip).plane_strain_modulus, 1.0};
  return even / (root * unit.opening(within_crack(tip, s), 0.0, {}, 1.0));
}

/// Of a facet behind a tip, in the direction that the tip came in: as far as K_I opens it.
double TipCriterion::opens_across(const MovingTip& tip, double part, int behind) const {
  const Index facet = behind == 0 ? tip.at.facet : tip.at.before;
  const double across = energy_release_.opening_across(tip.at.direction, facet, jumps_[facet]);
  const TipJump jump = energy_release_.jump(tip.at, jumps_);
  const EvenTip& even = tip.even[0];
  if (even.slid == 0.0 || !jump.is_open() || !(across > 0.0)) return across;
  const double share = tip.opened(part);
  const double by_shear =
      (1.0 - share) * tip.sheared_held[behind] + share * tip.sheared_cut[behind];
  return across - by_shear * even.modes.without_teeth(jump).sliding / even.slid;
}

/// K of a tip that fluid stays up with, by the openings behind it, over what holds it.
double TipCriterion::followed(const MovingTip& tip) const {
  const double part = tip.search.trial();
  const auto& [begins, ends] = tip.shapes;
  const auto by_openings = [&](double crossed, int behind) {
    const double opening = opens_across(tip, crossed, behind) / over_law(tip, crossed, behind);
    return by_law(tip, crossed, behind, opening);
  };
  const TipJump jump = energy_release_.jump(tip.at, jumps_);
  const auto by_jump = [&](double opening) -> TipModes {
    const double toughness = std::sqrt(law(tip).fracture_energy);
    const double sliding = tip.even[0].modes.mode_two(jump, opening, toughness);
    return {opening, sliding + opening * jump.more_at_tip()};
  };
  const auto held = [](const TipModes& modes) {
    return modes.opening > 0.0 ? kink_intensity(modes) : 0.0;
  };
  if (!ends.is_known()) {
    return held(by_jump((1.0 - part) * by_openings(part, 1) + part * by_openings(part, 0)));
  }
  const Vector<2> relief = equilibrium_.body().stress_at_rest(tip.at.place);
  const double pressure = equilibrium_.faces().pressure[tip.at.facet];
  const Eigen::Vector3d stress =
      stress_of(begins, ends, tip.opened(part), jumps_, relief, pressure);
  const auto by_shape = [&](const CrackShape& shape, double crossed, int behind) -> TipModes {
    const TipModes modes = shape.modes(stress);
    const double opening = by_intensity(tip, crossed, behind, modes.opening);
    return {opening, opening * ratio_of(modes)};
  };
  const bool was_straight = begins.intensities.empty();
  const double begin = held(was_straight ? by_jump(by_openings(0.0, 1)) : by_shape(begins, 0.0, 1));
  return (1.0 - part) * begin + part * held(by_shape(ends, 1.0, 0));
}

/// As by_law(), of a K_I [Pa m^0.5].
double TipCriterion::by_intensity(const MovingTip& tip, double part, int behind,
                                  double intensity) const {
  const double s = within_crack(tip, (part + 0.5 + behind) * body_.spacing());
  const TipLaw unit{law(tip).plane_strain_modulus, 1.0};
  return by_law(tip, part, behind, intensity / unit.toughness() * unit.opening(s, 0.0, {}, 1.0));
}

/// The logarithm of K over what holds the tip.
double TipCriterion::excess(const MovingTip& tip, std::size_t k, const CutLoad& load) const {
  const auto& faces = equilibrium_.faces();
  const PartialCuts& partial = equilibrium_.body().partial();
  const bool has_viscosity = fluid(tip).viscosity > 0.0 && tip.at.before != no_facet;
  CutLoad away = load;
  if (has_viscosity) {
    const double pressure = faces.pressure[tip.facet];
    away.traction[0] -= pressure;
    away.apart -= pressure * partial.whole_compliance(k).col(0);
  }
  const double released = away.apart[0] > 0.0 ? partial.release(k, away, away) : 0.0;
  const double dry =
      std::sqrt(std::max(0.0, energy_release(tip, released)) / law(tip).fracture_energy);
  if (!has_viscosity) return std::log(std::max(dry, 1e-6));
  return std::log(std::max({followed(tip), dry, 1e-6}));
}

/// What the tip would meet there under fluid of fixed volume: intensity falls as the crack grows.
double TipCriterion::foretold(const MovingTip& tip, double excess) const {
  const TipLaw held = law(tip);
  const TipFluid follows = fluid(tip);
  const auto holds = [&](double part) {
    const double s = (part + 0.5) * body_.spacing(), dry = within_crack(tip, s);
    const TipFluid none{0.0, 0.0};
    return std::log(held.opening(dry, s, follows, speed(tip, part)) /
                    held.opening(dry, s, none, 1.0));
  };
  const double now = holds(tip.search.trial());
  const auto left = [&](double part) {
    return excess + now - holds(part) - 1.5 * tip.per_spacing * (part - tip.search.trial());
  };
  double low = tip.part, high = TipSearch::farthest;
  if (left(high) >= 0.0) return high;
  for (int n = 0; n < 40; ++n) {
    const double middle = 0.5 * (low + high);
    (left(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace perifrac
