#include "modules/solid/fracture/crack_tips.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/small_vector.hpp"
#include "core/state/visit_each.hpp"
#include "modules/solid/fracture/loose_piece.hpp"

namespace perifrac {

namespace {

/// A tip waits at the beginning of a facet that it would cross evenly meanwhile: what viscosity
/// asks for is taken further on. Chosen between 0.1 and 0.38, the middle of the facet, by
/// docs/fracture.md.
constexpr double viscous_offset = 0.25;

/// Of what it takes: below this the opening says for certain that J is not enough.
constexpr double worth_asking = 0.9;

/// K_I and the opening of the last facet may differ by so much of what the opening has changed by
/// (1.3 was met), up to this change. What a guess leaves open decides nothing: windows end, and
/// tips go on, within `near` of the criterion.
constexpr double guess_error = 1.5, telling_change = 0.15, near = 0.005;

/// A turn below this is rounding [rad].
constexpr double least_turn = 1e-6;

/// A piece of so few points lies within two spacings.
constexpr std::size_t chip = 4;

/// K_I by an even pressure of 1 Pa on a straight crack in an infinite body [m^0.5].
double line_intensity(const CutBody<2>& body, std::span<const Index> crack) {
  double length = 0.0;
  for (const Index f : crack) length += body.jumps()[f].area;
  return std::sqrt(0.5 * M_PI * length);
}

}  // namespace

CrackTips::CrackTips(const Body<2>& body, CutBody<2>& cracked, FractureEnergy<2> fracture_energy)
    : body_(body),
      cracked_(cracked),
      fracture_energy_(std::move(fracture_energy)),
      energy_release_(cracked, body.spacing(), body.holes()) {}

void CrackTips::start(std::span<const CrackFacet<2>> seeds, double t) {
  tips_.clear();
  take_ends(seeds, 0, t);
}

void CrackTips::take_ends(std::span<const CrackFacet<2>> facets, std::size_t first, double t) {
  for (std::size_t f = first; f < facets.size(); ++f) {
    for (const int end : {0, 1}) {
      const Vector<2>& place = facets[f][end];
      Index before = no_facet;
      bool joined = false;
      for (std::size_t g = 0; g < facets.size(); ++g) {
        if (g == f) continue;
        joined = joined || facets[g][0] == place || facets[g][1] == place;
        if (facets[g][0] == facets[f][1 - end] || facets[g][1] == facets[f][1 - end]) {
          before = static_cast<Index>(g);
        }
      }
      if (joined) continue;
      const double sign = end == 1 ? 1.0 : -1.0;
      const Vector<2>& along = cracked_.jumps()[f].tangents[0];
      Tip tip{.at = {place, sign * along, static_cast<Index>(f), before},
              .since = t,
              .grows = true,
              .nearest = body_.nearest_point(place)};
      tip.grows = cracked_.is_intact_along(next_facet(tip.at, 0.0));
      if (tip.grows) tips_.push_back(tip);
    }
  }
}

CrackFacet<2> CrackTips::next_facet(const CrackTip& tip, double turn) const {
  const double c = std::cos(turn), s = std::sin(turn);
  const Vector<2> ahead = c * tip.direction + s * perpendicular(tip.direction);
  return {tip.place, tip.place + body_.spacing() * ahead};
}

bool CrackTips::cut_ahead(const CrackFacet<2>& facet) {
  try {
    return cracked_.cut(facet);
  } catch (const PieceCutFree& piece) {
    if (piece.points() > chip) throw;
    return false;
  }
}

double CrackTips::energy_to_cut(const CrackFacet<2>& facet) const {
  return fracture_energy_.at(middle<2>(facet));
}

TipLaw CrackTips::law(const CrackFacet<2>& facet, Index nearest) const {
  return {cracked_.elastic().law(nearest).plane_strain_modulus(), energy_to_cut(facet)};
}

double CrackTips::readiness(Tip& tip, const CrackState<2>& state,
                            std::span<const Vector<2>> jumps) const {
  if (is_followed(tip, state) && tip.even.opening == 0.0) ask_even_loads(tip);
  // A step of a whole facet under fluid of fixed volume takes the energy release down on its way:
  // what counts is the mean of its beginning and end.
  const double needed =
      state.has_fluid() ? 2.0 / (1.0 + tip.intensity_ratio * tip.intensity_ratio) : 1.0;
  TipLaw tip_law = law(next_facet(tip.at, 0.0), tip.nearest);
  tip_law.fracture_energy *= needed;
  if (!is_followed(tip, state)) {
    tip.modes.reset();
    const double readiness = dry_readiness(tip, tip_law, state, 0.0);
    // Fluid without viscosity is at the tip and leaks.
    const bool leaks = !state.leak_off.empty() && state.leak_off[tip.at.facet] > 0.0;
    return leaks ? readiness / beyond_mean(tip, state) : readiness;
  }
  tip.modes = followed_modes(tip, tip_law, state, jumps);
  TipModes own = *tip.modes;
  if (!tip.shape.is_known()) {
    own.sliding += own.opening * energy_release_.jump(tip.at, jumps).more_at_tip();
  }
  return std::max(kink_intensity(own), lagging_readiness(tip, tip_law, state));
}

/// Viscous fluid is at the tip.
bool CrackTips::is_followed(const Tip& tip, const CrackState<2>& state) const {
  return state.has_fluid() && tip.at.before != no_facet && state.viscosity[tip.at.facet] > 0.0;
}

/// From K_I, without what fluid does beyond its pressure. J asks for the displacements, which are
/// dear: away from growth, `lost` taken off, K_I goes with the opening of the last facet since J
/// was asked last, where that is the fluid's doing. Other loads may shear the crack as well.
double CrackTips::dry_readiness(Tip& tip, const TipLaw& tip_law, const CrackState<2>& state,
                                double lost) const {
  if (is_closed(tip.at, state)) {
    tip.asked = tip.asked_opening = 0.0;
    return 0.0;
  }
  const double opening = state.opening[tip.at.facet];
  if (tip.asked_opening > 0.0 && state.has_fluid() && !state.inertia) {
    const double guess = tip.asked * opening / tip.asked_opening;
    const double change = std::abs(opening / tip.asked_opening - 1.0);
    const bool is_telling = std::abs(guess - lost - 1.0) > near + guess_error * change;
    if (change < telling_change && is_telling) return guess;
  }
  const TipLoad load =
      energy_release_.at(tip.at, state.unknowns([&] { return energy_release_.looks_at(tip.at); }),
                         state.pressure, state.pore_stress, state.inertia, state.shear);
  // Faces that slide under friction may go on without an opening.
  const bool may_go = load.opening > 0.0 || !state.shear.empty();
  const bool opens = may_go && load.energy_release > 0.0;
  TipModes modes = modes_of(load);
  modes.sliding += modes.opening * load.more_at_tip();
  const double straight_on = std::hypot(modes.opening, modes.sliding);
  const double turned = straight_on > 0.0 ? kink_intensity(modes) / straight_on : 1.0;
  tip.asked = opens ? turned * std::sqrt(load.energy_release / tip_law.fracture_energy) : 0.0;
  tip.asked_opening = opens ? opening : 0.0;
  // The nearer two tips are, the larger their K: one that has come so near goes on.
  const bool meets = may_go && tip.moved && energy_release_.meets_another(tip.at, state.opening);
  return meets ? std::max(tip.asked, 1.0) : tip.asked;
}

/// Dry faces that touch and have not slid under friction: what is there of a jump is rounding, of
/// either sign, and J that of whatever else its ring holds.
bool CrackTips::is_closed(const CrackTip& at, const CrackState<2>& state) const {
  return std::ranges::all_of(std::array{at.facet, at.before}, [&](Index facet) {
    if (facet == no_facet) return true;
    const bool is_wet = state.has_fluid() && state.viscosity[facet] > 0.0;
    const bool has_slid = !state.slip.empty() && state.slip[facet] != 0.0;
    return !is_wet && !has_slid && state.opening[facet] <= 0.0;
  });
}

/// For fluid that stays up with the tip: K_I from the opening at the last facet but one, K_II from
/// how far the faces slide beside how far they open.
TipModes CrackTips::followed_modes(Tip& tip, const TipLaw& tip_law, const CrackState<2>& state,
                                   std::span<const Vector<2>> jumps) const {
  const CrackTip& at = tip.at;
  const double speed = body_.spacing() / std::max(state.t - tip.since, 1e-300);
  const TipFluid fluid{state.viscosity[at.facet],
                       state.leak_off.empty() ? 0.0 : state.leak_off[at.facet]};
  const double s = behind(at);
  const TipJump jump = energy_release_.jump(at, jumps);
  const CrackShape& its = tip.shape;
  const bool is_bent = its.is_known();
  TipModes by_shape{};
  if (is_bent)
    by_shape = its.modes(stress_of(its, its, 1.0, jumps, cracked_.stress_at_rest(at.place),
                                   state.pressure[at.facet]));
  double open = energy_release_.opening_across(at.direction, at.before, jumps[at.before]);
  if (is_bent && !tip.even.is_known) {
    open = by_shape.opening / tip_law.toughness() *
           tip_law.opening(within_crack(tip, s), 0.0, {}, 1.0);
  } else if (jump.is_open() && open > 0.0) {
    open -= tip.even.opens * tip.even.modes.without_teeth(jump).sliding;
  }
  const double opening =
      (open / tip.even.opening - opening_by_layers(at, s, tip_law, state.fluid_weight)) /
      tip_law.opening(within_crack(tip, s), s + viscous_offset * body_.spacing(), fluid, speed) /
      beyond_mean(tip, state);
  // The ratio is that of the faces as far behind as a facet resolves, of fluid that is viscous too.
  const double toughness = std::sqrt(tip_law.fracture_energy);
  return {opening, is_bent ? opening * ratio_of(by_shape)
                           : tip.even.modes.mode_two(jump, opening, toughness)};
}

/// A facet that has just been cut leaks most: the crack's volume sags meanwhile and comes back, so
/// that what opens when the tip goes on is beyond the mean of the step, by this factor. Carter's
/// law takes 4 C_L sqrt(T (n + x)) a length from the facet that was cut n steps of T ago; the sum
/// of that, less what is linear in x from 0 to 1, has the mean -4 C_L sqrt(T) zeta(-1/2).
double CrackTips::beyond_mean(const Tip& tip, const CrackState<2>& state) const {
  constexpr double sag = 0.2078862249773546;  // -zeta(-1/2)
  if (state.leak_off.empty() || tip.took == 0.0) return 1.0;
  const double took = std::min(tip.took, state.t - tip.since);
  double volume = 0.0, lost = 0.0;
  for (const Index f : crack_of(tip.at.facet)) {
    const double length = cracked_.jumps()[f].area;
    volume += length * std::max(0.0, state.opening[f]);
    for (const Tip& other : tips_) {
      if (other.at.facet != f || !other.grows) continue;
      lost += 4.0 * sag * state.leak_off[f] * std::sqrt(took) * length;
    }
  }
  return volume > 0.0 ? 1.0 + lost / volume : 1.0;
}

/// What faces do under even loads, beside what K_I and K_II of that J do by the law.
void CrackTips::ask_even_loads(Tip& tip) const {
  tip.even = {.opening = 1.0};
  const std::vector<Index> crack = crack_of(tip.at.facet);
  const double modulus = cracked_.elastic().law(tip.nearest).plane_strain_modulus();
  tip.shape = {};
  if (!energy_release_.is_straight(tip.at, bent)) {
    tip.shape = crack_shape(cracked_, tip.at, crack, crack,
                            facets_near(cracked_, crack, tip.at.place), modulus);
    if (tip.scale > 0.0) tip.shape.scale = tip.scale;
  }
  const auto even = perifrac::ask_even_loads(cracked_, energy_release_, tip.at, crack);
  if (!even) return;
  if (!(std::min({even->root_of_j, even->opening, even->volume, even->modes.sliding}) > 0.0))
    return;
  tip.even.is_known = true;
  tip.even.intensity = even->root_of_j / even->volume;
  if (tip.intensity_before > 0.0) {
    tip.intensity_ratio = std::min(1.0, tip.even.intensity / tip.intensity_before);
  }
  // Of any toughness: what is asked are ratios.
  const TipLaw tip_law{modulus, 1.0};
  const double dry = tip_law.opening(within_crack(tip, behind(tip.at)), 0.0, {}, 1.0);
  tip.even.opening = even->opening / (dry * even->root_of_j);
  tip.scale = even->root_of_j * std::sqrt(modulus) / line_intensity(cracked_, crack);
  tip.even.modes = even->modes;
  if (even->slid != 0.0) tip.even.opens = even->opening_by_shear / even->slid;
}

std::vector<Index> CrackTips::crack_of(Index facet) const {
  const std::span<const CrackFacet<2>> facets = cracked_.facets();
  std::vector<Index> crack = {facet};
  std::vector<bool> taken(facets.size(), false);
  taken[facet] = true;
  for (std::size_t next = 0; next < crack.size(); ++next) {
    const CrackFacet<2>& from = facets[crack[next]];
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const bool joined = facets[f][0] == from[0] || facets[f][0] == from[1] ||
                          facets[f][1] == from[0] || facets[f][1] == from[1];
      if (taken[f] || !joined) continue;
      taken[f] = true;
      crack.push_back(static_cast<Index>(f));
    }
  }
  return crack;
}

