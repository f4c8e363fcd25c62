#pragma once

#include <span>
#include <vector>

#include "modules/crack_fluid/crack_graph.hpp"

namespace perifrac {

/// How easily fluid flows from the middle of each facet that ends at a joint to the joint.
struct JointConductances {
  std::vector<double> conductance;  ///< c, by branch [m^2/(Pa s)]
  std::vector<double> growth;       ///< dc / d(aperture), own and partner's alike
  std::vector<Index> partner;       ///< facet whose aperture makes the mean with its own
  double sum = 0.0;                 ///< of the conductances

  void find(std::span<const CrackGraph::Branch> joint, std::span<const double> aperture,
            const CrackGraph& graph, double viscosity);
};

}  // namespace perifrac
