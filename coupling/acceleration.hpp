#pragma once

#include <memory>
#include <span>

#include <Eigen/Core>

#include "core/state/state_visitor.hpp"
#include "coupling/coupling_options.hpp"

namespace perifrac {

/// Finds the next input of a fixed point y = answer(y) from the inputs tried so far.
class Acceleration {
 public:
  virtual ~Acceleration() = default;

  /// Forget all: what is asked from now on has nothing to do with what was.
  virtual void reset() = 0;

  /// Another window, whose answers are much like those of the one before.
  virtual void begin_window() { reset(); }

  /// The input to try after `used` was answered with `answer`. Another size starts over.
  /// `scale` makes their entries comparable, and may be another one in each window.
  virtual Eigen::VectorXd next(const Eigen::VectorXd& used, const Eigen::VectorXd& answer,
                               const Eigen::VectorXd& scale) = 0;

  /// Keeps something over windows, and is to be told of points that come.
  virtual bool remembers() const { return false; }
  /// The entries grow in number: those at `kept` of the `size` new ones are the old ones in turn.
  virtual void follow(std::span<const Eigen::Index>, Eigen::Index) {}

  /// What the next window depends on.
  virtual void visit_state(StateVisitor&) {}
};

/// `none` tries the answer itself; `aitken` scales the step by one dynamic factor (Kuettler & Wall
/// 2008, Eq 44); `anderson` takes the combination of the last `depth` steps with the least
/// residual (Walker & Ni 2011); `quasi_newton` does so with the steps of the windows before, too
/// (IQN-ILS with reuse: Degroote, Bathe & Vierendeels 2009).
std::unique_ptr<Acceleration> make_acceleration(AccelerationType type);

inline constexpr int anderson_depth = 5;

}  // namespace perifrac
