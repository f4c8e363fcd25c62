#pragma once

#include <memory>
#include <optional>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// The keys of `kinematics`, of `material`, of what differs in `regions`, and of the stress at
/// rest.
KeyTable material_keys();

/// The material that a solid's section describes, on the families that the boundary asks for;
/// throws InputError.
template <int D>
std::unique_ptr<ElasticOperator<D>> read_material(const Section& section, const Body<D>& body,
                                                  const SolidBoundary<D>& boundary);

/// The same on a family of its own, whose bonds may break, and without the initial stress; throws
/// InputError for a material that cannot break.
template <int D>
std::unique_ptr<BreakableElasticity<D>> read_breakable_material(
    const Section& section, const Body<D>& body, std::shared_ptr<const Family<D>> family,
    const MirrorCondition<D, D>& mirror);

/// Its forces follow displacements linearly.
bool is_linear_material(const Section& section);

/// Rotations may be large.
bool is_corotational(const Section& section);

}  // namespace perifrac
