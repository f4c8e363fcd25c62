#pragma once

#include <vector>

#include "core/body/body.hpp"
#include "core/bonds/crack_facet.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The facets of the scene's 3D crack number k, a disc or a rectangle: squares of a spacing about
/// its centre, a corner of four, that lie in it and in the body with their middle. Throws
/// InputError.
std::vector<CrackFacet<3>> read_plane_crack(const Section& scene, std::size_t k,
                                            const Body<3>& body);

}  // namespace perifrac