/// Fluid holds a tip back by the pressure that it loses on its way there, and it cannot lose more
/// than it has: a tip that would go on if its last facet were empty does, and the fluid lags.
double CrackTips::lagging_readiness(Tip& tip, const TipLaw& tip_law,
                                    const CrackState<2>& state) const {
  const CrackTip& at = tip.at;
  // K_I of a pressure that ends a facet behind the tip of a long crack.
  const double lost = 2.0 * std::sqrt(2.0 / M_PI * cracked_.jumps()[at.facet].area) *
                      state.pressure[at.facet] / tip_law.toughness();
  // J asks for the displacements, which are dear. Pressure that falls towards the tip opens the
  // crack behind it by more than K_I alone, so that the opening says where J is in vain.
  const double most =
      state.opening[at.before] / tip_law.opening(within_crack(tip, behind(at)), 0.0, {}, 1.0);
  if (most - lost < worth_asking) return 0.0;
  return dry_readiness(tip, tip_law, state, lost) - lost;
}

/// What the opening at s behind the tip has beyond K_I's share of it, K' sqrt(s) / E', where the
/// rock that faces are relieved of is not under the same stress as at the tip: of the load q(s')
/// behind the tip of a long crack
///   w(s) = 4 / (pi E') int q ln|(sqrt s + sqrt s') / (sqrt s - sqrt s')| ds',
///   K_I = sqrt(8 / pi) int q / sqrt(4 s') ds'   [m].
double CrackTips::opening_by_layers(const CrackTip& at, double s, const TipLaw& tip_law,
                                    std::span<const double> fluid_weight, double part) const {
  const auto facets = static_cast<Index>(cracked_.facets().size());
  const bool has_weight = std::ssize(fluid_weight) == facets;
  if (!cracked_.relief_varies() && !has_weight) return 0.0;
  const auto load = [&](Index f) {
    return cracked_.relief(f)[0] + (has_weight ? fluid_weight[f] : 0.0);
  };
  double there = load(at.facet);
  if (part < 1.0) there = part * there + (1.0 - part) * load(at.before);
  const auto integral = [s](double t) {
    if (t == s) return -2.0 * s;
    const double a = std::sqrt(s), b = std::sqrt(t);
    return (t - s) * std::log(std::abs((a + b) / (a - b))) - 2.0 * a * b;
  };
  double sum = 0.0;
  for (Index f = 0; f < facets; ++f) {
    const CrackFacet<2>& facet = cracked_.facets()[f];
    const auto from_tip = [&](const Vector<2>& x) {
      return std::hypot(x[0] - at.place[0], x[1] - at.place[1]);
    };
    const bool is_last = f == at.facet;
    const double one = is_last ? 0.0 : from_tip(facet[0]);
    const double other = is_last ? part * cracked_.jumps()[f].area : from_tip(facet[1]);
    const double more = load(f) - there;
    sum += more * (integral(std::max(one, other)) - integral(std::min(one, other)));
  }
  return 4.0 / (M_PI * tip_law.plane_strain_modulus) * sum;
}

