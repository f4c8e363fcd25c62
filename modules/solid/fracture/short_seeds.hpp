#pragma once

#include <span>
#include <vector>

#include "core/body/body.hpp"
#include "core/bonds/crack_facet.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Throws InputError where one of the scene's cracks, which grow, is so short that its tips or its
/// front would never know when to go on. In 2D a tip needs a facet behind its last one, whose
/// opening it reads, and where no fluid drives it J, whose domain another tip is not to lie in; in
/// 3D the front has to lie around the squares (crack_plane.hpp). `seeds` by crack; `cut` is the
/// family that they have cut.
template <int D>
void check_seeds_can_grow(const Section& scene, const Body<D>& body, const Family<D>& cut,
                          std::span<const std::vector<CrackFacet<D>>> seeds);

}  // namespace perifrac
