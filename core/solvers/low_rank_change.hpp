#pragma once

#include <Eigen/Core>

namespace perifrac {

/// A change of a matrix by few columns, [basis of_basis, left] right^T. The basis is the same again
/// and again.
struct LowRankChange {
  Eigen::MatrixXd basis{}, of_basis{}, left{}, right{};
};

}  // namespace perifrac
