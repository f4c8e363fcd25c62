#include "modules/solid/equilibrium/moving_tips.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/small_vector.hpp"
#include "modules/solid/equilibrium/tip_criterion.hpp"
#include "modules/solid/fracture/even_loads.hpp"

namespace perifrac {

namespace {

/// It has crossed its facet from here on.
constexpr double crossed = 0.005;

std::vector<Vector<2>> jumps_by_even(CrackedBody<2>& cracked, std::span<const Index> faces,
                                     const Vector<2>& traction) {
  std::vector<Vector<2>> tractions(cracked.facets().size(), Vector<2>{});
  for (const Index f : faces) tractions[f] = traction;
  return cracked.jumps_by(tractions);
}

double volume_by_pressure(CrackedBody<2>& cracked, std::span<const Index> faces) {
  const std::vector<Vector<2>> jumps = jumps_by_even(cracked, faces, {1.0, 0.0});
  double sum = 0.0;
  for (const Index f : faces) sum += cracked.jumps()[f].area * jumps[f][0];
  return sum;
}

}  // namespace

MovingTips::MovingTips(const Body<2>& body, CrackedEquilibrium<2>& equilibrium,
                       CrackedWork<2>& work, CrackTips& tips)
    : body_(body),
      equilibrium_(equilibrium),
      work_(work),
      tips_(tips),
      energy_release_(equilibrium.body(), body.spacing(), body.holes()) {}

void MovingTips::start() { moving_.clear(); }

void MovingTips::hold() {
  std::vector<PartialCut> cuts;
  for (const MovingTip& tip : moving_) cuts.push_back({tip.facet, tip.opened(tip.search.trial())});
  equilibrium_.set_partial(cuts);
}

bool MovingTips::add(std::span<const std::pair<CrackTip, double>> tips) {
  std::vector<GoingOn> going_on;
  for (const auto& [at, turn] : tips) going_on.push_back({.at = at, .turn = turn, .even = {}});
  return add(std::move(going_on));
}

bool MovingTips::add(std::vector<GoingOn> tips) {
  const std::size_t first = moving_.size();
  if (tips.empty()) return false;
  equilibrium_.set_partial({});
  CrackedBody<2>& cracked = equilibrium_.body();
  for (GoingOn& tip : tips) {
    if (!tip.even) tip.even = even_at(tip.at);
    const Index before = tip.at.before;
    if (before != no_facet) tip.per_spacing = cracked.intensity_at_fixed_volume(before);
  }
  for (const GoingOn& tip : tips) {
    try {
      if (!cut_for(tip.at, tip.turn)) continue;
    } catch (...) {  // a cut that parts the body: the others are what they were
      hold();
      throw;
    }
    moving_.back().even[0] = *tip.even;
    moving_.back().per_spacing = tip.per_spacing;
    moving_.back().scale = tip.scale;
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
  MovingTip tip{.at = at,
                .facet = static_cast<Index>(cracked.facets().size()) - 1,
                .nearest = body_.nearest_point(middle<2>(facet))};
  tip.ends =
      joined || !cracked.is_intact_along(tips_.next_facet(tip.end(equilibrium_.body()), 0.0));
  moving_.push_back(tip);
  return true;
}

EvenTip MovingTips::even_at(const CrackTip& at) const {
  const auto even =
      ask_even_loads(equilibrium_.body(), energy_release_, at, tips_.crack_of(at.facet));
  return even ? EvenTip{even->root_of_j, even->modes, even->slid} : EvenTip{};
}

/// Of the tips from `first` on: as their facets begin with the others as open as they are now, as
/// they end with all whole.
void MovingTips::ask_loads(std::size_t first) {
  std::vector<PartialCut> now, whole;
  for (const MovingTip& tip : moving_) {
    now.push_back({tip.facet, tip.opened(tip.part)});
    whole.push_back({tip.facet, 1.0});
  }
  for (std::size_t k = first; k < moving_.size(); ++k) {
    MovingTip& tip = moving_[k];
    const std::vector<Index> faces = tips_.crack_of(tip.facet);
    equilibrium_.set_partial(whole);
    ask_end(tip, faces);
    const double volume = volume_by_pressure(equilibrium_.body(), faces);
    whole[k].opened = 0.0;
    equilibrium_.set_partial(whole);
    tip.release = volume - volume_by_pressure(equilibrium_.body(), faces);
    whole[k].opened = 1.0;
    equilibrium_.set_partial(now);
    see_even(tip, faces, tip.held, tip.sheared_held);
    if (turns_sharply(tip)) ask_shapes(tip, faces);
  }
}

/// As its facet ends.
void MovingTips::ask_end(MovingTip& tip, std::span<const Index> faces) {
  CrackedBody<2>& cracked = equilibrium_.body();
  const bool known = tip.at.before != no_facet && tip.per_spacing > 0.0;
  const double ratio =
      known ? cracked.intensity_at_fixed_volume(tip.at.facet) / tip.per_spacing : 1.0;
  tip.per_spacing = (1.0 - std::min(1.0, ratio)) / 1.5;
  tip.even[1] = even_at(tip.end(cracked));
  tip.facets = std::ssize(cracked.facets());
  see_even(tip, faces, tip.cut, tip.sheared_cut);
  if (turns_sharply(tip)) tip.shapes[1] = shape_of(tip, tip.end(cracked), faces);
}

/// Openings behind it per pressure and per shear on the crack's faces.
void MovingTips::see_even(const MovingTip& tip, std::span<const Index> faces,
                          std::array<double, 2>& pressed, std::array<double, 2>& sheared) const {
  CrackedBody<2>& cracked = equilibrium_.body();
  const auto by_pressure = jumps_by_even(cracked, faces, {1.0, 0.0});
  const auto by_shear = jumps_by_even(cracked, faces, {0.0, 1.0});
  for (const int behind : {0, 1}) {
    const Index facet = behind == 0 ? tip.at.facet : tip.at.before;
    if (facet == no_facet) continue;
    pressed[behind] = by_pressure[facet][0];
    sheared[behind] = by_shear[facet][0];
  }
}

/// As its facet begins, of a crack without the facets that tips are in; both scaled by J.
void MovingTips::ask_shapes(MovingTip& tip, std::span<const Index> faces) {
  std::vector<Index> before(faces.begin(), faces.end());
  std::erase_if(before, [&](Index f) {
    return std::ranges::any_of(moving_, [&](const MovingTip& other) { return other.facet == f; });
  });
  tip.shapes[0] = shape_of(tip, tip.at, before);
  scale_shapes(tip);
}

/// A turn lies so near behind it, or before its facet, that openings obey no law of a straight
/// crack.
bool MovingTips::turns_sharply(const MovingTip& tip) const {
  const Vector<2>& ahead = equilibrium_.body().jumps()[tip.facet].tangents[0];
  return std::abs(cross(tip.at.direction, ahead)) > std::sin(bent) ||
         !(std::min(tip.even[0].root_of_j, tip.even[1].root_of_j) > 0.0);
}

/// Of a crack that ends there, by the jumps of the facets behind the tip's own.
CrackShape MovingTips::shape_of(const MovingTip& tip, const CrackTip& at,
                                std::span<const Index> crack) const {
  CrackedBody<2>& cracked = equilibrium_.body();
  const std::vector<Index> loaded = tips_.crack_of(tip.facet);
  std::vector<Index> behind = loaded;
  std::erase(behind, tip.facet);
  return crack_shape(cracked, at, crack, loaded, facets_near(cracked, behind, tip.at.place),
                     cracked.elastic().law(tip.nearest).plane_strain_modulus());
}

void MovingTips::scale_shapes(MovingTip& tip) const {
  const double modulus = equilibrium_.body().elastic().law(tip.nearest).plane_strain_modulus();
  auto& [begins, ends] = tip.shapes;
  const double begin_known = tip.even[0].root_of_j, end_known = tip.even[1].root_of_j;
  if (tip.scale > 0.0) begins.scale = tip.scale;
  if (begin_known > 0.0) begins.scale_to(begin_known * std::sqrt(modulus));
  ends.scale = begins.scale;
  if (end_known > 0.0) ends.scale_to(end_known * std::sqrt(modulus));
  tip.scale = ends.scale;
  if (begin_known > 0.0) begins.intensities.clear();
}

void MovingTips::begin(const TimeWindow& window) {
  const bool again = window.begin == window_.begin;
  window_ = window;
  if (moving_.empty()) return;
  for (MovingTip& tip : moving_) {
    const double rate = again && tip.expected_rate > 0.0 ? tip.expected_rate : tip.rate;
    const double next = tip.part + rate * window.length();
    // Of a facet that a tip ends with it leaves nothing.
    tip.search.begin(tip.part, tip.ends ? 1.0 : std::min(next, std::max(1.0, tip.part)));
  }
  hold();
}

bool MovingTips::find() {
  if (moving_.empty() || !(window_.length() > 0.0)) return true;
  CrackedBody<2>& cracked = equilibrium_.body();
  const auto& faces = equilibrium_.faces();
  const auto loads = cracked.cut_loads(faces.pressure, faces.shear);
  const auto jumps = cracked.jumps_under(faces.pressure, faces.shear);
  const TipCriterion criterion(body_, equilibrium_, tips_, energy_release_, jumps,
                               window_.length());
  bool settled = true;
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    MovingTip& tip = moving_[k];
    if (tip.ends) continue;
    const double excess = criterion.excess(tip, k, loads[k]);
    settled = !tip.search.look_further(excess, criterion.foretold(tip, excess)) && settled;
  }
  if (!settled) hold();
  return settled;
}

double MovingTips::first_crossed() {
  double share = 1.0;
  for (MovingTip& tip : moving_) {
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
    MovingTip& tip = moving_[k];
    const double part = std::min(tip.search.trial(), 1.0);
    const double spent = cracked.jumps()[tip.facet].area * (part - tip.part) *
                         tips_.energy_to_cut(cracked.facets()[tip.facet]);
    if (tip.part == 0.0) {
      // Nothing was done on its faces yet: fluid follows the tip, and opens it at what it comes to.
      tip.load.apart +=
          cracked.partial().whole_compliance(k) * (loads[k].traction - tip.load.traction);
      tip.load.traction = loads[k].traction;
    }
    const double released = 0.5 * (tip.opened(tip.search.trial()) - tip.opened(tip.part)) *
                            cracked.partial().release(k, tip.load, loads[k]);
    work_.spend(spent);
    if (tip.search.trial() > tip.part) work_.radiate(released - spent);
    if (window_.length() > 0.0) tip.rate = (tip.search.trial() - tip.part) / window_.length();
    tip.load = loads[k];
    tip.part = part;
    tip.search.put(part);
  }
}

double MovingTips::turn(const MovingTip& tip, std::span<const Vector<2>> jumps) const {
  const CrackedBody<2>& cracked = equilibrium_.body();
  const CrackTip end = tip.end(cracked);
  const TipLaw law = tips_.law(cracked.facets()[tip.facet], tip.nearest);
  const CrackShape& shape = tip.shapes[1];
  if (!shape.is_known()) {
    const TipJump jump = energy_release_.jump(end, jumps);
    const auto& [begins, ends] = tip.even;
    const ModeAnswer& modes = ends.modes.sliding == 0.0 ? begins.modes : ends.modes;
    return tips_.turn_of(end, {1.0, modes.ratio(jump)}, jump.turn_to, law, 1.0);
  }
  const TipModes modes =
      shape.modes(stress_of(shape, shape, 1.0, jumps, cracked.stress_at_rest(end.place),
                            equilibrium_.faces().pressure[tip.at.facet]));
  return tips_.turn_of(end, {1.0, ratio_of(modes)}, 0.0, law, 1.0);
}

bool MovingTips::conclude() {
  if (moving_.empty()) return false;
  book();
  const auto done = [](const MovingTip& tip) { return tip.part >= 1.0 - crossed; };
  if (std::ranges::none_of(moving_, done)) return false;
  std::vector<GoingOn> going_on;
  std::vector<double> rates;
  const std::vector<Vector<2>> jumps = equilibrium_.state().jumps();
  const std::int64_t facets = std::ssize(equilibrium_.body().facets());
  for (const MovingTip& tip : moving_) {
    if (!done(tip) || tip.ends) continue;
    going_on.push_back({.at = tip.end(equilibrium_.body()),
                        .turn = turn(tip, jumps),
                        .scale = tip.scale,
                        .even = {}});
    if (tip.facets == facets) going_on.back().even = tip.even[1];
    rates.push_back(tip.rate);
  }
  std::erase_if(moving_, done);
  hold();
  const std::size_t first = moving_.size();
  add(std::move(going_on));
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
  for (const MovingTip& tip : moving_) parts_[tip.facet] = std::min(1.0, tip.search.trial());
  return parts_;
}

void MovingTips::visit_state(StateVisitor& visitor) { visit_moving_tips(visitor, moving_); }

void MovingTips::on_restored() { hold(); }

}  // namespace perifrac
