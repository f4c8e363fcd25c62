#include "modules/crack_fluid/carter_leak_off.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

/// Less of a facet than this is noise, and fluid that it would put there has not come yet.
constexpr double smallest_arrival = 1e-6;

/// Mean of sqrt(t - t_0) over all t_0 between two times before t.
double mean_root(double t, double first, double last) {
  const double p = std::sqrt(t - first), q = std::sqrt(t - last);
  return p + q > 0.0 ? 2.0 / 3.0 * (p * p + p * q + q * q) / (p + q) : 0.0;
}

}  // namespace

template <int D>
void CarterLeakOff<D>::match(const PointSet& facets, const CrackGraph& graph) {
  sealed_.match(facets);
  graph_ = &graph;
  for (std::size_t f = by_facet_.size(); !coefficient_.inside.empty() && f < facets.count; ++f) {
    by_facet_.push_back(coefficient_.at(vector_at<D>(facets.position, f)));
  }
  for (auto* field : {&wet_share_, &wet_since_, &wet_until_}) field->resize(graph.facet_count());
}

template <int D>
void CarterLeakOff<D>::note_arrivals(std::span<const double> fill, double from, double to) {
  for (std::size_t f = 0; f < fill.size(); ++f) {
    const double wet = part(static_cast<Index>(f)) * fill[f];
    if (wet <= wet_share_[f] + smallest_arrival) continue;
    if (wet_share_[f] == 0.0) wet_since_[f] = from;
    wet_until_[f] = to;
    wet_share_[f] = wet;
  }
}

/// What is there and has not come in a step was there at once; where a tip goes on, `part` is of
/// the step's end.
template <int D>
void CarterLeakOff<D>::begin(const TimeWindow& step, std::span<const double> fill) {
  step_ = step;
  std::vector<double> unknown(fill.begin(), fill.end());
  for (std::size_t f = 0; f < unknown.size(); ++f) {
    if (wet_share_[f] > 0.0) unknown[f] = 0.0;
  }
  note_arrivals(unknown, step.begin, step.begin);
}

template <int D>
void CarterLeakOff<D>::evaluate(const Eigen::VectorXd&, const Eigen::VectorXd& fill,
                                LeakedFluid& leaked) {
  const double of_new = mean_root(step_.end, step_.begin, step_.end);
  for (Index f = 0; f < graph_->facet_count(); ++f) {
    const double unit = density_ * 4.0 * coefficient(f) * graph_->area(f);
    const double of_old = wet_share_[f] == 0.0
                              ? 0.0
                              : mean_root(step_.end, wet_since_[f], wet_until_[f]) -
                                    mean_root(step_.begin, wet_since_[f], wet_until_[f]);
    const double wet = part(f) * fill[f], more = std::max(wet - wet_share_[f], 0.0);
    leaked.mass[f] = unit * ((wet - more) * of_old + more * of_new);
    leaked.by_fill[f] = unit * part(f) * (more > 0.0 ? of_new : of_old);
  }
}

template <int D>
double CarterLeakOff<D>::accept(std::span<const double> fill) {
  note_arrivals(fill, step_.begin, step_.end);
  return 0.0;
}

template <int D>
void CarterLeakOff<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("crack_wet_share", wet_share_);
  visitor.visit("crack_wet_since", wet_since_);
  visitor.visit("crack_wet_until", wet_until_);
}

template class CarterLeakOff<2>;
template class CarterLeakOff<3>;

}  // namespace perifrac
