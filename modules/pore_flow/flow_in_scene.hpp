#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/module/physics_module.hpp"
#include "modules/pore_flow/boundary/pore_boundary.hpp"
#include "modules/pore_flow/darcy_system.hpp"
#include "modules/pore_flow/material/anisotropic_darcy_law.hpp"
#include "modules/pore_flow/material/pore_material.hpp"

namespace perifrac {

/// The keys of pore flow that hold however it is discretised in space.
KeyTable flow_keys();

/// Whether implicit steps factor the flow, of a body of so many points, and do not iterate.
bool factors_flow(const Section& flow, double points);

/// What a scene says of pore flow, however it is discretised.
template <int D>
struct FlowInScene {
  PoreBoundary<D> boundary;
  PoreFluid fluid;
  PoreMaterials materials;               ///< by region
  std::vector<Tensor<D, D>> mobilities;  ///< by region [m^2/(Pa s)]

  const std::vector<std::uint8_t>& region() const { return materials.material_of_point; }
};

/// Reads it; throws InputError.
template <int D>
FlowInScene<D> read_flow(const Section& section, const Body<D>& body);

/// The mobility of every point, its scatter included. Throws InputError.
template <int D>
LawByRegion<AnisotropicDarcyLaw<D>> read_law(const Section& section, const Body<D>& body,
                                             const FlowInScene<D>& scene);

/// A discretisation of the flow, and of the sources that inflow through faces is spread over.
template <int D>
struct Discretisation {
  std::unique_ptr<FlowOperator<D>> flow;
  ScheduledVector sources{0};
};

/// The equations; `mirror` numbers the faces of prescribed pressure. Throws InputError.
template <int D>
DarcySystem<D> make_equations(const Section& section, const std::shared_ptr<const Body<D>>& body,
                              const FlowInScene<D>& scene, const MirrorCondition<D, 1>& mirror,
                              Discretisation<D> space);

/// The module of these equations, with the start and the integrator that the scene names.
template <int D>
std::unique_ptr<PhysicsModule> make_flow_module(const Section& section,
                                                std::shared_ptr<const Body<D>> body,
                                                DarcySystem<D> equations);

}  // namespace perifrac
