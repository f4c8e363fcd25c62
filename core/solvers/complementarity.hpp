#pragma once

#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Dense>

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

/// Solves such problems, one like the other: each begins from the places that the last one held,
/// whose block of M is factored once while both stay.
class ComplementaritySolver {
 public:
  /// The next problem begins from these places; none: from no place held.
  void begin_from(std::vector<bool> held = {}) { held_ = std::move(held); }

  /// For M with positive principal minors, by block principal pivoting (Judice & Pires 1994). y
  /// counts as 0 up to `rounding`; a place that does not answer to its own x, as a facet of given
  /// width, is left alone. Throws NoContact where M is no such matrix.
  Complementarity solve(const Eigen::Ref<const Eigen::MatrixXd>& m, const Eigen::VectorXd& q,
                        double rounding);

  /// d(y)/d(z) of the last problem where q = q0 + A z, while the same places are held.
  Eigen::MatrixXd response(const Eigen::Ref<const Eigen::MatrixXd>& m, Eigen::MatrixXd a);

 private:
  void find_values(const Eigen::Ref<const Eigen::MatrixXd>& m, const Eigen::VectorXd& q,
                   Complementarity& answer);
  const Eigen::PartialPivLU<Eigen::MatrixXd>& factor(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                                     const std::vector<int>& places);

  std::vector<bool> held_;  ///< by the last answer
  Eigen::MatrixXd block_;   ///< of M, that is factored
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

/// Solves one alone.
Complementarity solve_complementarity(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                      const Eigen::VectorXd& q, double rounding);

}  // namespace perifrac
