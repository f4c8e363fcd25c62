#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/bonds/crack_facet.hpp"

namespace perifrac {

/// A plane of symmetry: where a coordinate has this value [m].
struct SymmetryPlane {
  int axis;
  double coordinate;
};

/// What a body without end, but for planes of symmetry, makes of openings: how far facets open by
/// pressure in them [m/Pa], each opening evenly. Of constant displacement discontinuities, in 2D
/// segments in plane strain (Crouch 1976), in 3D rectangles, of which those in one plane answer to
/// each other; stiffened for single facets as a lattice is. `modulus`: E' at each facet [Pa].
template <int D>
Eigen::MatrixXd opening_by_pressure(std::span<const CrackFacet<D>> facets,
                                    std::span<const double> modulus,
                                    std::span<const SymmetryPlane> planes);

}  // namespace perifrac
