#pragma once

#include <vector>

#include "core/body/body.hpp"
#include "core/bonds/crack_facet.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The facets of every crack that the scene's body has from the start. Throws InputError, with a
/// line a mistake, where cracks lie outside the body or stick out of it, run through a cut-out, or
/// lie one upon another: no point is between two that are less than a spacing apart, so that they
/// cut the same bonds.
template <int D>
std::vector<std::vector<CrackFacet<D>>> read_cracks(const Section& scene, const Body<D>& body);

/// The same, one after the other.
template <int D>
std::vector<CrackFacet<D>> all_facets(const std::vector<std::vector<CrackFacet<D>>>& cracks);

/// From a place to the nearest point of a facet [m].
template <int D>
double distance(const Vector<D>& x, const CrackFacet<D>& facet);

}  // namespace perifrac
