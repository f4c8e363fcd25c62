#include "core/solvers/band_lu.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace perifrac {

Eigen::Index half_bandwidth(const Eigen::MatrixXd& matrix, std::span<const Index> order) {
  std::vector<Eigen::Index> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<Eigen::Index>(k);
  Eigen::Index most = 0;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      if (matrix(row, column) != 0.0) most = std::max(most, std::abs(place[row] - place[column]));
    }
  }
  return most;
}

Eigen::VectorXd solve_band(const Eigen::MatrixXd& matrix, std::span<const Index> order,
                           Eigen::Index half_bandwidth, const Eigen::VectorXd& right) {
  const Eigen::Index size = matrix.rows(), below = half_bandwidth;
  const Eigen::Index above = 2 * below;  // with what row exchanges fill in
  // Row k holds columns k - below to k + above.
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> band(size, below + above + 1);
  Eigen::VectorXd x(size);
  for (Eigen::Index row = 0; row < size; ++row) {
    x[row] = right[order[row]];
    for (Eigen::Index k = -below; k <= above; ++k) {
      const Eigen::Index column = row + k;
      const bool is_in = column >= 0 && column < size && k <= below;
      band(row, below + k) = is_in ? matrix(order[row], order[column]) : 0.0;
    }
  }
  const auto at = [&](Eigen::Index row, Eigen::Index column) -> double& {
    return band(row, below + column - row);
  };
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::Index last_row = std::min(size - 1, k + below);
    const Eigen::Index last_column = std::min(size - 1, k + above);
    Eigen::Index pivot = k;
    for (Eigen::Index row = k + 1; row <= last_row; ++row) {
      if (std::abs(at(row, k)) > std::abs(at(pivot, k))) pivot = row;
    }
    if (pivot != k) {
      std::swap(x[k], x[pivot]);
      for (Eigen::Index c = k; c <= last_column; ++c) std::swap(at(k, c), at(pivot, c));
    }
    for (Eigen::Index row = k + 1; row <= last_row; ++row) {
      const double part = at(row, k) / at(k, k);
      if (part == 0.0) continue;
      for (Eigen::Index c = k + 1; c <= last_column; ++c) at(row, c) -= part * at(k, c);
      x[row] -= part * x[k];
    }
  }
  for (Eigen::Index k = size - 1; k >= 0; --k) {
    for (Eigen::Index c = k + 1; c <= std::min(size - 1, k + above); ++c) x[k] -= at(k, c) * x[c];
    x[k] /= at(k, k);
  }
  Eigen::VectorXd result(size);
  for (Eigen::Index k = 0; k < size; ++k) result[order[k]] = x[k];
  return result;
}

}  // namespace perifrac
