#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/module/time_window.hpp"
#include "core/time/ode_system.hpp"
#include "modules/pore_flow/flow_operator.hpp"
#include "modules/pore_flow/held_point.hpp"
#include "modules/pore_flow/pore_material.hpp"
#include "modules/pore_flow/pressure_smoothing.hpp"

namespace perifrac {

/// The dilatation that pore flow is told for a window: at time t and pore stress x it is
/// value + rate (t - end) + slope x. Empty spans: no dilatation at all.
struct DilatationInput {
  std::span<const double> value{};
  std::span<const double> rate{};
  std::span<const double> slope{};
  double end = 0.0;
};

/// Conservation of pore fluid as ordinary differential equations:
///   d(zeta_i)/dt = (q_i - (H p)_i) / V_i,   zeta = alpha theta + S p,
/// with q the sources and H twice the dissipation's derivative. zeta is the fluid volume gained per
/// volume of rock; it, not pressure, is what is stored, so that a corrected dilatation changes the
/// pressure and never the mass.
///
/// A held point has its face value's pressure at every moment, whatever its zeta. That follows at
/// a steady rate within a window, to be alpha theta + S p at the end; what it takes, and what flows
/// off into the rock, is inflow through the face.
///
/// Unknowns: zeta at the points; then what accumulates: volume that came in through each face of
/// prescribed pressure, energy dissipated by the flow, energy brought by sources (if any), volume
/// that smoothing made (if it is on).
template <int D>
class DarcySystem final : public OdeSystem {
 public:
  DarcySystem(std::unique_ptr<FlowOperator<D>> flow, PoreMaterial material,
              Eigen::VectorXd face_pressures, Eigen::VectorXd sources,
              std::vector<HeldPoint> held = {});

  std::string_view name() const override { return "fluid_content"; }
  std::size_t size() const override { return points_ + accumulators(); }
  std::string place(std::size_t unknown) const override;
  std::size_t accumulators() const override {
    return face_pressures_.size() + (sources_.size() > 0 ? 2 : 1) + (smoothing_ ? 1 : 0);
  }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) override;
  void jacobian_times(double t, std::span<const double> y, std::span<const double> v,
                      std::span<double> product) override;
  std::uint64_t jacobian_version() const override { return version_; }
  void magnitudes(double t, std::span<const double> y, std::span<double> magnitude) override;

  /// Takes the input of the next window; spans must stay valid while it is integrated.
  void set_dilatation(const DilatationInput& input);

  /// Takes y at the window's beginning, after its dilatation: the rates of held points follow.
  void lead_held_points(const TimeWindow& window, std::span<const double> y);

  /// Smooths the pressures of all later steps, except of held points.
  void set_smoothing(PressureSmoothing<D> smoothing);
  bool smooths() const { return smoothing_.has_value(); }
  /// Smooths them once; what that makes of fluid is the last accumulator's (paper Eq 14, last
  /// term).
  void smooth(double t, std::span<double> y);

  /// Pressure at the points [Pa].
  void pressure(double t, std::span<const double> y, std::span<double> p) const;

  /// Darcy velocity of the point pressures p, D blocks of point values [m/s].
  void darcy_velocity(std::span<const double> p, std::span<double> velocity);

  Index points() const { return points_; }
  const std::vector<double>& volume() const { return flow_->family().volume; }
  /// d(zeta)/dp with the dilatation's answer [1/Pa], per point.
  const std::vector<double>& effective_storage() const { return effective_storage_; }
  const FlowOperator<D>& flow() const { return *flow_; }
  const PoreMaterial& material() const { return material_; }
  const Eigen::VectorXd& face_pressures() const { return face_pressures_; }
  const Eigen::VectorXd& sources() const { return sources_; }
  std::span<const HeldPoint> held_points() const { return held_; }
  double held_pressure(const HeldPoint& held) const {
    return held.face_value < 0 ? 0.0 : face_pressures_[held.face_value];
  }

 private:
  /// Face values that the flow operator knows; those of layers follow.
  Index mirrored_faces() const { return flow_->size() - points_; }
  /// alpha times the dilatation at no pore stress.
  double dilated(double t, Index i) const;

  std::unique_ptr<FlowOperator<D>> flow_;
  PoreMaterial material_;
  Eigen::VectorXd face_pressures_;
  Eigen::VectorXd sources_;  ///< empty where there are none
  std::vector<HeldPoint> held_;
  std::vector<double> held_rate_;  ///< d(zeta)/dt of the held points in this window [1/s]
  Index points_;
  DilatationInput dilatation_;
  std::vector<double> effective_storage_;
  std::uint64_t version_ = 0;
  std::vector<double> pressure_;  ///< workspace: points, then face values
  std::vector<double> outflow_;   ///< workspace: H p
  std::optional<PressureSmoothing<D>> smoothing_;
  std::vector<double> smoothed_;  ///< workspace: by its points
};

}  // namespace perifrac
