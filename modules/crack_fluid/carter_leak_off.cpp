#include "modules/crack_fluid/carter_leak_off.hpp"

#include <cmath>

namespace perifrac {

namespace {

constexpr double never = -1.0;

}  // namespace

template <int D>
void CarterLeakOff<D>::match(const PointSet& facets, const CrackGraph& graph) {
  sealed_.match(facets);
  graph_ = &graph;
  wet_since_.resize(graph.facet_count(), never);
}

template <int D>
void CarterLeakOff<D>::evaluate(const Eigen::VectorXd&, const Eigen::VectorXd& fill,
                                LeakedFluid& leaked) {
  for (Index f = 0; f < graph_->facet_count(); ++f) {
    const double since = wet_since_[f] == never ? step_.begin : wet_since_[f];
    const double roots = std::sqrt(step_.end - since) - std::sqrt(step_.begin - since);
    leaked.by_fill[f] = density_ * 4.0 * coefficient(f) * roots * graph_->area(f);
    leaked.mass[f] = leaked.by_fill[f] * fill[f];
  }
}

template <int D>
double CarterLeakOff<D>::accept(std::span<const double> mass) {
  for (std::size_t f = 0; f < mass.size(); ++f) {
    if (wet_since_[f] == never && mass[f] > 0.0) wet_since_[f] = step_.begin;
  }
  return 0.0;
}

template class CarterLeakOff<2>;
template class CarterLeakOff<3>;

}  // namespace perifrac
