#pragma once

#include <span>

#include <Eigen/SparseCore>

#include "core/operators/mirror_condition.hpp"
#include "core/operators/shape_tensor.hpp"

namespace perifrac {

/// The nonlocal gradient (paper Eq 8) as a sparse matrix from an unknown vector (R blocks of point
/// values, then face values) to R * D blocks of point gradients, block r * D + b.
template <int D, int R>
Eigen::SparseMatrix<double> gradient_matrix(const Family<D>& family,
                                            const FamilyMoments<D>& moments,
                                            const MirrorCondition<D, R>& mirror);

/// The matrix of sum_i V_i 1/2 s_i sum_j w_ij |u_j - u_i|^2, with s_i per point. Its whole diagonal
/// is stored, zeros of points without bonds too, for a storage to be added in place.
template <int D, int R>
Eigen::SparseMatrix<double> bond_matrix(const Family<D>& family,
                                        const MirrorCondition<D, R>& mirror,
                                        std::span<const double> bond_stiffness);

}  // namespace perifrac
