#pragma once

#include <span>

#include "core/bonds/family.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

/// What it took to project a family's weights.
struct WeightProjection {
  Index complete_points = 0;
  int steps = 0;  ///< of Newton's method
  double least_factor = 1.0;
  double largest_factor = 1.0;
};

/// Gives an irregular cloud the first two moments of a lattice: multiplies the weights by
/// symmetric factors s_ij > 0 so that at every complete point
///   sum_j w_ij xi = 0   and   K_i = sum_j w_ij xi xi^T = k I,   k the same everywhere.
/// Then a uniform flux or stress leaves no force inside: the transpose of the nonlocal gradient
/// takes it to nothing, and sum_j c_ij xi vanishes for every c_ij = V_i w_ij f(m_i, m_j) too.
///
/// A point is complete where it lies a horizon or more from each face that is not mirrored. Other
/// points keep their moments as they are. Where the moments hold already, all factors are 1.
/// They hold to 1e-12 of k; in 3D, beyond 600 complete points, to 2e-3.
///
/// Throws BodyError where no such factors are found or they leave [1e-4, 100]: the family has too
/// few bonds for the disorder of the cloud.
template <int D>
WeightProjection project_weights(Family<D>& family, std::span<const Face> faces, FaceSet mirrored,
                                 double horizon);

}  // namespace perifrac
