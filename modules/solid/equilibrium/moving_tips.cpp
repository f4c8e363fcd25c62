#include "modules/solid/equilibrium/moving_tips.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/eigen_view.hpp"
#include "core/base/small_vector.hpp"
#include "core/state/visit_each.hpp"
#include "modules/solid/fracture/even_loads.hpp"

namespace perifrac {

namespace {

/// It has crossed its facet from here on.
constexpr double crossed = 0.005;

}  // namespace

MovingTips::MovingTips(const Body<2>& body, CrackedEquilibrium<2>& equilibrium,
                       CrackedWork<2>& work, CrackTips& tips)
    : body_(body),
      equilibrium_(equilibrium),
      work_(work),
      tips_(tips),
      energy_release_(equilibrium.body(), body.spacing()) {}

void MovingTips::start() { moving_.clear(); }

/// Under one load the energy release of a crack goes as its length.
double MovingTips::opened(const Tip& tip, double part) const {
  return part + 0.5 * tip.per_spacing * part * (part - 1.0);
}

void MovingTips::hold() {
  std::vector<PartialCut> cuts;
  for (const Tip& tip : moving_) cuts.push_back({tip.facet, opened(tip, tip.search.trial())});
  equilibrium_.set_partial(cuts);
}

CrackTip MovingTips::end_of(const Tip& tip) const {
  const CrackedBody<2>& cracked = equilibrium_.body();
  return {cracked.facets()[tip.facet][1], cracked.jumps()[tip.facet].tangents[0], tip.facet,
          tip.at.facet};
}

bool MovingTips::add(std::span<const std::pair<CrackTip, double>> tips) {
  const std::size_t first = moving_.size();
  if (tips.empty()) return false;
  equilibrium_.set_partial({});
  CrackedBody<2>& cracked = equilibrium_.body();
  std::vector<Tip> found;
  for (const auto& [at, turned] : tips) {
    Tip& tip = found.emplace_back(Tip{.at = at});
    ask_modes(tip, at, 0);
    if (at.before != no_facet) tip.per_spacing = cracked.intensity_at_fixed_volume(at.before);
  }
  for (std::size_t k = 0; k < tips.size(); ++k) {
    try {
      if (!cut_for(tips[k].first, tips[k].second)) continue;
    } catch (...) {  // a cut that parts the body: the others are what they were
      hold();
      throw;
    }
    moving_.back().root_of_j[0] = found[k].root_of_j[0];
    moving_.back().sliding[0] = found[k].sliding[0];
    moving_.back().per_spacing = found[k].per_spacing;
  }
  ask_loads(first);
  hold();
  return moving_.size() > first;
}

bool MovingTips::cut_for(const CrackTip& at, double turn) {
  CrackedBody<2>& cracked = equilibrium_.body();
  CrackFacet<2> facet = tips_.next_facet(at, turn);
  const bool joined = tips_.joins(facet, at, facet[1]);
  if (!tips_.cut_ahead(facet)) return false;
  Tip tip{.at = at,
          .facet = static_cast<Index>(cracked.facets().size()) - 1,
          .nearest = body_.nearest_point(middle<2>(facet))};
  tip.ends = joined || !cracked.is_intact_along(tips_.next_facet(end_of(tip), 0.0));
  moving_.push_back(tip);
  return true;
}

/// As its facet begins (0) or ends (1).
void MovingTips::ask_modes(Tip& tip, const CrackTip& at, std::size_t place) {
  const auto even =
      ask_even_loads(equilibrium_.body(), energy_release_, at, tips_.crack_of(at.facet));
  if (!even) return;
  tip.root_of_j[place] = even->root_of_j;
  tip.sliding[place] = even->sliding;
}

/// Of the tips from `first` on, all facets cut whole.
void MovingTips::ask_loads(std::size_t first) {
  CrackedBody<2>& cracked = equilibrium_.body();
  std::vector<PartialCut> cuts;
  for (const Tip& tip : moving_) cuts.push_back({tip.facet, 1.0});
  const auto volume = [&](std::span<const Index> faces, std::span<const Vector<2>> jumps) {
    double sum = 0.0;
    for (const Index f : faces) sum += cracked.jumps()[f].area * jumps[f][0];
    return sum;
  };
  for (std::size_t k = first; k < moving_.size(); ++k) {
    Tip& tip = moving_[k];
    const std::vector<Index> faces = tips_.crack_of(tip.facet);
    const bool known = tip.at.before != no_facet && tip.per_spacing > 0.0;
    const double ratio =
        known ? cracked.intensity_at_fixed_volume(tip.at.facet) / tip.per_spacing : 1.0;
    tip.per_spacing = (1.0 - std::min(1.0, ratio)) / 1.5;
    ask_modes(tip, end_of(tip), 1);
    if (tip.sliding[1] == 0.0) tip.sliding[1] = tip.sliding[0];
    if (tip.root_of_j[1] == 0.0)
      tip.root_of_j[1] = tip.root_of_j[0] * (1.0 + 0.5 * tip.per_spacing);
    if (tip.root_of_j[0] == 0.0)
      tip.root_of_j[0] = tip.root_of_j[1] / (1.0 + 0.5 * tip.per_spacing);
    const auto whole = cracked.jumps_by(faces, {1.0, 0.0});
    cuts[k].opened = 0.0;
    equilibrium_.set_partial(cuts);
    const auto uncut = cracked.jumps_by(faces, {1.0, 0.0});
    cuts[k].opened = 1.0;
    equilibrium_.set_partial(cuts);
    tip.release = volume(faces, whole) - volume(faces, uncut);
    for (const int behind : {0, 1}) {
      const Index facet = behind == 0 ? tip.at.facet : tip.at.before;
      if (facet == no_facet) continue;
      tip.cut[behind] = whole[facet][0];
      tip.held[behind] = uncut[facet][0];
    }
  }
}

void MovingTips::begin(const TimeWindow& window) {
  const bool again = window.begin == window_.begin;
  window_ = window;
  if (moving_.empty()) return;
  for (Tip& tip : moving_) {
    const double rate = again && tip.expected_rate > 0.0 ? tip.expected_rate : tip.rate;
    const double next = tip.part + rate * window.length();
    // Of a facet that a tip ends with it leaves nothing.
    tip.search.begin(tip.part, tip.ends ? 1.0 : std::min(next, std::max(1.0, tip.part)));
  }
  hold();
}

TipLaw MovingTips::law(const Tip& tip) const {
  CrackedBody<2>& cracked = equilibrium_.body();
  return {cracked.elastic().law(tip.nearest).plane_strain_modulus(),
          tips_.energy_to_cut(cracked.facets()[tip.facet])};
}

/// That of the last facet that is whole.
TipFluid MovingTips::fluid(const Tip& tip) const {
  const CrackState<2> state = equilibrium_.state();
  const auto at = static_cast<std::size_t>(tip.at.facet);
  return {at < state.viscosity.size() ? state.viscosity[at] : 0.0,
          at < state.leak_off.size() ? state.leak_off[at] : 0.0};
}

double MovingTips::speed(const Tip& tip, double part) const {
  return body_.spacing() * std::max(part - tip.part, 1e-12) / window_.length();
}

double MovingTips::within_crack(const Tip& tip, double s) const {
  return perifrac::within_crack(s, tip.per_spacing / body_.spacing());
}

/// By an even load, the tip being where it is tried; 0: not known.
double MovingTips::root_of_j(const Tip& tip) const {
  return tip.root_of_j[0] + tip.search.trial() * (tip.root_of_j[1] - tip.root_of_j[0]);
}

/// By loads that would set `released` free by the whole facet, twice [J/m^2].
double MovingTips::energy_release(const Tip& tip, double released) const {
  const double even = root_of_j(tip);
  if (even > 0.0 && tip.release > 0.0) return even * even * released / tip.release;
  const double slope = 1.0 + tip.per_spacing * (tip.search.trial() - 0.5);
  return 0.5 * slope * released / equilibrium_.body().jumps()[tip.facet].area;
}

/// The opening `behind` (0: the last whole facet, 1: the one before), over what holds the tip.
double MovingTips::by_law(const Tip& tip, int behind) const {
  const Index facet = behind == 0 ? tip.at.facet : tip.at.before;
  const double s = (tip.search.trial() + 0.5 + behind) * body_.spacing();
  const double share = opened(tip, tip.search.trial());
  const double even = (1.0 - share) * tip.held[behind] + share * tip.cut[behind];
  const TipLaw held = law(tip);
  const TipLaw unit{held.plane_strain_modulus, 1.0};
  const double root = root_of_j(tip);
  const double over =
      root > 0.0 ? even / (root * unit.opening(within_crack(tip, s), 0.0, {}, 1.0)) : 1.0;
  CrackTip at = end_of(tip);
  at.place = at.place - (1.0 - tip.search.trial()) * body_.spacing() * at.direction;
  const double open = equilibrium_.faces().opening[facet] / over -
                      tips_.opening_by_layers(at, s, held, std::min(tip.search.trial(), 1.0));
  return open / held.opening(within_crack(tip, s), s, fluid(tip), speed(tip, tip.search.trial()));
}

/// The logarithm of K over what holds the tip.
double MovingTips::excess(const Tip& tip, std::size_t k, const CutLoad& load,
                          std::span<const Vector<2>> jumps) const {
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
  const double opening =
      (1.0 - tip.search.trial()) * by_law(tip, 1) + tip.search.trial() * by_law(tip, 0);
  const double ratio = mode_ratio(tip, 0, energy_release_.jump(tip.at, jumps));
  const double followed = opening > 0.0 ? kink_intensity({opening, opening * ratio}) : 0.0;
  return std::log(std::max({followed, dry, 1e-6}));
}

/// K_II / K_I by the jumps behind the begin (0) or the end (1) of its facet.
double MovingTips::mode_ratio(const Tip& tip, std::size_t place, const TipJump& jump) const {
  if (!(jump.opening > 0.0)) return 0.0;
  const double known = tip.sliding[place];
  const double sliding = known > 0.0 ? jump.sliding / known : modes_of(jump).sliding;
  return sliding / jump.opening;
}

bool MovingTips::find() {
  if (moving_.empty() || !(window_.length() > 0.0)) return true;
  CrackedBody<2>& cracked = equilibrium_.body();
  const auto& faces = equilibrium_.faces();
  const auto loads = cracked.cut_loads(faces.pressure, faces.shear);
  const auto jumps = cracked.jumps_under(faces.pressure, faces.shear);
  bool settled = true;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    Tip& tip = moving_[k];
    if (tip.ends) continue;
    const double beyond = excess(tip, k, loads[k], jumps);
    settled = !tip.search.look_further(beyond, foretold(tip, beyond)) && settled;
  }
  if (!settled) hold();
  return settled;
}

