#pragma once

#include <memory>
#include <optional>
#include <span>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace perifrac {

/// The library behind SparseCholesky. The build compiles one of cholmod_backend.cpp and
/// eigen_backend.cpp, which define make() and name().
class CholeskyBackend {
 public:
  static std::unique_ptr<CholeskyBackend> make();
  static const char* name();

  virtual ~CholeskyBackend() = default;

  /// Finds an ordering for the pattern of A's lower half.
  virtual void analyze(const Eigen::SparseMatrix<double>& a) = 0;

  /// Factors A, of the pattern last analysed; returns the row of the first pivot that is not
  /// positive, if any.
  virtual std::optional<Eigen::Index> factor(const Eigen::SparseMatrix<double>& a) = 0;

  virtual void solve(const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> x) = 0;

  /// As SparseCholesky::solve_part().
  virtual void solve_part(std::span<const int> rows, const Eigen::Ref<const Eigen::MatrixXd>& b,
                          std::span<const int> wanted, Eigen::Ref<Eigen::MatrixXd> x) = 0;

  /// As SparseCholesky's.
  virtual void begin(const Eigen::VectorXd& b, Eigen::VectorXd& begun) = 0;
  virtual void part(const Eigen::VectorXd& begun, std::span<const int> wanted,
                    Eigen::VectorXd& x) = 0;
  virtual void finish(const Eigen::VectorXd& begun, std::span<const int> rows,
                      const Eigen::VectorXd& c, Eigen::VectorXd& x) = 0;
};

}  // namespace perifrac
