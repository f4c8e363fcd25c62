#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/shared_rows.hpp"
#include "core/bonds/bond_weights.hpp"
#include "core/bonds/influence_function.hpp"
#include "core/bonds/point_bonds.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

/// The family of every point of a body: its bonds to the points within the horizon.
///
/// A mirrored face adds ghosts: images of the points near it. Ghosts are numbered after the real
/// points; a ghost's value follows from its source and the face's condition (mirror_condition.hpp).
/// Only real points have bonds; the image of a bond is not stored.
/// The image at a sphere of radius R lies on the same ray at r' = 2 R - r, with the volume times
/// (r' / r)^(D-1), at a cylinder times r' / r; unlike that at planes it keeps no distances.
template <int D>
struct Family {
  Index point_count = 0;                        ///< real points
  std::array<std::vector<double>, D> position;  ///< [m], real points, then ghosts
  std::vector<double> volume;                   ///< real points, then ghosts
  std::vector<Index> ghost_source;              ///< real point that a ghost is the image of
  std::vector<FaceSet> ghost_faces;             ///< the faces that it was mirrored at
  std::vector<std::uint8_t> ghost_axes;         ///< bit a: its coordinate a is reversed
  bool curved = false;                          ///< some ghosts are images at a curved face
  /// By point, how far the numbers of its bonds' other ends are from its own, ascending. On a
  /// lattice most points have the same, and share them.
  SharedRows<Index> steps;
  BondWeights weight;  ///< omega(|xi|) V_other of the same bonds

  Index ghost_count() const { return static_cast<Index>(ghost_source.size()); }
  Index node_count() const { return point_count + ghost_count(); }
  PointBonds bonds(Index i) const { return {i, steps[i], weight}; }
  Index bond_count(Index i) const { return steps.size(i); }
  /// Of i's bonds, which are sorted by their other end, the first to a ghost; bond_count(i): none.
  Index first_ghost_bond(Index i) const {
    const PointBonds own = bonds(i);
    Index k = own.count();
    while (k > 0 && own.other(k - 1) >= point_count) --k;
    return k;
  }
  std::size_t bytes() const;
};

/// Finds all families. Bonds of a point are sorted by their other end, so that they depend on
/// nothing but the points. Points that are marked as `bondless` have no bonds and no ghosts; empty:
/// none is.
template <int D>
Family<D> build_family(const Points<D>& points, std::span<const Face> faces, FaceSet mirrored,
                       double horizon, InfluenceFunction influence,
                       std::vector<bool> bondless = {});

/// The part of a family that has ghosts behind the faces in `mirrored` alone: what build_family
/// gives for them, with the weights that the bonds have here.
template <int D>
Family<D> without_other_ghosts(const Family<D>& family, FaceSet mirrored);

}  // namespace perifrac
