#include "modules/crack_fluid/crack_wells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace perifrac {

namespace {

/// What the whole rate loses beside friction, of the fluid's bulk modulus.
constexpr double laminar_part = 1e-9;

}  // namespace

CrackWells::CrackWells(std::vector<CrackWell> wells, const CrackLiquid& liquid)
    : wells_(std::move(wells)), liquid_(liquid), pressure_(wells_.size(), 0.0) {
  std::size_t clusters = 0;
  for (const CrackWell& well : wells_) clusters += well.resistance.size();
  rate_.assign(clusters, 0.0);
}

/// Newton begins with what went through each cluster, or with equal pressures behind them. A
/// cluster that feeds several facets has its perforations at them by their shares.
std::span<WellFlow> CrackWells::flows(const TimeWindow& step,
                                      std::span<const ClusterFacets> clusters) {
  flows_.clear();
  cluster_of_.clear();
  if (!(step.length() > 0.0)) return flows_;
  std::size_t first = 0;
  for (const CrackWell& well : wells_) {
    const double full = std::abs(well.rate);
    const WellFlow::Law law{.laminar = laminar_part * liquid_.bulk_modulus / full,
                            .least_pressure = liquid_.vapour_pressure,
                            .known_pressure = laminar_part * liquid_.bulk_modulus};
    const double rate = well.rate * well.schedule.integral(step.begin, step.end) / step.length();
    const std::size_t count = well.resistance.size();
    const auto own = std::span(rate_).subspan(first, count);
    const bool flowed = std::ranges::any_of(own, [](double q) { return q != 0.0; });
    std::vector<double> ease(count);
    std::ranges::transform(well.resistance, ease.begin(), [&](double resistance) {
      return 1.0 / std::sqrt(resistance + law.laminar / full);
    });
    const double sum = std::accumulate(ease.begin(), ease.end(), 0.0);
    std::vector<WellFlow::Opening> openings;
    for (std::size_t k = 0; k < count; ++k) {
      const auto& [facets, share] = clusters[first + k];
      const double begin = flowed ? own[k] : rate * ease[k] / sum;
      for (std::size_t n = 0; n < facets.size(); ++n) {
        openings.push_back({.facet = facets[n],
                            .resistance = well.resistance[k],
                            .rate = begin * share[n],
                            .part = share[n]});
        cluster_of_.push_back(first + k);
      }
    }
    flows_.emplace_back(std::move(openings), rate, law);
    first += count;
  }
  return flows_;
}

void CrackWells::accept() {
  if (flows_.empty()) return;
  std::ranges::fill(rate_, 0.0);
  std::size_t opening = 0;
  for (std::size_t k = 0; k < flows_.size(); ++k) {
    pressure_[k] = flows_[k].pressure();
    for (const auto& at : flows_[k].openings()) rate_[cluster_of_[opening++]] += at.rate;
  }
}

void CrackWells::clear() {
  std::ranges::fill(pressure_, 0.0);
  std::ranges::fill(rate_, 0.0);
}

void CrackWells::visit_state(StateVisitor& visitor) {
  if (wells_.empty()) return;
  visitor.visit("well_pressure", pressure_);
  visitor.visit("cluster_rate", rate_);
}

double perforation_resistance(double density, double perforations, double diameter,
                              double discharge_coefficient) {
  const double root = M_PI * perforations * diameter * diameter * discharge_coefficient;
  return 8.0 * density / (root * root);
}

}  // namespace perifrac
