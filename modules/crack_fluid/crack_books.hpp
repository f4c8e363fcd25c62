#pragma once

#include "core/state/compensated_sum.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// What came into the fluid of cracks since the start, in 2D per metre.
struct CrackBooks {
  CompensatedSum injected, leaked;   ///< [kg]
  CompensatedSum work, dissipation;  ///< [J]

  void visit_state(StateVisitor& visitor) {
    injected.visit_state(visitor, "injected_crack_fluid_mass");
    leaked.visit_state(visitor, "leaked_crack_fluid_mass");
    work.visit_state(visitor, "crack_fluid_work");
    dissipation.visit_state(visitor, "crack_flow_dissipation");
  }
};

}  // namespace perifrac
