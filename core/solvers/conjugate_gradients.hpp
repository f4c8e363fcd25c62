#pragma once

#include <cmath>

#include <Eigen/Core>

#include "core/solvers/not_converged.hpp"

namespace perifrac {

/// Preconditioned conjugate gradients for A x = b, A symmetric and positive definite, known by what
/// it does to a vector. Keeps its vectors from one solution to the next.
class ConjugateGradients {
 public:
  /// Adds to x what takes its residual b - A x below `target`; `apply(u, image)` makes A u, and
  /// `precondition(residual, correction)` what is near to A^-1 of it. Returns the iterations that
  /// took. Throws NotConverged after `most`.
  template <class Apply, class Precondition>
  int correct(Eigen::VectorXd& residual, Eigen::VectorXd& x, double target, int most, Apply&& apply,
              Precondition&& precondition) {
    correction_.resize(residual.size());
    image_.resize(residual.size());
    const double start = residual.norm();
    double square = 0.0;
    for (int k = 0;; ++k) {
      const double left = residual.norm();
      if (left <= target) return k;
      if (!std::isfinite(left) || k == most) throw NotConverged(k, left / start);
      precondition(residual, correction_);
      const double next = residual.dot(correction_);
      if (k == 0) {
        direction_ = correction_;
      } else {
        direction_ = correction_ + next / square * direction_;
      }
      square = next;
      apply(direction_, image_);
      const double step = square / direction_.dot(image_);
      x += step * direction_;
      residual -= step * image_;
    }
  }

 private:
  Eigen::VectorXd correction_, direction_, image_;
};

}  // namespace perifrac