/// What the tip would meet there under fluid of fixed volume: intensity falls as the crack grows.
double MovingTips::foretold(const Tip& tip, double excess) const {
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

double MovingTips::first_crossed() {
  double share = 1.0;
  for (Tip& tip : moving_) {
    tip.expected_rate = 0.0;
    const double trial = tip.search.trial();
    if (trial <= 1.0 + crossed) continue;
    const double end = trial >= TipSearch::farthest ? std::max(trial, tip.search.reach()) : trial;
    tip.expected_rate = (end - tip.part) / window_.length();
    share = std::min(share, std::clamp((1.0 - tip.part) / (end - tip.part), 0.02, 0.98));
  }
  return share < 1.0 ? window_.begin + share * window_.length() : window_.end;
}

/// Between a linear body before and after, what a partial cut sets free is this, exactly.
void MovingTips::book() {
  CrackedBody<2>& cracked = equilibrium_.body();
  const auto& faces = equilibrium_.faces();
  const auto loads = cracked.cut_loads(faces.pressure, faces.shear);
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    Tip& tip = moving_[k];
    const double part = std::min(tip.search.trial(), 1.0);
    const double spent =
        cracked.jumps()[tip.facet].area * (part - tip.part) * law(tip).fracture_energy;
    if (tip.part == 0.0) {
      // Nothing was done on its faces yet: fluid follows the tip, and opens it at what it comes to.
      tip.load.apart +=
          cracked.partial().whole_compliance(k) * (loads[k].traction - tip.load.traction);
      tip.load.traction = loads[k].traction;
    }
    const double released = 0.5 * (opened(tip, tip.search.trial()) - opened(tip, tip.part)) *
                            cracked.partial().release(k, tip.load, loads[k]);
    work_.spend(spent);
    if (tip.search.trial() > tip.part) work_.radiate(released - spent);
    if (window_.length() > 0.0) tip.rate = (tip.search.trial() - tip.part) / window_.length();
    tip.load = loads[k];
    tip.part = part;
    tip.search.put(part);
  }
}

