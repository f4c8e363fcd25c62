#pragma once

#include <utility>
#include <vector>

#include "core/bonds/bond_state.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

/// The segment from x to y passes through the facet, its edge included; an end in the facet's plane
/// lies on the side of its normal.
template <int D>
bool is_cut(const CrackFacet<D>& facet, const Vector<D>& x, const Vector<D>& y);

/// The bonds between real points, pairs i < j, that a facet cuts. A bond through the facet's edge
/// counts as cut; a point in the facet's plane lies on the side of its normal.
/// `family` may be without the bonds that are broken already, or have them with weight 0: those are
/// passed over. No bond is longer than `reach` [m]: only points that near are asked.
template <int D>
std::vector<std::pair<Index, Index>> bonds_cut_by(const CrackFacet<D>& facet,
                                                  const Family<D>& family, double reach);

}  // namespace perifrac
