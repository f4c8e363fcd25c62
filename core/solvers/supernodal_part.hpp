#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace perifrac {

/// A supernodal Cholesky factor L of P A P^T, without its values: supernode s has the columns
/// columns[s] to columns[s + 1], and as rows these and then those below, ascending, from
/// rows[rows_begin[s]] on; its values are dense, by column, from values_begin[s] on.
struct Supernodes {
  std::span<const int> columns;
  std::span<const int> rows_begin;
  std::span<const int> values_begin;
  std::span<const int> rows;
  std::span<const int> permutation;  ///< by row of P A P^T, that of A
};

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

  /// As SparseCholesky::begin(), part() and finish(); what is begun is in the rows of P A P^T.
  void begin(const double* values, const Eigen::VectorXd& b, Eigen::VectorXd& begun);
  void part(const double* values, const Eigen::VectorXd& begun, std::span<const int> wanted,
            Eigen::VectorXd& x);
  void finish(const double* values, const Eigen::VectorXd& begun, std::span<const int> rows,
              const Eigen::VectorXd& c, Eigen::VectorXd& x);

 private:
  int width(int s) const { return factor_.columns[s + 1] - factor_.columns[s]; }
  int height(int s) const { return factor_.rows_begin[s + 1] - factor_.rows_begin[s]; }
  std::span<const int> below(int s) const {
    return factor_.rows.subspan(factor_.rows_begin[s] + width(s), height(s) - width(s));
  }
  int count() const { return static_cast<int>(std::ssize(is_on_path_)); }
  void make_room(Eigen::Index columns);
  void find_paths(std::span<const int> rows, std::vector<int>& path);
  template <class Columns>
  void forward(const double* values, int s, Columns columns);
  template <class Columns>
  void backward(const double* values, int s, Columns columns);

  Supernodes factor_;
  std::vector<int> place_;         ///< by row of A, that of P A P^T
  std::vector<int> supernode_of_;  ///< by row of P A P^T
  std::vector<char> is_on_path_;   ///< all 0 between calls
  std::vector<int> up_, down_;     ///< supernodes that b acts on, and that the solution needs
  Eigen::MatrixXd work_;           ///< all 0 between calls
  Eigen::MatrixXd gathered_;
};

}  // namespace perifrac
