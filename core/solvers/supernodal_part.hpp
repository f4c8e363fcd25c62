#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/solvers/supernodal_sweep.hpp"
#include "core/solvers/supernodes.hpp"

namespace perifrac {

/// Goes through the factor, or the part of it that a part of A^-1 b needs. A row of b that is not
/// zero acts on the supernode of that row and on those that this one's rows lead up to, the path to
/// the root of the elimination tree; likewise a row of the solution needs its own path only
/// (Gilbert 1994). For rows that lie close together that is a small part of the factor.
class SupernodalPart {
 public:
  /// Refers to the arrays of `factor`.
  explicit SupernodalPart(const Supernodes& factor);

  /// As SparseCholesky::solve_part(); `values` are those of L.
  void solve(const double* values, std::span<const int> rows,
             const Eigen::Ref<const Eigen::MatrixXd>& b, std::span<const int> wanted,
             Eigen::Ref<Eigen::MatrixXd> x);

  /// x = A^-1 b.
  void solve(const double* values, const Eigen::Ref<const Eigen::VectorXd>& b,
             Eigen::Ref<Eigen::VectorXd> x);

  /// As SparseCholesky::begin(), part() and finish(); what is begun is in the rows of P A P^T.
  void begin(const double* values, const Eigen::VectorXd& b, Eigen::VectorXd& begun);
  void part(const double* values, const Eigen::VectorXd& begun, std::span<const int> wanted,
            Eigen::VectorXd& x);
  void finish(const double* values, const Eigen::VectorXd& begun, std::span<const int> rows,
              const Eigen::VectorXd& c, Eigen::VectorXd& x);

 private:
  void make_room(Eigen::Index columns);
  void find_paths(std::span<const int> rows, std::vector<int>& path);
  template <class Columns, class Go>
  void in_columns(Columns columns, Go&& go);
  template <class Columns>
  void forward(const double* values, int s, Columns columns);
  template <class Columns>
  void backward(const double* values, int s, Columns columns);

  Supernodes factor_;
  SupernodalSweep sweep_;
  std::vector<int> place_;         ///< by row of A, that of P A P^T
  std::vector<int> supernode_of_;  ///< by row of P A P^T
  std::vector<char> is_on_path_;   ///< all 0 between calls
  std::vector<int> up_, down_;     ///< supernodes that b acts on, and that the solution needs
  Eigen::MatrixXd work_;           ///< all 0 between calls
  Eigen::MatrixXd gathered_;
};

}  // namespace perifrac
