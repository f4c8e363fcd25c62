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
  /// `acted_on`: the unknowns on which a force may be other than 0.
  void start(std::vector<Index> acted_on) {
    acted_on_ = std::move(acted_on);
    force_.assign(acted_on_.size(), 0.0);
    before_.assign(acted_on_.size(), 0.0);
    sum_ = 0.0;
  }

  /// Displacements that change next.
  void leave(std::span<const double> unknowns) {
    for_each_entry(static_cast<Index>(acted_on_.size()),
                   [&](Index n) { before_[n] = unknowns[acted_on_[n]]; });
  }
  /// What they have become; force_on(k) is what acts there now [N].
  template <class ForceOn>
  void book(std::span<const double> unknowns, ForceOn&& force_on) {
    sum_ += block_sum(static_cast<Index>(acted_on_.size()), block_sums_, [&](Index n) {
      const Index k = acted_on_[n];
      const double force = force_on(k);
      const double work = 0.5 * (force_[n] + force) * (unknowns[k] - before_[n]);
      force_[n] = force;
      return work;
    });
  }

  double sum() const { return sum_; }  ///< since the start

  void visit_state(StateVisitor& visitor) {
    visitor.visit("acting_force", force_);
    visitor.visit("external_work", sum_);
  }

 private:
  std::vector<Index> acted_on_;
  std::vector<double> force_;   ///< on them, reactions included [N]
  std::vector<double> before_;  ///< workspace: their displacements [m]
  double sum_ = 0.0;
  std::vector<double> block_sums_;
};

}  // namespace perifrac
