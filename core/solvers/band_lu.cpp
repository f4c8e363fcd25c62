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

namespace {

/// A band matrix that is eliminated in place, with exchanges of rows, and its right-hand side.
class Band {
 public:
  Band(const Eigen::MatrixXd& matrix, std::span<const Index> order, Eigen::Index half_bandwidth,
       const Eigen::VectorXd& right)
      : below_(half_bandwidth),
        above_(2 * half_bandwidth),
        band_(matrix.rows(), below_ + above_ + 1),
        x_(matrix.rows()) {
    for (Eigen::Index row = 0; row < size(); ++row) {
      x_[row] = right[order[row]];
      for (Eigen::Index k = -below_; k <= above_; ++k) {
        const Eigen::Index column = row + k;
        const bool is_in = column >= 0 && column < size() && k <= below_;
        band_(row, below_ + k) = is_in ? matrix(order[row], order[column]) : 0.0;
      }
    }
  }

  Eigen::Index size() const { return x_.size(); }

  void eliminate() {
    for (Eigen::Index k = 0; k < size(); ++k) {
      bring_pivot_to(k);
      for (Eigen::Index row = k + 1; row <= last(k, below_); ++row) {
        const double part = at(row, k) / at(k, k);
        if (part == 0.0) continue;
        for (Eigen::Index c = k + 1; c <= last(k, above_); ++c) at(row, c) -= part * at(k, c);
        x_[row] -= part * x_[k];
      }
    }
  }

  /// After eliminate().
  const Eigen::VectorXd& substitute_back() {
    for (Eigen::Index k = size() - 1; k >= 0; --k) {
      for (Eigen::Index c = k + 1; c <= last(k, above_); ++c) x_[k] -= at(k, c) * x_[c];
      x_[k] /= at(k, k);
    }
    return x_;
  }

 private:
  Eigen::Index last(Eigen::Index k, Eigen::Index width) const {
    return std::min(size() - 1, k + width);
  }
  double& at(Eigen::Index row, Eigen::Index column) { return band_(row, below_ + column - row); }

  void bring_pivot_to(Eigen::Index k) {
    Eigen::Index pivot = k;
    for (Eigen::Index row = k + 1; row <= last(k, below_); ++row) {
      if (std::abs(at(row, k)) > std::abs(at(pivot, k))) pivot = row;
    }
    if (pivot == k) return;
    std::swap(x_[k], x_[pivot]);
    for (Eigen::Index c = k; c <= last(k, above_); ++c) std::swap(at(k, c), at(pivot, c));
  }

  Eigen::Index below_;
  Eigen::Index above_;  ///< with what row exchanges fill in
  /// Row k holds columns k - below to k + above.
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> band_;
  Eigen::VectorXd x_;
};

}  // namespace

Eigen::VectorXd solve_band(const Eigen::MatrixXd& matrix, std::span<const Index> order,
                           Eigen::Index half_bandwidth, const Eigen::VectorXd& right) {
  Band band(matrix, order, half_bandwidth, right);
  band.eliminate();
  const Eigen::VectorXd& x = band.substitute_back();
  Eigen::VectorXd result(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) result[order[k]] = x[k];
  return result;
}

}  // namespace perifrac
