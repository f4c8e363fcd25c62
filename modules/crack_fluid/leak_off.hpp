#pragma once

#include <span>

#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/crack_fluid/crack_graph.hpp"

namespace perifrac {

/// What leaves a facet over a step [kg/m], and how that follows its pressure [Pa] and fill.
struct Leak {
  double mass = 0.0;
  double by_pressure = 0.0;
  double by_fill = 0.0;
};

/// How fluid passes from a crack into the rock.
class LeakOff {
 public:
  virtual ~LeakOff() = default;
  /// Follows the facets; `graph` must last.
  virtual void match(const CrackGraph& graph) = 0;
  virtual void begin(const TimeWindow& step) = 0;
  /// Over the step that has begun, at what the facet holds at its end.
  virtual Leak leak(Index facet, double pressure, double fill) const = 0;
  /// The step that has begun stands, and facets hold these masses [kg/m].
  virtual void accept(std::span<const double> mass) = 0;
  virtual void visit_state(StateVisitor& visitor) = 0;
};

}  // namespace perifrac
