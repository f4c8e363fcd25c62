#include "modules/crack_fluid/carter_leak_off.hpp"

#include <cmath>

namespace perifrac {

namespace {

constexpr double never = -1.0;

}  // namespace

void CarterLeakOff::match(const CrackGraph& graph) {
  graph_ = &graph;
  wet_since_.resize(graph.facet_count(), never);
}

Leak CarterLeakOff::leak(Index facet, double, double fill) const {
  const double since = wet_since_[facet] == never ? step_.begin : wet_since_[facet];
  const double roots = std::sqrt(step_.end - since) - std::sqrt(step_.begin - since);
  const double full = density_ * 4.0 * coefficient_ * roots * graph_->length(facet);
  return {.mass = full * fill, .by_fill = full};
}

void CarterLeakOff::accept(std::span<const double> mass) {
  for (std::size_t f = 0; f < mass.size(); ++f) {
    if (wet_since_[f] == never && mass[f] > 0.0) wet_since_[f] = step_.begin;
  }
}

}  // namespace perifrac
