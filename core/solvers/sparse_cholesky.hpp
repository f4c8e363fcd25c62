#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace perifrac {

class CholeskyBackend;

/// The matrix has a pivot <= 0, or an entry that is not finite.
class NotPositiveDefinite : public std::runtime_error {
 public:
  explicit NotPositiveDefinite(Eigen::Index row);

  /// Where that is.
  Eigen::Index row() const { return row_; }

 private:
  Eigen::Index row_;
};

/// What all factors of this process have done so far.
struct CholeskyWork {
  std::int64_t factorisations = 0;
  std::int64_t solves = 0;  ///< calls, whatever the number of right-hand sides
};

/// Direct solution of A x = b, A sparse, symmetric and positive definite. Gives the same bits at
/// any number of threads. One object serves one thread at a time.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Factors A (compressed); only its entries on and below the diagonal are used. Where they lie
  /// as in the matrix before, the ordering found for that one is used again.
  /// Throws NotPositiveDefinite (no factor is left then), std::bad_alloc.
  void factor(const Eigen::SparseMatrix<double>& a);

  /// x = A^-1 b, one column a right-hand side; x has the shape of b and does not overlap it.
  void solve(const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> x) const;

  /// The rows `wanted` of A^-1 b, where b is zero but in `rows` (each once), which are given, one
  /// column a right-hand side. Passes only through the part of the factor that leads from these
  /// rows to those: of a flat body's factor some hundredths where all lie close together.
  void solve_part(std::span<const int> rows, const Eigen::Ref<const Eigen::MatrixXd>& b,
                  std::span<const int> wanted, Eigen::Ref<Eigen::MatrixXd> x) const;

  /// Where c, zero but in a few rows, follows from A^-1 b in some rows: A^-1 (b + c) at the cost of
  /// one solution. begin() goes through the factor once, part() finds rows of A^-1 b, finish()
  /// takes c at `rows` (each once) and goes back.
  Eigen::VectorXd begin(const Eigen::VectorXd& b) const;
  Eigen::VectorXd part(const Eigen::VectorXd& begun, std::span<const int> wanted) const;
  Eigen::VectorXd finish(const Eigen::VectorXd& begun, std::span<const int> rows = {},
                         const Eigen::VectorXd& c = {}) const;

  static CholeskyWork work();

  /// Which library factors: the licence of a binary depends on it.
  static const char* backend();

 private:
  bool has_analysed_pattern_of(const Eigen::SparseMatrix<double>& a) const;

  std::unique_ptr<CholeskyBackend> backend_;
  std::vector<int> starts_, rows_;  // the pattern that was analysed
};

}  // namespace perifrac
