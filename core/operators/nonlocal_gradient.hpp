#pragma once

#include <functional>
#include <span>
#include <utility>

#include <Eigen/SparseCore>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/bonds/shape_tensor.hpp"

namespace perifrac {

/// T K_i^-1.
template <int R, int D>
Tensor<R, D> times_inverse_shape(const Tensor<R, D>& t, const FamilyMoments<D>& moments, Index i) {
  Tensor<R, D> result{};
  for (int r = 0; r < R; ++r) {
    for (int b = 0; b < D; ++b) {
      for (int c = 0; c < D; ++c) {
        result[r * D + b] += t[r * D + c] * moments.inverse_shape[c * D + b][i];
      }
    }
  }
  return result;
}

/// The nonlocal gradient (paper Eq 8) of a field at point i, sum_j w_ij (u_j - u_i) (x) K_i^-1 xi;
/// `field`: R blocks of nodes.
template <int R, int D>
Tensor<R, D> gradient_at(const Family<D>& family, const FamilyMoments<D>& moments,
                         const double* field, Index i) {
  std::array<const double*, R> u;
  std::array<double, R> own;
  for (int r = 0; r < R; ++r) {
    u[r] = field + static_cast<std::size_t>(r) * family.node_count();
    own[r] = u[r][i];
  }
  const Tensor<R, D> moment =
      sum_over_bonds<R * D>(family, i, [&](Index j, const Vector<D>& xi, double w) {
        Tensor<R, D> t;
        for (int r = 0; r < R; ++r) {
          const double difference = w * (u[r][j] - own[r]);
          for (int b = 0; b < D; ++b) t[r * D + b] = difference * xi[b];
        }
        return t;
      });
  return times_inverse_shape<R, D>(moment, moments, i);
}

/// The same as a sparse matrix from an unknown vector (R blocks of point
/// values, then face values) to R * D blocks of point gradients, block r * D + b.
template <int D, int R>
Eigen::SparseMatrix<double> gradient_matrix(const Family<D>& family,
                                            const FamilyMoments<D>& moments,
                                            const MirrorCondition<D, R>& mirror);

/// Its transpose times a flux of R * D blocks of points, without the matrix; points where the flux
/// is 0 cost nothing.
template <int D, int R>
Eigen::VectorXd transposed_gradient(const Family<D>& family, const FamilyMoments<D>& moments,
                                    const MirrorCondition<D, R>& mirror,
                                    const Eigen::VectorXd& flux);

/// The transpose of a gradient, however it is multiplied.
class TransposedGradient {
 public:
  using Product = std::function<Eigen::VectorXd(const Eigen::VectorXd& flux)>;

  TransposedGradient(Product product) : product_(std::move(product)) {}
  TransposedGradient(Eigen::SparseMatrix<double> gradient)
      : product_([gradient = std::move(gradient)](const Eigen::VectorXd& flux) {
          return Eigen::VectorXd(gradient.transpose() * flux);
        }) {}

  Eigen::VectorXd operator*(const Eigen::VectorXd& flux) const { return product_(flux); }

 private:
  Product product_;
};

/// The matrix of sum_i V_i 1/2 s_i sum_j w_ij |u_j - u_i|^2, with s_i per point. Its whole diagonal
/// is stored, zeros of points without bonds too, for a storage to be added in place.
template <int D, int R>
Eigen::SparseMatrix<double> bond_matrix(const Family<D>& family,
                                        const MirrorCondition<D, R>& mirror,
                                        std::span<const double> bond_stiffness);

}  // namespace perifrac
