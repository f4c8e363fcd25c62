#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/sparse_cholesky.hpp"

namespace perifrac {

/// One level of a Multigrid: a symmetric, positive definite operator that is known by what it does
/// to a vector, and the way to the next coarser level.
class MultigridLevel {
 public:
  virtual ~MultigridLevel() = default;

  virtual Eigen::Index size() const = 0;
  /// result = A u.
  virtual void apply(const Eigen::VectorXd& u, Eigen::VectorXd& result) = 0;
  /// The inverse of A's diagonal, or what is near to it; 0 where an unknown is held at 0.
  virtual const Eigen::VectorXd& inverse_diagonal() const = 0;
  /// Takes a residual to the next coarser level: the transpose of add_correction().
  virtual void restrict_residual(const Eigen::VectorXd& residual,
                                 Eigen::VectorXd& coarse) const = 0;
  /// Adds to u what a correction of the next coarser level is here.
  virtual void add_correction(const Eigen::VectorXd& coarse, Eigen::VectorXd& u) const = 0;
};

/// Solves A x = b by conjugate gradients, preconditioned by one V-cycle: some steps of Chebyshev's
/// iteration before and after each correction, the coarsest level by its factor. Memory and time in
/// proportion to the unknowns. Gives the same bits at any number of threads if its levels do.
class Multigrid {
 public:
  /// `levels`: from the finest to the coarsest; the latter is factored as `coarsest`, rows and
  /// columns of held unknowns being those of the unit matrix. The more `smoothing_steps`, at least
  /// two, the lower the eigenvalues that they damp. Throws NotPositiveDefinite.
  Multigrid(std::vector<std::unique_ptr<MultigridLevel>> levels,
            const Eigen::SparseMatrix<double>& coarsest, int smoothing_steps = 2);

  /// Goes on from x until the residual is `tolerance` of b. Returns the iterations that took.
  /// Throws NotConverged.
  int solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance);

  /// As solve(), from a residual b - A x that is known: adds to x what takes it below `target`.
  int correct(Eigen::VectorXd& residual, Eigen::VectorXd& x, double target);

  /// correction = B residual by one V-cycle: B is near to A^-1, symmetric.
  void precondition(const Eigen::VectorXd& residual, Eigen::VectorXd& correction);

  /// The levels' operators have changed: the coarsest is factored anew.
  void take_coarsest(const Eigen::SparseMatrix<double>& coarsest) { coarsest_.factor(coarsest); }
  /// So much that smoothing is to be told of it.
  void find_largest();

 private:
  struct Work {
    double largest = 0.0;  ///< eigenvalue of D^-1 A, D being the diagonal, at most
    Eigen::VectorXd residual, correction, step, image;
  };

  void cycle(std::size_t level);
  void smooth(std::size_t level, bool from_zero);
  void take_off_image(std::size_t level, const Eigen::VectorXd& step);
  double largest_eigenvalue(MultigridLevel& level, Work& work) const;

  int smoothing_steps_;
  std::vector<std::unique_ptr<MultigridLevel>> levels_;
  std::vector<Work> work_;  ///< by level
  ConjugateGradients gradients_;
  SparseCholesky coarsest_;
};

}  // namespace perifrac
