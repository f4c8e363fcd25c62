#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "core/solvers/low_rank_change.hpp"

namespace perifrac {

/// Pairs of faces in 2D that may touch, stick and slide: Signorini's conditions with Coulomb's
/// friction. Of n pairs, the n normal components come first in a vector, then the n tangential
/// ones.
struct FrictionalContact {
  Eigen::VectorXd traction;  ///< normal (>= 0), then tangential; against the slip where faces slide
  Eigen::VectorXd jump;      ///< opening (>= 0), then slip
};

/// What a pair does; it slides forward where y_t > 0.
enum class PairState { open, stick, forward, backward };

/// Finds x and y = q + M x such that in every pair the normal components are x >= 0, y >= 0, one of
/// the two 0, and of the tangential ones |x_t| <= coefficient * x_n, where y_t is 0 (the faces
/// stick), or x_t = -coefficient * x_n * sign(y_t) (they slide).
///
/// M = base + a change. Where most pairs stick, as those of rock full of closed cracks, the
/// base is factored once, with all its places, and what is open or slides, and the change, are few
/// rows beside it (Woodbury); else the places that are held, each time.
class FrictionalContactSolver {
 public:
  /// M is this from now on.
  void take(Eigen::MatrixXd base);
  /// In place of the last change.
  void change(LowRankChange change);

  Eigen::Index size() const { return base_.rows(); }
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;

  /// By a semi-smooth Newton method, which finds at once which pairs are open, stick and slide
  /// (Alart & Curnier 1991), and by block Gauss-Seidel over the pairs (Jourdan, Alart & Jean 1998)
  /// where that goes in circles; begins from `guess`, by pair, or, where there is none or that
  /// leads nowhere, from the answer without friction. y counts as 0 up to `rounding`, and the limit
  /// as kept up to 1e-9 of it; a pair that does not answer to its own x is left alone. Throws
  /// NoContact where no answer is found, as there may be none, or several, for a large coefficient.
  FrictionalContact solve(const Eigen::VectorXd& q, double coefficient, double rounding,
                          std::span<const PairState> guess = {});

 private:
  class Search;

  double diagonal(Eigen::Index i) const {
    return base_(i, i) + (left_.cols() > 0 ? left_.row(i).dot(change_.right.row(i)) : 0.0);
  }
  Eigen::MatrixXd columns(std::span<const Eigen::Index> places) const;
  const Eigen::MatrixXd& whole();
  void factor();

  Eigen::MatrixXd base_;
  LowRankChange change_;
  Eigen::MatrixXd left_;                         ///< of the change, whole
  Eigen::MatrixXd whole_;                        ///< M, where it was asked for
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;  ///< of the base, likewise
  Eigen::MatrixXd moved_by_basis_;               ///< base^-1 basis, likewise
  Eigen::MatrixXd moved_by_left_;                ///< base^-1 left_, likewise
};

}  // namespace perifrac
