// What happens to the solid's cracks at the end of a window, and when that is.

#include <algorithm>

#include "core/base/final_error.hpp"
#include "modules/solid/fracture/loose_piece.hpp"
#include "modules/solid/fracturing_solid.hpp"

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

/// A crack begins within this of its criterion.
constexpr double begins = 0.999;

}  // namespace

/// Where the window is to end [s]: at its end, or at the first event where that is far before.
template <int D>
double FracturingSolid<D>::first_event(const TimeWindow& window) {
  const double most = readiness_ = tips_.find_readiness(crack_state());
  const double nucleus = nucleus_readiness_ = find_nucleus_readiness();
  const bool can_cut = window.length() > short_enough<D> * (window.end - last_growth_);
  const bool is_late = wet() && most > 1.0 + late<D> && can_cut;
  // A load that jumps is met by no window, however short.
  const bool begins_late = nucleus > 1.0 + late_nucleus && nucleus_before_ < 1.0 - late_nucleus &&
                           window.length() > shortest * window.end;
  if (!(is_late || begins_late) || cuts_ == most_cuts) return window.end;
  // A tip that is late in however short a window is not met by the secant.
  const double longest = ++cuts_ > 5 ? 0.5 : 0.95;
  double share = longest;
  if (is_late) {
    share = std::clamp((1.0 - readiness_before_) / (most - readiness_before_), 0.05, longest);
  }
  if (begins_late) {
    const double secant =
        std::clamp((1.0 - nucleus_before_) / (nucleus - nucleus_before_), 0.05, longest);
    share = is_late ? std::min(share, secant) : secant;
  }
  return window.begin + share * window.length();
}

template <int D>
double FracturingSolid<D>::conclude(const TimeWindow& window) {
  TimeWindow tried = window;
  for (double end = first_event(tried); end < tried.end; end = first_event(tried)) {
    if (!is_alone()) return end;
    tried.end = window_end_ = end;
    solve_faces();
  }
  cuts_ = 0;
  book_work();
  readiness_before_ = readiness_;
  const std::size_t facets = cracked_.facets().size();
  try {
    const bool has_grown = grow(readiness_);
    // With fluid one event does a window.
    if (nucleation_ && !(has_grown && wet())) begin_cracks(has_grown);
  } catch (const PieceCutFree& piece) {
    solve_faces();  // of what was cut before
    throw FinalError("displacement", piece.what(), tried.end,
                     "cracks cut a piece free that nothing holds, so that there is no balance of "
                     "forces; end the run before, or hold the piece by a face or solid.pins;");
  } catch (const NotPositiveDefinite& error) {
    solve_faces();
    throw FinalError("displacement", place_of(error.row()), tried.end,
                     "cracks leave a piece too thin to bear anything; end the run before;");
  }
  // Beside fluid, readiness after an event is known only at the next window's end.
  const bool is_known = !wet() || cracked_.facets().size() == facets;
  nucleus_before_ = is_known ? nucleus_readiness_ : 0.0;
  return tried.end;
}

/// Cuts what is ready, all of it where no fluid answers.
template <int D>
bool FracturingSolid<D>::grow(double most) {
  bool has_grown = false;
  while (most >= ready) {
    const double before = wet() ? 0.0 : released_energy();
    const double spent = tips_.grow(crack_state());
    has_grown = has_grown || spent > 0.0;
    spent_energy_ += spent;
    last_growth_ = window_end_;
    readiness_before_ = 0.0;
    solve_faces();
    book_work();
    if (wet() || spent == 0.0) break;
    most = tips_.find_readiness(crack_state());
    if constexpr (D == 2) {
      const std::optional<double> excess = tips_.excess_release();
      radiated_energy_ += excess ? *excess : released_energy() - before - spent;
    }
  }
  return has_grown;
}

template <int D>
double FracturingSolid<D>::elastic_energy_now() {
  if (!is_steady()) derive();
  return elastic_energy_;
}

/// What loads have done beyond what the rock holds: it grows by what growth sets free [J/m].
template <int D>
double FracturingSolid<D>::released_energy() {
  double sum = external_work_ - elastic_energy_now();
  if constexpr (D == 2) {
    if (friction_) sum -= friction_->dissipation();
  }
  for (std::size_t i = 0; i < pore_stress_.size(); ++i) {
    sum += pore_stress_[i] * dilatation_[i] * body_->points().volume[i];
  }
  return sum;
}

template <int D>
double FracturingSolid<D>::find_nucleus_readiness() {
  if (!nucleation_) return 0.0;
  find_effective_stress();
  return nucleation_->find_readiness(effective_stress_);
}

/// One after the other where no fluid answers.
template <int D>
void FracturingSolid<D>::begin_cracks(bool has_grown) {
  if (has_grown) nucleus_readiness_ = find_nucleus_readiness();
  while (nucleus_readiness_ >= begins && begin_crack() && !wet()) {
    grow(tips_.find_readiness(crack_state()));
    nucleus_readiness_ = find_nucleus_readiness();
  }
}

/// A new crack is cut all at once: J says nothing of what that sets free, the balance does.
template <int D>
bool FracturingSolid<D>::begin_crack() {
  if constexpr (D == 2) {
    const double before = released_energy();
    const std::size_t facets = cracked_.facets().size();
    const double spent = nucleation_->cut();
    if (spent == 0.0) return false;
    tips_.take_ends(cracked_.facets(), facets, window_end_);
    spent_energy_ += spent;
    last_growth_ = window_end_;
    readiness_before_ = 0.0;
    solve_faces();
    book_work();
    if (!wet()) radiated_energy_ += released_energy() - before - spent;
    return true;
  }
  return false;
}

template class FracturingSolid<2>;
template class FracturingSolid<3>;

}  // namespace perifrac
