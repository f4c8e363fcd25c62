#pragma once

#include <span>

#include <Eigen/Core>

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
/// By a semi-smooth Newton method, which finds at once which pairs are open, stick and slide (Alart
/// & Curnier 1991), and by block Gauss-Seidel over the pairs (Jourdan, Alart & Jean 1998) where
/// that goes in circles; begins from `guess`, by pair, or, where there is none or that leads
/// nowhere, from the answer without friction. y counts as 0 up to `rounding`,
/// and the limit as kept up to 1e-9 of it; a pair that does not answer to its own x is left alone.
/// Throws std::runtime_error where no answer is found, as there may be none, or several, for a
/// large coefficient.
FrictionalContact solve_frictional_contact(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                           double coefficient, double rounding,
                                           std::span<const PairState> guess = {});

}  // namespace perifrac