double MovingTips::turn(const Tip& tip, std::span<const Vector<2>> jumps) const {
  const CrackTip end = end_of(tip);
  const TipJump jump = energy_release_.jump(end, jumps);
  return tips_.turn_of(end, {1.0, mode_ratio(tip, 1, jump)}, jump.turn_to, law(tip), 1.0);
}

bool MovingTips::conclude() {
  if (moving_.empty()) return false;
  book();
  const auto done = [](const Tip& tip) { return tip.part >= 1.0 - crossed; };
  if (std::ranges::none_of(moving_, done)) return false;
  std::vector<std::pair<CrackTip, double>> going_on;
  std::vector<double> rates;
  const std::vector<Vector<2>> jumps = equilibrium_.state().jumps();
  for (const Tip& tip : moving_) {
    if (!done(tip) || tip.ends) continue;
    going_on.emplace_back(end_of(tip), turn(tip, jumps));
    rates.push_back(tip.rate);
  }
  std::erase_if(moving_, done);
  hold();
  const std::size_t first = moving_.size();
  add(going_on);
  if (moving_.size() == first + rates.size()) {
    for (std::size_t k = 0; k < rates.size(); ++k) moving_[first + k].rate = rates[k];
  }
  equilibrium_.solve(equilibrium_.time());
  return true;
}

