#pragma once

#include <span>
#include <vector>

#include "core/base/block_sum.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// What external forces do on a body that moves, trapezoidal in time: the work that velocity
/// Verlet's energy answers to [J, per metre in 2D].
class ExternalWork {
 public:
  void start(std::size_t unknowns) {
    force_.assign(unknowns, 0.0);
    sum_ = 0.0;
  }
  /// The unknowns on which a force may be other than 0.
  void set_acted_on(std::vector<Index> unknowns) { acted_on_ = std::move(unknowns); }

  /// From one set of displacements to the next; force_on(k) is what acts there now [N].
  template <class ForceOn>
  void book(std::span<const double> before, std::span<const double> now, ForceOn&& force_on) {
    sum_ += block_sum(static_cast<Index>(acted_on_.size()), block_sums_, [&](Index n) {
      const Index k = acted_on_[n];
      const double force = force_on(k);
      const double work = 0.5 * (force_[k] + force) * (now[k] - before[k]);
      force_[k] = force;
      return work;
    });
  }

  double sum() const { return sum_; }  ///< since the start

  void visit_state(StateVisitor& visitor) {
    visitor.visit("external_force", force_);
    visitor.visit("external_work", sum_);
  }

 private:
  std::vector<double> force_;  ///< on every unknown, reactions included
  std::vector<Index> acted_on_;
  double sum_ = 0.0;
  std::vector<double> block_sums_;
};

}  // namespace perifrac
