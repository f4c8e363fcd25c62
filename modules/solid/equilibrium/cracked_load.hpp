#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/body/body.hpp"
#include "core/module/port_table.hpp"
#include "core/time/scheduled_vector.hpp"
#include "modules/solid/boundary/interface_force.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"

namespace perifrac {

/// What presses and pulls on a body in equilibrium, the faces of its cracks apart: loads and
/// prescribed displacements by their schedules, the pore stress beyond that at rest, and the force
/// of other modules.
template <int D>
class CrackedLoad {
 public:
  /// `cracked` has the cracks of the start.
  CrackedLoad(std::shared_ptr<const Body<D>> body, std::shared_ptr<BreakableElasticity<D>> elastic,
              const CutBody<D>& cracked, const SolidBoundary<D>& boundary,
              const MirrorCondition<D, D>& mirror);

  /// In-ports `pore_stress` and `interface_impulse`.
  void add_ports(PortTable& ports);
  const Points<D>& points() const { return body_->points(); }
  /// What of the pore stress does not load the rock, by point; empty: nothing.
  void set_pore_stress_at_rest(std::vector<double> stress) { at_rest_ = std::move(stress); }

  void begin(const TimeWindow& window) { interface_.begin(window); }
  /// Nothing but the faces' pressure ever changes: then displacements are found only when asked
  /// for.
  bool is_steady() const {
    return is_steady_by_itself_ && pore_stress_.empty() && !interface_.is_linked();
  }
  /// Some displacement other than 0 is.
  bool prescribes() const { return prescribes_; }
  /// Displacements, 0 where none is [m].
  Eigen::VectorXd prescribed(double t) const { return prescribed_.at(t); }
  /// On every unknown, what prescribed displacements do to the rest included [N].
  Eigen::VectorXd force(double t);

  /// By point; empty where no pore flow is simulated [Pa].
  std::span<const double> pore_stress() const { return pore_stress_; }
  std::span<const double> pore_stress_at_rest() const { return at_rest_; }
  /// The part that loads the rock; valid until the next call.
  std::span<const double> added_pore_stress();

  void visit_state(StateVisitor& visitor);

 private:
  std::shared_ptr<const Body<D>> body_;
  std::shared_ptr<BreakableElasticity<D>> elastic_;
  ScheduledVector prescribed_;
  ScheduledVector load_;
  bool prescribes_;
  bool is_steady_by_itself_;
  std::vector<double> pore_stress_;  ///< input; empty until it is connected
  std::vector<double> at_rest_;
  std::vector<double> added_;  ///< pore stress beyond that at rest, where there is any
  InterfaceForce interface_;
};

}  // namespace perifrac
