#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace perifrac {

/// A matrix and the way to it from the next coarser one.
struct AggregatedMatrix {
  Eigen::SparseMatrix<double> matrix;
  Eigen::SparseMatrix<double> from_coarser;  ///< empty where there is none
};

/// Ever coarser forms of a diffusion's matrix: symmetric, its entries off the diagonal not positive
/// and its rows' sums not negative. Unknowns that hang together strongly become one, by a value
/// that is the same for all of them but smoothed over their neighbours (Vanek, Mandel and Brezina,
/// Computing 56, 1996); coarser matrices follow by Galerkin's condition. Unknowns that are held,
/// and those that nothing ties to others, have no part in coarser ones.
/// From the finest to the coarsest, which has `few` unknowns or no less than the one before.
std::vector<AggregatedMatrix> aggregate(Eigen::SparseMatrix<double> finest,
                                        const std::vector<bool>& held, Eigen::Index few);

}  // namespace perifrac
