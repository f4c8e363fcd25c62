#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/time/ode_system.hpp"
#include "modules/pore_flow/flow_operator.hpp"
#include "modules/pore_flow/pore_material.hpp"

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
/// Unknowns: zeta at the points; then what accumulates: volume that came in through each face of
/// prescribed pressure, energy dissipated by the flow, energy brought by sources (if any).
template <int D>
class DarcySystem final : public OdeSystem {
 public:
  DarcySystem(std::unique_ptr<FlowOperator<D>> flow, PoreMaterial material,
              Eigen::VectorXd face_pressures, Eigen::VectorXd sources);

  std::string_view name() const override { return "fluid_content"; }
  std::size_t size() const override { return points_ + accumulators(); }
  std::string place(std::size_t unknown) const override;
  std::size_t accumulators() const override {
    return face_pressures_.size() + (sources_.size() > 0 ? 2 : 1);
  }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) override;
  void jacobian_times(double t, std::span<const double> y, std::span<const double> v,
                      std::span<double> product) override;
  std::uint64_t jacobian_version() const override { return version_; }
  void magnitudes(double t, std::span<const double> y, std::span<double> magnitude) override;

  /// Takes the input of the next window; spans must stay valid while it is integrated.
  void set_dilatation(const DilatationInput& input);

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

 private:
  std::unique_ptr<FlowOperator<D>> flow_;
  PoreMaterial material_;
  Eigen::VectorXd face_pressures_;
  Eigen::VectorXd sources_;  ///< empty where there are none
  Index points_;
  DilatationInput dilatation_;
  std::vector<double> effective_storage_;
  std::uint64_t version_ = 0;
  std::vector<double> pressure_;  ///< workspace: points, then face values
  std::vector<double> outflow_;   ///< workspace: H p
};

}  // namespace perifrac