void MovingTips::note_loads() {
  if (moving_.empty()) return;
  const auto& faces = equilibrium_.faces();
  const auto loads = equilibrium_.body().cut_loads(faces.pressure, faces.shear);
  for (std::size_t k = 0; k < moving_.size(); ++k) moving_[k].load = loads[k];
}

std::vector<double>& MovingTips::parts() {
  parts_.assign(equilibrium_.body().facets().size(), 1.0);
  for (const Tip& tip : moving_) parts_[tip.facet] = std::min(1.0, tip.search.trial());
  return parts_;
}

void MovingTips::visit_state(StateVisitor& visitor) {
  const std::vector<Tip> before = moving_;
  visit_each(visitor, "moving_tips", moving_,  //
             FieldOfEach("x", [](Tip& tip) -> double& { return tip.at.place[0]; }),
             FieldOfEach("y", [](Tip& tip) -> double& { return tip.at.place[1]; }),
             FieldOfEach("direction_x", [](Tip& tip) -> double& { return tip.at.direction[0]; }),
             FieldOfEach("direction_y", [](Tip& tip) -> double& { return tip.at.direction[1]; }),
             FieldOfEach("facet_behind", [](Tip& tip) -> Index& { return tip.at.facet; }),
             FieldOfEach("facet_before", [](Tip& tip) -> Index& { return tip.at.before; }),
             FieldOfEach("facet", [](Tip& tip) -> Index& { return tip.facet; }),
             FieldOfEach("ends", [](Tip& tip) -> bool& { return tip.ends; }),
             FieldOfEach("nearest", [](Tip& tip) -> Index& { return tip.nearest; }),
             FieldOfEach("part", [](Tip& tip) -> double& { return tip.part; }),
             FieldOfEach("per_spacing", [](Tip& tip) -> double& { return tip.per_spacing; }),
             FieldOfEach("rate", [](Tip& tip) -> double& { return tip.rate; }),
             FieldOfEach("intensity_begin", [](Tip& tip) -> double& { return tip.root_of_j[0]; }),
             FieldOfEach("intensity_end", [](Tip& tip) -> double& { return tip.root_of_j[1]; }),
             FieldOfEach("release", [](Tip& tip) -> double& { return tip.release; }),
             FieldOfEach("sliding_begin", [](Tip& tip) -> double& { return tip.sliding[0]; }),
             FieldOfEach("sliding_end", [](Tip& tip) -> double& { return tip.sliding[1]; }),
             FieldOfEach("held", [](Tip& tip) -> double& { return tip.held[0]; }),
             FieldOfEach("held_before", [](Tip& tip) -> double& { return tip.held[1]; }),
             FieldOfEach("cut", [](Tip& tip) -> double& { return tip.cut[0]; }),
             FieldOfEach("cut_before", [](Tip& tip) -> double& { return tip.cut[1]; }));
  visit_loads(visitor);
  // What the passes of a window look for outlasts their going back.
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    if (k < before.size() && before[k].facet == moving_[k].facet) continue;
    moving_[k].search.put(moving_[k].part);
  }
}

/// One after the other: how many numbers, and these.
void MovingTips::visit_loads(StateVisitor& visitor) {
  std::vector<double> all;
  for (const Tip& tip : moving_) {
    all.push_back(static_cast<double>(tip.load.borne.size()));
    all.insert(all.end(), tip.load.borne.begin(), tip.load.borne.end());
    all.insert(all.end(), tip.load.apart.begin(), tip.load.apart.end());
    all.insert(all.end(), tip.load.traction.begin(), tip.load.traction.end());
  }
  visitor.visit("tip_loads", all);
  Eigen::Index next = 0;
  const Eigen::VectorXd values = view(all);
  for (Tip& tip : moving_) {
    const auto count = static_cast<Eigen::Index>(values[next++]);
    tip.load.borne = values.segment(next, count);
    tip.load.apart = values.segment(next + count, 2);
    tip.load.traction = values.segment(next + count + 2, 2);
    next += count + 4;
  }
}

void MovingTips::on_restored() { hold(); }

}  // namespace perifrac
