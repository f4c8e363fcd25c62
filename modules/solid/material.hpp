#pragma once

#include <memory>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/body.hpp"
#include "modules/solid/elastic_operator.hpp"
#include "modules/solid/solid_boundary.hpp"

namespace perifrac {

/// The keys of `material`, of what differs in `regions`, and of `confining_stress`.
KeyTable material_keys();

/// The material that a solid's section describes, on the families that the boundary asks for;
/// throws InputError.
template <int D>
std::unique_ptr<ElasticOperator<D>> read_material(const Section& section, const Body<D>& body,
                                                  const SolidBoundary<D>& boundary);

}  // namespace perifrac