/// From the tip to the middle of the last facet but one [m].
double CrackTips::behind(const CrackTip& at) const {
  const Vector<2> back = at.place - middle<2>(cracked_.facets()[at.before]);
  return std::hypot(back[0], back[1]);
}

double CrackTips::within_crack(const Tip& tip, double s) const {
  return perifrac::within_crack(s, (1.0 - tip.intensity_ratio) / 1.5 / body_.spacing());
}

double CrackTips::find_readiness(const CrackState<2>& state) {
  const auto may_go = [&](const Tip& tip) {
    return tip.grows && state.t >= tip.since + state.pause;
  };
  std::vector<Vector<2>> jumps;
  if (std::ranges::any_of(tips_,
                          [&](const Tip& tip) { return may_go(tip) && is_followed(tip, state); })) {
    jumps = state.jumps();
  }
  double most = 0.0;
  for (Tip& tip : tips_) {
    tip.readiness = may_go(tip) ? readiness(tip, state, jumps) : 0.0;
    most = std::max(most, tip.readiness);
  }
  return most;
}

double CrackTips::turn_of(const CrackTip& tip, const TipModes& modes, double turn_to,
                          const TipLaw& tip_law, double readiness) const {
  const double held = 4.0 * std::sqrt(2.0 / M_PI * body_.spacing()) *
                      cracked_.stress_along(tip.facet) / (readiness * tip_law.toughness());
  const double intensity = kink_intensity(modes);
  const double turn = turn_to + kink_angle(modes, intensity > 0.0 ? held * intensity : 0.0);
  return std::abs(turn) < least_turn ? 0.0 : turn;
}

