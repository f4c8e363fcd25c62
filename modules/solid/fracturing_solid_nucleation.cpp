// How cracks begin by themselves in the solid.

#include "modules/solid/fracturing_solid.hpp"

namespace perifrac {

namespace {

/// A crack begins within this of its criterion.
constexpr double begins = 0.999;

}  // namespace

template <int D>
double FracturingSolid<D>::elastic_energy_now() {
  if (!is_steady()) derive();
  return elastic_energy_;
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
  nucleus_before_ = nucleus_readiness_;
}

/// A new crack is cut all at once: J says nothing of what that sets free, the balance does.
template <int D>
bool FracturingSolid<D>::begin_crack() {
  if constexpr (D == 2) {
    const auto released = [this] {
      double sum = external_work_ - elastic_energy_now();
      for (std::size_t i = 0; i < pore_stress_.size(); ++i) {
        sum += pore_stress_[i] * dilatation_[i] * body_->points().volume[i];
      }
      return sum;
    };
    const double before = released();
    const std::size_t facets = cracked_.facets().size();
    const double spent = nucleation_->cut();
    if (spent == 0.0) return false;
    tips_.take_ends(cracked_.facets(), facets, window_end_);
    spent_energy_ += spent;
    last_growth_ = window_end_;
    readiness_before_ = 0.0;
    solve_faces();
    book_work();
    if (!wet()) radiated_energy_ += released() - before - spent;
    return true;
  }
  return false;
}

template double FracturingSolid<2>::elastic_energy_now();
template double FracturingSolid<3>::elastic_energy_now();
template double FracturingSolid<2>::find_nucleus_readiness();
template double FracturingSolid<3>::find_nucleus_readiness();
template void FracturingSolid<2>::begin_cracks(bool);
template void FracturingSolid<3>::begin_cracks(bool);
template bool FracturingSolid<2>::begin_crack();
template bool FracturingSolid<3>::begin_crack();

}  // namespace perifrac
