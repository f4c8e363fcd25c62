#include "modules/solid/equilibrium/crack_growth.hpp"

#include <algorithm>

namespace perifrac {

namespace {

/// The window is cut where a tip is this far beyond its criterion: as far as it may be before it
/// (`ready`). Of a front many squares are ready at nearly the same time, and one goes a window.
template <int D>
constexpr double late = D == 2 ? 1.0 - ready : 0.02;
/// Nor is it cut where it is shorter than this part of the time since the last growth.
template <int D>
constexpr double short_enough = D == 2 ? 0.01 : 0.05;
/// A tip that is late in so short a window as so many cuts in a row leave goes on at once: its step
/// is unstable, as a dry tip's may be that has just gone on.
constexpr int most_cuts = 8;

/// The same of a crack that begins: only its load is to be met.
constexpr double late_nucleus = 1e-3;

/// Windows are not cut to less than this part of the time.
constexpr double shortest = 1e-9;

/// Nor is one expected to end before this part of it.
constexpr double shortest_expected = 0.01;

/// A crack begins within this of its criterion.
constexpr double begins = 0.999;

}  // namespace

template <int D>
CrackGrowth<D>::CrackGrowth(const Body<D>& body, CrackedEquilibrium<D>& equilibrium,
                            CrackedWork<D>& work, FractureEnergy<D> fracture_energy,
                            const std::optional<TensileStrength<D>>& tensile_strength)
    : equilibrium_(equilibrium), work_(work), tips_(body, equilibrium.body(), fracture_energy) {
  if constexpr (D == 2) {
    if (equilibrium.body().may_be_partly_cut()) {
      moving_ = std::make_unique<MovingTips>(body, equilibrium_, work_, tips_);
    }
    if (tensile_strength) {
      nucleation_ = std::make_unique<CrackNucleation>(
          body, equilibrium.body(), std::move(fracture_energy), *tensile_strength);
    }
  }
}

template <int D>
void CrackGrowth<D>::start(const std::vector<CrackFacet<D>>& seeds, double t) {
  tips_.start(seeds, t);
  if (moving_) moving_->start();
  last_growth_ = t;
  readiness_before_ = nucleus_before_ = growth_interval_ = readiness_rate_ = 0.0;
}

/// Whose tips move know where they will be; the squares of a front come in no order.
template <int D>
bool CrackGrowth<D>::expects_facets() const {
  return D == 2 && equilibrium_.is_wet() && !tips_move();
}

template <int D>
double CrackGrowth<D>::expected_end(const TimeWindow& window) const {
  if (!expects_facets()) return window.end;
  double wait = 0.0;
  if (readiness_before_ == 0.0) {
    wait = last_growth_ + growth_interval_ - window.begin;
  } else if (readiness_rate_ > 0.0) {
    wait = (1.0 - readiness_before_) / readiness_rate_;
  }
  if (!(wait > 0.0 && wait < 0.95 * window.length())) return window.end;
  return window.begin + std::max(wait, shortest_expected * window.length());
}

template <int D>
void CrackGrowth<D>::begin(const TimeWindow& window) {
  begun_ = window.begin;
  if (moving_) moving_->begin(window);
}

template <int D>
bool CrackGrowth<D>::find_tips() {
  return !moving_ || moving_->find();
}

template <int D>
std::vector<double>& CrackGrowth<D>::parts() {
  if (moving_) return moving_->parts();
  whole_.assign(equilibrium_.body().facets().size(), 1.0);
  return whole_;
}

template <int D>
double CrackGrowth<D>::first_event(const TimeWindow& window) {
  const double most = readiness_ = tips_.find_readiness(equilibrium_.state());
  const double nucleus = nucleus_readiness_ = find_nucleus_readiness();
  const bool can_cut = window.length() > short_enough<D> * (window.end - last_growth_);
  const bool is_late = equilibrium_.is_wet() && most > 1.0 + late<D> && can_cut;
  // A load that jumps is met by no window, however short.
  const bool begins_late = nucleus > 1.0 + late_nucleus && nucleus_before_ < 1.0 - late_nucleus &&
                           window.length() > shortest * window.end;
  const double end = moving_ && can_cut ? moving_->first_crossed() : window.end;
  if (!(is_late || begins_late || end < window.end) || cuts_ == most_cuts) return window.end;
  if (!(is_late || begins_late)) {
    ++cuts_;
    return end;
  }
  // A tip that is late in however short a window is not met by the secant.
  const double longest = ++cuts_ > 5 ? 0.5 : 0.95;
  double share = longest;
  if (is_late) share = std::clamp(due_share(window.length(), most), 0.05, longest);
  tried_ = {window.length(), most};
  if (begins_late) {
    const double secant =
        std::clamp((1.0 - nucleus_before_) / (nucleus - nucleus_before_), 0.05, longest);
    share = is_late ? std::min(share, secant) : secant;
  }
  return std::min(end, window.begin + share * window.length());
}

/// The part of a window after which its readiest tip is due: linear in readiness from its
/// beginning, where that is not known after growth, and of second order where a longer window was
/// tried.
template <int D>
double CrackGrowth<D>::due_share(double length, double most) const {
  const double before = readiness_before_;
  const double linear = (1.0 - before) / (most - before);
  if (cuts_ == 1 || !(tried_.readiness > most)) return linear;
  const double steep =
      (tried_.length / length - 1.0) / (tried_.readiness - most);  // d share/d readiness
  if (before == 0.0) return std::max(1.0 - steep * (most - 1.0), 0.4);
  const double curved = (steep - 1.0 / (most - before)) / (tried_.readiness - before);
  return std::max(linear - curved * (most - 1.0) * (1.0 - before), 0.3 * linear);
}

template <int D>
void CrackGrowth<D>::grow() {
  cuts_ = 0;
  const double lasted = equilibrium_.time() - begun_;
  if (readiness_before_ > 0.0 && readiness_ > readiness_before_ && lasted > 0.0) {
    readiness_rate_ = (readiness_ - readiness_before_) / lasted;
  }
  // Windows that come up to the criterion in small steps pass it as often as they stop short.
  const double due = std::clamp(1.0 - 0.5 * (readiness_ - readiness_before_), ready, 1.0);
  readiness_before_ = readiness_;
  const bool is_wet = equilibrium_.is_wet();
  const std::size_t facets = equilibrium_.body().facets().size();
  if (moving_ && moving_->conclude()) {
    last_growth_ = equilibrium_.time();
    work_.book();
  }
  const bool has_grown = grow_tips(readiness_, due);
  if (nucleation_ && !(has_grown && is_wet)) begin_cracks(has_grown);
  // Beside fluid, readiness after an event is known only at the next window's end.
  const bool is_known = !is_wet || equilibrium_.body().facets().size() == facets;
  nucleus_before_ = is_known ? nucleus_readiness_ : 0.0;
  if (moving_) moving_->note_loads();
}

/// What a cut changes of how pores press on the rock is known whole or not at all.
template <int D>
bool CrackGrowth<D>::tips_move() const {
  return moving_ && equilibrium_.is_wet() && equilibrium_.load().pore_stress().empty();
}

/// True where some tip has come to a facet.
template <int D>
bool CrackGrowth<D>::start_moving() {
  if constexpr (D == 2) return moving_->add(tips_.take_ready(equilibrium_.state()));
  return false;
}

/// Cuts what is ready once the readiest is due, all of it where no fluid answers.
template <int D>
bool CrackGrowth<D>::grow_tips(double most, double due) {
  const bool is_wet = equilibrium_.is_wet();
  bool has_grown = false;
  while (most >= due) {
    due = ready;
    const double before = is_wet ? 0.0 : work_.released_energy();
    const bool moves = tips_move();
    const double spent = moves ? 0.0 : tips_.grow(equilibrium_.state());
    has_grown = has_grown || spent > 0.0 || (moves && start_moving());
    work_.spend(spent);
    if (is_wet && equilibrium_.time() > last_growth_) {
      growth_interval_ = equilibrium_.time() - last_growth_;
    }
    last_growth_ = equilibrium_.time();
    readiness_before_ = 0.0;
    equilibrium_.solve(equilibrium_.time());
    work_.book();
    if (is_wet || spent == 0.0) break;
    most = tips_.find_readiness(equilibrium_.state());
    if constexpr (D == 2) {
      const std::optional<double> excess = tips_.excess_release();
      work_.radiate(excess ? *excess : work_.released_energy() - before - spent);
    }
  }
  return has_grown;
}

template <int D>
double CrackGrowth<D>::find_nucleus_readiness() {
  if (!nucleation_) return 0.0;
  return nucleation_->find_readiness(equilibrium_.effective_stress());
}

/// One after the other where no fluid answers.
template <int D>
void CrackGrowth<D>::begin_cracks(bool has_grown) {
  if (has_grown) nucleus_readiness_ = find_nucleus_readiness();
  while (nucleus_readiness_ >= begins && begin_crack() && !equilibrium_.is_wet()) {
    grow_tips(tips_.find_readiness(equilibrium_.state()), ready);
    nucleus_readiness_ = find_nucleus_readiness();
  }
}

/// A new crack is cut all at once: J says nothing of what that sets free, the balance does.
template <int D>
bool CrackGrowth<D>::begin_crack() {
  if constexpr (D == 2) {
    const double before = work_.released_energy(), t = equilibrium_.time();
    const std::size_t facets = equilibrium_.body().facets().size();
    const double spent = nucleation_->cut();
    if (spent == 0.0) return false;
    tips_.take_ends(equilibrium_.body().facets(), facets, t);
    work_.spend(spent);
    last_growth_ = t;
    readiness_before_ = 0.0;
    equilibrium_.solve(t);
    work_.book();
    if (!equilibrium_.is_wet()) work_.radiate(work_.released_energy() - before - spent);
    return true;
  }
  return false;
}

template <int D>
void CrackGrowth<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("readiness", readiness_before_);
  visitor.visit("last_growth", last_growth_);
  if (expects_facets()) {
    visitor.visit("growth_interval", growth_interval_);
    visitor.visit("readiness_rate", readiness_rate_);
  }
  if (nucleation_) visitor.visit("nucleus_readiness", nucleus_before_);
  tips_.visit_state(visitor);
  if (moving_ && equilibrium_.is_wet()) moving_->visit_state(visitor);
}

template <int D>
void CrackGrowth<D>::on_restored() {
  if (moving_) moving_->on_restored();
}

template class CrackGrowth<2>;
template class CrackGrowth<3>;

}  // namespace perifrac
