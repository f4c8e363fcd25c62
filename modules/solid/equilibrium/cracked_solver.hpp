#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "modules/solid/equilibrium/stiffness_solver.hpp"
#include "modules/solid/fracture/cracked_body.hpp"

namespace perifrac {

/// From so many points on a lattice `automatic` solves for a body with cracks by multigrid: it is
/// the faster one from there on in 3D, in a tenth of the memory.
constexpr double points_worth_iteration(int dimension) { return dimension == 2 ? 1e5 : 3e3; }

/// A body with cracks that is solved for as `choice` says; body and boundary as of CrackedBody and
/// IteratedBody. Throws BodyError where the body is none for the choice.
template <int D>
std::unique_ptr<CrackedBody<D>> make_cracked_body(
    const Body<D>& body, const SolidBoundary<D>& boundary, std::shared_ptr<Family<D>> family,
    std::shared_ptr<BreakableElasticity<D>> elastic, BondState<D>& bonds,
    std::optional<InitialStress<D>> initial_stress, const std::vector<CrackFacet<D>>& seeds,
    bool has_friction, const SolverChoice& choice);

}  // namespace perifrac
