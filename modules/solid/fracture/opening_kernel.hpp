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

/// What a body without end, but for planes of symmetry, makes of openings: the pressures in facets
/// that go with how far each opens, evenly [Pa/m]. Of constant displacement discontinuities, in 2D
/// segments in plane strain (Crouch 1976), in 3D rectangles, of which those in one plane answer to
/// each other; stiffened for single facets as a lattice is. `modulus`: E' at each facet [Pa].
template <int D>
Eigen::MatrixXd pressure_by_opening(std::span<const CrackFacet<D>> facets,
                                    std::span<const double> modulus,
                                    std::span<const SymmetryPlane> planes);

}  // namespace perifrac
