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

/// Boxes that are not part of the body: notches, slots. Each corner lies between points of its
/// lattice, whose lowest corner is `origin`, so that walls are half a spacing off the points beside
/// them, as faces are. Throws InputError.
template <int D>
std::vector<Region<D>> read_cutouts(const Section& body, const Vector<D>& origin, double spacing);

/// Round holes in a box with these plane faces, circles and in 3D cylinders, as boreholes are: each
/// is a face of the body. They are two horizons or more from the planes, but for those that their
/// centre lies on, and four from each other and the cut-outs that are boxes. Throws InputError.
template <int D>
std::vector<Face> read_holes(const Section& body, std::span<const Face> planes,
                             std::span<const Region<D>> boxes, double horizon);

/// Takes out the points that lie in a cut-out; throws InputError where one holds none, or all.
template <int D>
void cut_out(const Section& body, std::span<const Region<D>> boxes, std::span<const Face> holes,
             Points<D>& points);

/// The segment from x to y goes through the inside of the box; along its surface is not through.
template <int D>
bool passes_through(const Region<D>& box, const Vector<D>& x, const Vector<D>& y);

/// The same of a hole, for places outside it; no segment from a place inside does.
template <int D>
bool passes_through(const Face& hole, const Vector<D>& x, const Vector<D>& y);

/// Takes the bonds that pass through a box or a hole, or through its image behind a plane face in
/// `mirrored`, out of a family. Those to images at the wall of a hole stay.
template <int D>
void remove_bonds_through(std::span<const Region<D>> cutouts, std::span<const Face> faces,
                          FaceSet mirrored, Family<D>& family);

}  // namespace perifrac