double CrackTips::turn_of(const Tip& tip, std::span<const Vector<2>> jumps) const {
  const TipJump jump = energy_release_.jump(tip.at, jumps);
  const TipLaw tip_law = law(next_facet(tip.at, 0.0), tip.nearest);
  const bool by_shape = tip.modes && tip.shape.is_known();
  return turn_of(tip.at, tip.modes ? *tip.modes : modes_of(jump), by_shape ? 0.0 : jump.turn_to,
                 tip_law, tip.readiness);
}

std::vector<std::pair<CrackTip, double>> CrackTips::take_ready(const CrackState<2>& state) {
  const std::vector<Vector<2>> jumps = state.jumps();
  std::vector<std::pair<CrackTip, double>> taken;
  std::erase_if(tips_, [&](const Tip& tip) {
    if (!tip.grows || tip.readiness < ready) return false;
    taken.emplace_back(tip.at, turn_of(tip, jumps));
    return true;
  });
  return taken;
}

double CrackTips::grow(const CrackState<2>& state) {
  // Where to is asked before the first facet makes the displacements old.
  const std::vector<Vector<2>> jumps = state.jumps();
  const auto goes_on = [](const Tip& tip) { return tip.grows && tip.readiness >= ready; };
  std::vector<double> turns;
  for (const Tip& tip : tips_) turns.push_back(goes_on(tip) ? turn_of(tip, jumps) : 0.0);
  double energy = 0.0;
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    Tip& tip = tips_[k];
    tip.spent = goes_on(tip) ? advance(tip, turns[k], state.t) : 0.0;
    tip.released = tip.readiness * tip.readiness * tip.spent;
    energy += tip.spent;
  }
  return energy;
}

