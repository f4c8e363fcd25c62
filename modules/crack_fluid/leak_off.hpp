#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "core/base/point_set.hpp"
#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/crack_fluid/crack_graph.hpp"

namespace perifrac {

/// What leaves the facets over a step [kg], in 2D per metre, and how that follows their pressures
/// and fills.
struct LeakedFluid {
  Eigen::VectorXd mass;
  Eigen::VectorXd by_fill;
  std::vector<Eigen::Triplet<double>> by_pressure;
};

/// How fluid passes from a crack into the rock.
class LeakOff {
 public:
  virtual ~LeakOff() = default;
  /// The fluid is gone, as far as the run is concerned.
  virtual bool is_sink() const = 0;
  /// Carter's C_L of one side, as tips feel it [m/s^0.5]; 0 where there is none.
  virtual double coefficient(Index /*facet*/) const { return 0.0; }
  /// Follows the facets; `graph` must last.
  virtual void match(const PointSet& facets, const CrackGraph& graph) = 0;
  /// How much of every facet is crack at the end of the window; lasts as long as that.
  void take_part(std::span<const double> part) { part_ = part; }
  virtual void begin_window(const TimeWindow&) {}
  /// `fill`: of the facets at the step's begin.
  virtual void begin(const TimeWindow& step, std::span<const double> fill) = 0;
  /// Over the step that has begun, by what the facets hold at its end. Appends to by_pressure.
  virtual void evaluate(const Eigen::VectorXd& pressure, const Eigen::VectorXd& fill,
                        LeakedFluid& leaked) = 0;
  /// The step that has begun stands as it was last evaluated; `fill`: of the facets now.
  /// Returns the energy that the leaked fluid still has [J].
  virtual double accept(std::span<const double> fill) = 0;
  virtual void visit_state(StateVisitor& visitor) = 0;

 protected:
  double part(Index facet) const {
    return part_.empty() ? 1.0 : part_[static_cast<std::size_t>(facet)];
  }

 private:
  std::span<const double> part_;
};

}  // namespace perifrac
