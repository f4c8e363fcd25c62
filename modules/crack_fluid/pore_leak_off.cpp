#include "modules/crack_fluid/pore_leak_off.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/bonds/shape_tensor.hpp"

namespace perifrac {

namespace {

/// omega V_j of the bond from i to j.
template <int D>
double weight_of(const Family<D>& family, Index i, Index j) {
  const std::span<const Index> steps = family.steps[i];
  const auto place = std::ranges::lower_bound(steps, j - i);
  return family.weight(i, static_cast<Index>(place - steps.begin()));
}

}  // namespace

template <int D>
PoreLeakOff<D>::PoreLeakOff(std::shared_ptr<const Body<D>> body, double density,
                            double vapour_pressure, SealedWalls<D> sealed, const Vector<D>& gravity)
    : body_(std::move(body)),
      family_(body_->family(0)),
      density_(density),
      vapour_pressure_(vapour_pressure),
      sealed_(std::move(sealed)),
      weight_(*body_, gravity, density),
      received_(body_->points().size()) {
  // Where nobody writes them, the pores are empty and closed.
  for (auto* input : {&pressure_.value, &pressure_.rate, &pressure_.slope, &mobility_}) {
    input->resize(body_->points().size());
  }
}

template <int D>
PortView PoreLeakOff<D>::pore_pressure() {
  return {&body_->point_set(), pressure_.value, pressure_.rate, pressure_.slope};
}

template <int D>
PortView PoreLeakOff<D>::pore_mobility() {
  return {&body_->point_set(), mobility_};
}

template <int D>
void PoreLeakOff<D>::match(const PointSet& facets, const CrackGraph&) {
  const BondState<D>& bonds = body_->bond_state();
  if (version_ == bonds.version()) return;
  version_ = bonds.version();
  sealed_.match(facets);
  find_contacts(bonds, facets);
}

template <int D>
void PoreLeakOff<D>::find_contacts(const BondState<D>& bonds, const PointSet& facets) {
  std::map<std::pair<Index, Index>, double> factors;  // by facet and point
  for (const auto& [i, j, facet] : bonds.broken()) {
    if (facet == no_facet || sealed_.contain(facet)) continue;
    const double factor = 4.0 * D * weight_of(*family_, i, j) * body_->points().volume[i] /
                          (weighted_volume(*family_, i) + weighted_volume(*family_, j));
    for (const Index point : {i, j}) factors[{facet, point}] += factor;
  }
  touched_.clear();
  for (const auto& [key, factor] : factors) touched_.push_back(key.second);
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  contacts_.clear();
  for (const auto& [key, factor] : factors) {
    const auto& [facet, point] = key;
    const auto place = std::ranges::lower_bound(touched_, point) - touched_.begin();
    const double lower =
        weight_.at(vector_at<D>(facets.position, facet)) - weight_.at(body_->points().at(point));
    contacts_.push_back({facet, static_cast<Index>(place), factor, lower});
  }
  std::ranges::stable_sort(contacts_, {}, &Contact::touched);
  for (auto* field : {&base_, &base_before_, &sum_, &mean_}) field->resize(touched_.size());
  for (auto* field : {&conductance_, &flux_}) field->resize(contacts_.size());
}

template <int D>
void PoreLeakOff<D>::begin_window(const TimeWindow& window) {
  window_ = window;
  std::ranges::fill(received_, 0.0);
}

template <int D>
void PoreLeakOff<D>::begin(const TimeWindow& step, std::span<const double>) {
  step_ = step;
  for (std::size_t n = 0; n < touched_.size(); ++n) {
    const Index i = touched_[n];
    const double answer = pressure_.value[i] + pressure_.slope[i] * received_[i];
    base_[n] = answer + pressure_.rate[i] * (step.end - window_.end);
    base_before_[n] = answer + pressure_.rate[i] * (step.begin - window_.end);
  }
}

template <int D>
void PoreLeakOff<D>::evaluate(const Eigen::VectorXd& pressure, const Eigen::VectorXd& fill,
                              LeakedFluid& leaked) {
  const double length = step_.length();
  std::ranges::fill(sum_, 0.0);
  std::ranges::fill(mean_, 0.0);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const auto& [f, n, factor, lower] = contacts_[k];
    conductance_[k] = length * density_ * mobility_[touched_[n]] * factor * part(f);
    // Pores under less than any facet take from a facet what there is.
    if (base_[n] < vapour_pressure_) conductance_[k] *= fill[f];
    sum_[n] += conductance_[k];
    mean_[n] += conductance_[k] * (pressure[f] + lower);
  }
  for (std::size_t n = 0; n < touched_.size(); ++n) {
    const double slope = pressure_.slope[touched_[n]];
    mean_[n] = (base_[n] + slope * mean_[n]) / (1.0 + slope * sum_[n]);
  }
  leaked.mass.setZero();
  leaked.by_fill.setZero();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const auto& [f, n, factor, lower] = contacts_[k];
    flux_[k] = conductance_[k] * (pressure[f] + lower - mean_[n]);
    leaked.mass[f] += flux_[k];
    if (base_[n] < vapour_pressure_ && fill[f] > 0.0) leaked.by_fill[f] += flux_[k] / fill[f];
    leaked.by_pressure.emplace_back(f, f, conductance_[k]);
  }
  differentiate(leaked);
}

/// Facets that touch the same point feel each other through its pressure.
template <int D>
void PoreLeakOff<D>::differentiate(LeakedFluid& leaked) const {
  std::size_t first = 0;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const Index n = contacts_[k].touched;
    if (contacts_[first].touched != n) first = k;
    const double slope = pressure_.slope[touched_[n]];
    const double answer = slope / (1.0 + slope * sum_[n]);
    for (std::size_t l = first; l < contacts_.size() && contacts_[l].touched == n; ++l) {
      leaked.by_pressure.emplace_back(contacts_[k].facet, contacts_[l].facet,
                                      -conductance_[k] * answer * conductance_[l]);
    }
  }
}

template <int D>
double PoreLeakOff<D>::accept(std::span<const double>) {
  double energy = 0.0;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const Index n = contacts_[k].touched;
    received_[touched_[n]] += flux_[k];
    energy += flux_[k] * 0.5 * (base_before_[n] + mean_[n]) / density_;
  }
  return energy;
}

template class PoreLeakOff<2>;
template class PoreLeakOff<3>;

}  // namespace perifrac