std::optional<double> CrackTips::excess_release() const {
  double sum = 0.0;
  for (const Tip& tip : tips_) {
    if (tip.spent == 0.0) continue;
    if (!tip.grows) return std::nullopt;
    const double at_end = tip.readiness * tip.readiness * energy_to_cut(next_facet(tip.at, 0.0)) *
                          cracked_.jumps()[tip.at.facet].area;
    sum += 0.5 * (tip.released + at_end) - tip.spent;
  }
  return sum;
}

double CrackTips::advance(Tip& tip, double turn, double t) {
  CrackFacet<2> facet = next_facet(tip.at, turn);
  const bool joined = joins(facet, tip.at, facet[1]);
  const bool known = tip.at.before != no_facet;
  const double before = known ? cracked_.intensity_at_fixed_volume(tip.at.before) : 1.0;
  if (!cut_ahead(facet)) {
    tip.grows = false;
    return 0.0;
  }
  const FaceJump<2>& jump = cracked_.jumps().back();
  tip.at = {facet[1], jump.tangents[0], static_cast<Index>(cracked_.facets().size()) - 1,
            tip.at.facet};
  tip.took = tip.moved ? t - tip.since : 0.0;
  tip.moved = true;
  tip.since = t;
  tip.asked = tip.asked_opening = 0.0;
  tip.intensity_before = tip.even.intensity;
  tip.even = {};
  tip.shape = {};
  tip.nearest = body_.nearest_point(tip.at.place);
  if (std::abs(turn) < bent) {
    tip.intensity_ratio =
        known ? std::min(1.0, cracked_.intensity_at_fixed_volume(tip.at.before) / before) : 1.0;
  }
  tip.grows = !joined && cracked_.is_intact_along(next_facet(tip.at, 0.0));
  return jump.area * energy_to_cut(facet);
}

