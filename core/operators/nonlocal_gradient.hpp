#pragma once

#include <functional>
#include <span>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/bonds/shape_tensor.hpp"

namespace perifrac {

/// T K_i^-1; `inverse_shape` is K_i^-1.
template <int R, int D>
Tensor<R, D> times_inverse_shape(const Tensor<R, D>& t, const Tensor<D, D>& inverse_shape) {
  Tensor<R, D> result{};
  for (int r = 0; r < R; ++r) {
    for (int b = 0; b < D; ++b) {
      for (int c = 0; c < D; ++c) {
        result[r * D + b] += t[r * D + c] * inverse_shape[c * D + b];
      }
    }
  }
  return result;
}

/// The nonlocal gradient (paper Eq 8) of a field at point i, sum_j w_ij (u_j - u_i) (x) K_i^-1 xi;
/// `own`: the field at i; `values`: of nodes, for sum_over_bonds(), the field's from D on.
template <int R, int D, class Values>
Tensor<R, D> gradient_at(const Family<D>& family, const Tensor<D, D>& inverse_shape,
                         const Values& values, const std::array<double, R>& own, Index i) {
  const Tensor<R, D> moment = sum_over_bonds<R * D, D + R>(
      family, i, values, [&](auto, const auto& other, const auto& xi, const auto& w) {
        std::array<std::decay_t<decltype(w)>, R * D> t;
        for (int r = 0; r < R; ++r) {
          const auto difference = w * (other[D + r] - own[r]);
          for (int b = 0; b < D; ++b) t[r * D + b] = difference * xi[b];
        }
        return t;
      });
  return times_inverse_shape<R, D>(moment, inverse_shape);
}

/// The same as a sparse matrix from an unknown vector (R blocks of point
/// values, then face values) to R * D blocks of point gradients, block r * D + b.
template <int D, int R>
Eigen::SparseMatrix<double> gradient_matrix(const Family<D>& family,
                                            const FamilyMoments<D>& moments,
                                            const MirrorCondition<D, R>& mirror);

/// Takes R * D blocks of points, stresses times volumes, to the forces that balance them on every
/// unknown, face values last [N]: the transpose of the gradient.
using ForceOfStress = std::function<Eigen::VectorXd(const Eigen::VectorXd& stress)>;

/// ForceOfStress on a family, inverse_shape(i) being K_i^-1; a point without stress costs nothing.
template <int D, int R>
Eigen::VectorXd force_of_stress(const Family<D>& family,
                                const std::function<Tensor<D, D>(Index i)>& inverse_shape,
                                const MirrorCondition<D, R>& mirror, const Eigen::VectorXd& stress);

/// The matrix of sum_i V_i 1/2 s_i sum_j w_ij (p_j - p_i)^2, with s_i per point. Its whole diagonal
/// is stored, zeros of points without bonds too, for a storage to be added in place.
template <int D>
Eigen::SparseMatrix<double> bond_matrix(const Family<D>& family,
                                        const MirrorCondition<D, 1>& mirror,
                                        std::span<const double> bond_stiffness);

}  // namespace perifrac
