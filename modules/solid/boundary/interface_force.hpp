#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/module/port.hpp"
#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// The force on the points that another module gives as an impulse over each window [N s]: steady
/// within it. In a window of no length the last force stays.
class InterfaceForce {
 public:
  static Port port(int dimension) {
    return {"interface_impulse", unit_of_total("N s", dimension),
            PortDirection::in,   PortKind::extensive,
            PortRole::field,     dimension};
  }

  void connect(std::size_t size) { impulse_.resize(size); }
  /// The input, empty until it is connected.
  std::span<double> impulse() { return impulse_; }
  bool is_linked() const { return !impulse_.empty(); }

  void begin(const TimeWindow& window) {
    if (!(window.length() > 0.0)) return;
    force_.resize(impulse_.size());
    for (std::size_t k = 0; k < force_.size(); ++k) force_[k] = impulse_[k] / window.length();
  }

  /// On the points, D blocks [N, per metre in 2D]; empty: none.
  std::span<const double> force() const { return force_; }

  void visit_state(StateVisitor& visitor) { visitor.visit("interface_force", force_); }

 private:
  std::vector<double> impulse_;
  std::vector<double> force_;
};

}  // namespace perifrac