bool CrackTips::joins(const CrackFacet<2>& facet, const CrackTip& tip, Vector<2>& end) const {
  double nearest = 0.75 * body_.spacing();
  bool found = false;
  for (std::size_t f = 0; f < cracked_.facets().size(); ++f) {
    if (static_cast<Index>(f) == tip.facet || static_cast<Index>(f) == tip.before) continue;
    for (const Vector<2>& corner : cracked_.facets()[f]) {
      const double away = std::hypot(corner[0] - facet[1][0], corner[1] - facet[1][1]);
      if (corner == tip.place || away > nearest) continue;
      nearest = away;
      end = corner;
      found = true;
    }
  }
  return found;
}

void CrackTips::visit_state(StateVisitor& visitor) {
  const std::vector<Tip> before = tips_;
  visit_each(
      visitor, "tips", tips_,  //
      FieldOfEach("x", [](Tip& tip) -> double& { return tip.at.place[0]; }),
      FieldOfEach("y", [](Tip& tip) -> double& { return tip.at.place[1]; }),
      FieldOfEach("direction_x", [](Tip& tip) -> double& { return tip.at.direction[0]; }),
      FieldOfEach("direction_y", [](Tip& tip) -> double& { return tip.at.direction[1]; }),
      FieldOfEach("facet", [](Tip& tip) -> Index& { return tip.at.facet; }),
      FieldOfEach("facet_before", [](Tip& tip) -> Index& { return tip.at.before; }),
      FieldOfEach("since", [](Tip& tip) -> double& { return tip.since; }),
      FieldOfEach("took", [](Tip& tip) -> double& { return tip.took; }),
      FieldOfEach("moved", [](Tip& tip) -> bool& { return tip.moved; }),
      FieldOfEach("grows", [](Tip& tip) -> bool& { return tip.grows; }),
      FieldOfEach("intensity_ratio", [](Tip& tip) -> double& { return tip.intensity_ratio; }),
      FieldOfEach("asked", [](Tip& tip) -> double& { return tip.asked; }),
      FieldOfEach("asked_opening", [](Tip& tip) -> double& { return tip.asked_opening; }),
      FieldOfEach("intensity_before", [](Tip& tip) -> double& { return tip.intensity_before; }),
      FieldOfEach("even_opening", [](Tip& tip) -> double& { return tip.even.opening; }),
      FieldOfEach("even_sliding", [](Tip& tip) -> double& { return tip.even.modes.sliding; }),
      FieldOfEach("even_opens", [](Tip& tip) -> double& { return tip.even.modes.opens; }),
      FieldOfEach("even_slides", [](Tip& tip) -> double& { return tip.even.modes.slides; }),
      FieldOfEach("even_root", [](Tip& tip) -> double& { return tip.even.modes.root_of_j; }),
      FieldOfEach("even_behind", [](Tip& tip) -> double& { return tip.even.opens; }),
      FieldOfEach("even_known", [](Tip& tip) -> bool& { return tip.even.is_known; }),
      FieldOfEach("even_intensity", [](Tip& tip) -> double& { return tip.even.intensity; }),
      FieldOfEach("scale", [](Tip& tip) -> double& { return tip.scale; }),
      FieldOfEach("shape_scale", [](Tip& tip) -> double& { return tip.shape.scale; }),
      FieldOfEach("shape_facets", [](Tip& tip) -> std::vector<Index>& { return tip.shape.facets; }),
      FieldOfEach("shape_jumps", [](Tip& tip) -> std::vector<double>& { return tip.shape.jumps; }),
      FieldOfEach("shape_modes",
                  [](Tip& tip) -> std::vector<double>& { return tip.shape.intensities; }));
  for (std::size_t k = 0; k < tips_.size(); ++k) {
    Tip& tip = tips_[k];
    const bool is_known = k < before.size() && before[k].at.place == tip.at.place;
    tip.nearest = is_known ? before[k].nearest : body_.nearest_point(tip.at.place);
    tip.readiness = tip.spent = tip.released = 0.0;
  }
}

}  // namespace perifrac
