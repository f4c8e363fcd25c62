#include "modules/crack_fluid/crack_inlets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

CrackInlets::CrackInlets(std::vector<CrackInlet> inlets, const CrackLiquid& liquid,
                         std::vector<CrackWell> wells)
    : inlets_(std::move(inlets)),
      liquid_(liquid),
      wells_(std::move(wells), liquid),
      supply_(inlets_.size()),
      facets_(inlets_.size()),
      share_(inlets_.size()) {}

void CrackInlets::locate(const PointSet& facets, const CrackGraph& graph) {
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    const auto distance = [&](Index f) {
      double square = 0.0;
      for (int a = 0; a < facets.dimension; ++a) {
        const double off = facets.position[a][f] - inlets_[k].at[a];
        square += off * off;
      }
      return std::sqrt(square);
    };
    double nearest = infinity;
    for (Index f = 0; f < graph.facet_count(); ++f) nearest = std::min(nearest, distance(f));
    facets_[k].clear();
    share_[k].clear();
    double area = 0.0;
    for (Index f = 0; f < graph.facet_count(); ++f) {
      const double size = facets.dimension == 2 ? graph.area(f) : std::sqrt(graph.area(f));
      if (distance(f) > nearest + 1e-6 * size) continue;
      facets_[k].push_back(f);
      share_[k].push_back(graph.area(f));
      area += graph.area(f);
    }
    for (double& share : share_[k]) share /= area;
  }
}

FacetInflow CrackInlets::inflow(std::size_t k, std::size_t n, const TimeWindow& step) const {
  const CrackInlet& inlet = inlets_[k];
  FacetInflow inflow{
      .facet = facets_[k][n], .least = 0.0, .most = 0.0, .target = liquid_.vapour_pressure};
  const bool holds = inlet.from_fluid ? supply_[k].stiffness > 0.0 : inlet.holds_pressure;
  if (holds && step.length() > 0.0) {
    const double pressure =
        inlet.from_fluid ? supply_[k].pressure : inlet.amount * inlet.schedule.factor(step.end);
    inflow.least = -infinity;
    inflow.most = infinity;
    inflow.target = std::max(inflow.target, pressure);
    if (inlet.from_fluid) inflow.stiffness = supply_[k].stiffness;
  } else if (!inlet.holds_pressure && !inlet.from_fluid) {
    const double mass = liquid_.density * inlet.amount * share_[k][n] *
                        inlet.schedule.integral(step.begin, step.end);
    inflow.least = mass;
    inflow.most = std::max(mass, 0.0);
  }
  return inflow;
}

std::span<const FacetInflow> CrackInlets::inflows(const TimeWindow& step) {
  inflows_.clear();
  std::set<Index> taken;
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    for (std::size_t n = 0; n < facets_[k].size(); ++n) {
      if (!taken.insert(facets_[k][n]).second) {
        throw NumericalError("crack_pressure", fmt::format("inlet '{}'", inlets_[k].name),
                             step.begin, "a facet that serves another inlet too");
      }
      if (!inlets_[k].from_well) inflows_.push_back(inflow(k, n, step));
    }
  }
  return inflows_;
}

std::span<WellFlow> CrackInlets::well_flows(const TimeWindow& step) {
  std::vector<ClusterFacets> clusters;
  for (std::size_t c = 0; c < wells_.cluster_count(); ++c) {
    const std::size_t k = inlet_of_cluster(c);
    clusters.push_back({facets_[k], share_[k]});
  }
  return wells_.flows(step, clusters);
}

bool CrackInlets::is_of_well(Index facet) const {
  for (std::size_t c = 0; c < wells_.cluster_count(); ++c) {
    if (std::ranges::count(facets_[inlet_of_cluster(c)], facet) > 0) return true;
  }
  return false;
}

}  // namespace perifrac
