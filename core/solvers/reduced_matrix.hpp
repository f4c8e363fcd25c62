#pragma once

#include <Eigen/SparseCore>

namespace perifrac {

/// T^T A T, where no row of T has more than one entry: A on fewer unknowns, each of them one of A's
/// or several that move alike.
Eigen::SparseMatrix<double> reduced(const Eigen::SparseMatrix<double>& a,
                                    const Eigen::SparseMatrix<double>& t);

}  // namespace perifrac
