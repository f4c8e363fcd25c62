#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/bonds/bond_state.hpp"
#include "core/time/schedule.hpp"
#include "modules/crack_fluid/crack_liquid.hpp"
#include "modules/crack_fluid/crack_step.hpp"
#include "modules/crack_fluid/crack_wells.hpp"

namespace perifrac {

/// Where fluid is pumped into a crack, at the facets nearest to a place.
struct CrackInlet {
  std::string name;
  std::array<double, 3> at;  ///< the third: 3D [m]
  bool holds_pressure;
  double amount;  ///< pressure [Pa] or volume per time at zero pressure [m^3/s], in 2D per metre,
                  ///< times the schedule
  Schedule schedule;
  bool from_fluid = false;  ///< at the pressure of the free fluid there (crack_mouths.hpp)
  bool from_well = false;   ///< a cluster of a well, which says what it brings (crack_wells.hpp)
};

/// The inlets of a crack, the clusters of wells last. One that takes fluid out by rate takes no
/// more than comes to it once its facet is no longer under pressure.
class CrackInlets {
 public:
  /// As many inlets are clusters as the wells have.
  CrackInlets(std::vector<CrackInlet> inlets, const CrackLiquid& liquid,
              std::vector<CrackWell> wells = {});

  const std::vector<CrackInlet>& all() const { return inlets_; }
  /// Finds each inlet's facets: the nearest and what is as near.
  void locate(const PointSet& facets, const CrackGraph& graph);
  std::span<const Index> facets(std::size_t inlet) const { return facets_[inlet]; }

  /// What free fluid at an inlet offers until told otherwise: its pressure [Pa], and by how much
  /// what is taken lowers that [Pa m/kg]; 0: there is none.
  struct Supply {
    double pressure = 0.0;
    double stiffness = 0.0;
  };
  void supply(std::size_t inlet, const Supply& supply) { supply_[inlet] = supply; }

  /// What they bring over a step; nothing in one of no length. Throws NumericalError where a facet
  /// serves two inlets.
  std::span<const FacetInflow> inflows(const TimeWindow& step);

  CrackWells& wells() { return wells_; }
  std::span<WellFlow> well_flows(const TimeWindow& step);
  /// The inlet that a cluster is.
  std::size_t inlet_of_cluster(std::size_t cluster) const {
    return inlets_.size() - wells_.cluster_count() + cluster;
  }
  bool is_of_well(Index facet) const;

 private:
  /// What the n-th facet of inlet k brings; it is no cluster of a well.
  FacetInflow inflow(std::size_t k, std::size_t n, const TimeWindow& step) const;

  std::vector<CrackInlet> inlets_;
  CrackLiquid liquid_;
  CrackWells wells_;
  std::vector<Supply> supply_;              ///< by inlet, of those that free fluid feeds
  std::vector<std::vector<Index>> facets_;  ///< by inlet
  std::vector<std::vector<double>> share_;  ///< of each of them, by length
  std::vector<FacetInflow> inflows_;
};

}  // namespace perifrac
