#pragma once

#include <vector>

#include "core/base/small_vector.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

/// Moments of every family, the same for all physics on it:
/// K_i = sum_j w_ij xi xi^T (paper Eq 10) and m_i = sum_j w_ij |xi|^2 = tr K_i (Eq 4).
template <int D>
struct FamilyMoments {
  /// Entry (a, b) of K_i^-1 is inverse_shape[a * D + b][i] [1/m^(2+D)].
  std::array<std::vector<double>, D * D> inverse_shape;
  Tensor<D, D> inverse_shape_at(Index i) const {
    Tensor<D, D> inverse;
    for (int k = 0; k < D * D; ++k) inverse[k] = inverse_shape[k][i];
    return inverse;
  }
  std::vector<double> weighted_volume;  ///< m_i [m^(2+D)]; see family_moments()
};

/// K_i, row by row.
template <int D>
Tensor<D, D> shape_tensor_at(const Family<D>& family, Index i);

/// K_i^-1, row by row: an entry of FamilyMoments, for whoever needs few of them.
template <int D>
Tensor<D, D> inverse_shape_at(const Family<D>& family, Index i);

/// m_i of the bonds that are left; infinite where none is.
template <int D>
double weighted_volume(const Family<D>& family, Index i);

/// A point without bonds has a zero inverse shape and an infinite weighted volume: no gradient, no
/// stiffness. Throws BodyError where a family has bonds that do not span space.
template <int D>
FamilyMoments<D> family_moments(const Family<D>& family);

/// Finds the moments of point i anew, after bonds broke. A family that broke down to a line has a
/// zero inverse shape beside the weighted volume of its bonds; returns is_thin().
template <int D>
bool set_moments(const Family<D>& family, Index i, FamilyMoments<D>& moments);

/// The bonds of point i span space so poorly (lambda_min / lambda_max of K_i < 0.05) that a
/// gradient from them would amplify noise twenty times.
template <int D>
bool is_thin(const Family<D>& family, Index i);

}  // namespace perifrac
