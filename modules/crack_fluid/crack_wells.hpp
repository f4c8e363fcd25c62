#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/state/state_visitor.hpp"
#include "core/time/schedule.hpp"
#include "modules/crack_fluid/crack_liquid.hpp"
#include "modules/crack_fluid/crack_step.hpp"

namespace perifrac {

/// A well: one rate for several clusters of perforations, which are at one pressure. It stores
/// nothing.
struct CrackWell {
  std::string name;
  double rate;  ///< volume per time at zero pressure [m^3/s], in 2D per metre, times the schedule
  Schedule schedule;
  /// By cluster, R of what it loses, R q |q| [Pa s^2/m^6], in 2D [Pa s^2/m^4].
  std::vector<double> resistance;
};

/// Where a cluster feeds a crack: facets, and the share of each.
struct ClusterFacets {
  std::span<const Index> facets;
  std::span<const double> share;
};

/// The wells of a scene, and what goes through each cluster. Clusters are numbered from well to
/// well.
class CrackWells {
 public:
  CrackWells(std::vector<CrackWell> wells, const CrackLiquid& liquid);

  const std::vector<CrackWell>& all() const { return wells_; }
  std::size_t cluster_count() const { return rate_.size(); }

  /// What the wells bring over a step; nothing in one of no length.
  std::span<WellFlow> flows(const TimeWindow& step, std::span<const ClusterFacets> clusters);
  /// The step stands as it was solved.
  void accept();

  // At the end of the last step of some length.
  double pressure(std::size_t well) const { return pressure_[well]; }  ///< [Pa]
  double rate(std::size_t cluster) const { return rate_[cluster]; }    ///< [m^3/s], 2D [m^2/s]
  void clear();
  void visit_state(StateVisitor& visitor);

 private:
  std::vector<CrackWell> wells_;
  CrackLiquid liquid_;
  std::vector<WellFlow> flows_;          ///< of the step at hand
  std::vector<std::size_t> cluster_of_;  ///< likewise, by opening of one well after the other
  std::vector<double> pressure_, rate_;  ///< state
};

/// R of n perforations of diameter d and discharge coefficient C (Crump & Conway 1988):
/// 8 rho / (pi^2 n^2 d^4 C^2) [Pa s^2/m^6].
double perforation_resistance(double density, double perforations, double diameter,
                              double discharge_coefficient);

}  // namespace perifrac
