#pragma once

#include <memory>

#include <Eigen/Core>

#include "coupling/coupling_options.hpp"

namespace perifrac {

/// Finds the next input of a fixed point y = answer(y) from the inputs tried so far.
class Acceleration {
 public:
  virtual ~Acceleration() = default;

  /// Forget the past: another window begins.
  virtual void reset() = 0;

  /// The input to try after `used` was answered with `answer`; all of one size since reset().
  virtual Eigen::VectorXd next(const Eigen::VectorXd& used, const Eigen::VectorXd& answer) = 0;
};

/// `none` tries the answer itself; `aitken` scales the step by one dynamic factor (Kuettler & Wall
/// 2008, Eq 44); `anderson` takes the combination of the last `depth` steps with the least
/// residual (Walker & Ni 2011).
std::unique_ptr<Acceleration> make_acceleration(AccelerationType type);

inline constexpr int anderson_depth = 5;

}  // namespace perifrac
