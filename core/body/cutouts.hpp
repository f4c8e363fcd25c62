#pragma once

#include <span>
#include <vector>

#include "core/bonds/family.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/faces.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

/// The keys of `cutouts` in the section of the body.
KeyTable cutout_keys();

/// Boxes that are not part of the body: notches, boreholes. Each corner lies between points of its
/// lattice, whose lowest corner is `origin`, so that walls are half a spacing off the points beside
/// them, as faces are. Throws InputError.
template <int D>
std::vector<Region<D>> read_cutouts(const Section& body, const Vector<D>& origin, double spacing);

/// Takes out the points that lie in a cut-out; throws InputError where one holds none, or all.
template <int D>
void cut_out(const Section& body, const std::vector<Region<D>>& cutouts, Points<D>& points);

/// The segment from x to y goes through the inside of the box; along its surface is not through.
template <int D>
bool passes_through(const Region<D>& box, const Vector<D>& x, const Vector<D>& y);

/// Takes the bonds that pass through a cut-out, or through its image behind a plane face in
/// `mirrored`, out of a family.
template <int D>
void remove_bonds_through(std::span<const Region<D>> cutouts, std::span<const Face> faces,
                          FaceSet mirrored, Family<D>& family);

}  // namespace perifrac
