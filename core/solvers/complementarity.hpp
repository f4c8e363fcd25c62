#pragma once

#include <stdexcept>
#include <vector>

#include <Eigen/Core>

namespace perifrac {

/// Faces that touch and slide are in no balance that was found.
class NoContact : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What keeps y from falling below zero: x >= 0, y = q + M x >= 0, and one of the two is 0 at every
/// place. Faces of a crack that close are such: y their opening, x the pressure of contact.
struct Complementarity {
  Eigen::VectorXd x;
  Eigen::VectorXd y;
  std::vector<bool> held;  ///< where y is 0 and x may be more
};

/// Solves it, for M with positive principal minors, by block principal pivoting (Judice & Pires
/// 1994). y counts as 0 up to `rounding`; a place that does not answer to its own x, as a facet of
/// given width, is left alone. Throws NoContact where M is no such matrix.
Complementarity solve_complementarity(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                      const Eigen::VectorXd& q, double rounding);

/// d(y)/d(z) for q = q0 + M z, while the same places are held.
Eigen::MatrixXd response_with_held(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                   const std::vector<bool>& held);

}  // namespace perifrac
