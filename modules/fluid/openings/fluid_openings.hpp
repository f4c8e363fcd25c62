#pragma once

#include <memory>

#include "modules/fluid/openings/fluid_mouths.hpp"
#include "modules/fluid/openings/inlets.hpp"
#include "modules/fluid/openings/outlets.hpp"
#include "modules/fluid/points/fluid_domain.hpp"
#include "modules/fluid/walls/fluid_walls.hpp"

namespace perifrac {

/// Where fluid comes in and goes out.
template <int D>
struct FluidOpenings {
  std::unique_ptr<Inlets<D>> inlets;    ///< null: none
  std::unique_ptr<Outlets<D>> outlets;  ///< null: none
  FluidDomain<D> domain;
  std::unique_ptr<FluidMouths<D>> mouths{};  ///< null: none

  /// Some points may be removed in the course of a run.
  bool may_lose() const { return outlets || domain.may_lose(); }

  void visit_state(StateVisitor& visitor) {
    if (inlets) inlets->visit_state(visitor);
    if (outlets) outlets->visit_state(visitor);
    domain.visit_state(visitor);
    if (mouths) mouths->visit_state(visitor);
  }
};

/// Reads them. `body` may be null. Throws InputError.
template <int D>
FluidOpenings<D> read_fluid_openings(const Section& section, const Body<D>* body,
                                     const FluidWalls<D>& walls, const FluidProperties& fluid,
                                     double spacing);

}  // namespace perifrac
