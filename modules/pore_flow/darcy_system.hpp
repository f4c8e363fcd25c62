#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/bonds/bond_state.hpp"
#include "core/module/time_window.hpp"
#include "core/time/ode_system.hpp"
#include "core/time/scheduled_vector.hpp"
#include "modules/pore_flow/as_published/pressure_smoothing.hpp"
#include "modules/pore_flow/boundary/flow_drive.hpp"
#include "modules/pore_flow/boundary/held_point.hpp"
#include "modules/pore_flow/flux/flow_operator.hpp"
#include "modules/pore_flow/mass_exchange.hpp"
#include "modules/pore_flow/storage/pore_storage.hpp"

namespace perifrac {

/// Conservation of pore fluid as ordinary differential equations:
///   d(zeta_i)/dt = (q_i - (H psi)_i) / V_i,   psi = potential(p) - rho_0 g.x,
/// with q the sources, H twice the dissipation's derivative and p from zeta by the PoreStorage. For
/// a linear fluid without gravity psi is p. For a compressible one H has the mobility times
/// (rho/rho_0)^2, which makes H psi the mass flux of Darcy's law over rho_0. zeta is the fluid
/// gained per volume of rock; it, not pressure, is what is stored, so that a corrected dilatation
/// changes the pressure and never the mass.
///
/// A held point has the potential of its face value at every moment, whatever its zeta. That
/// follows at a steady rate within a window, to be what belongs to its pressure at the end; what it
/// takes, and what flows off into the rock, is inflow through the face.
///
/// Unknowns: zeta at the points, what other modules handed over apart; then what accumulates:
/// volume that came in through each face of prescribed pressure, energy dissipated by the flow,
/// energy brought by sources and by faces whose pressure changes (if any), volume brought by
/// sources that change (if any), volume that smoothing made (if it is on). Volumes are at zero
/// pressure.
template <int D>
class DarcySystem final : public OdeSystem {
 public:
  /// `sources` of size 0 where there are none; `gravity`: -rho_0 g.x of points, then of face values
  /// [Pa], empty without.
  DarcySystem(std::unique_ptr<FlowOperator<D>> flow, std::unique_ptr<PoreStorage> storage,
              PoreFluid fluid, ScheduledVector face_pressures, ScheduledVector sources,
              Eigen::VectorXd gravity = {}, std::vector<HeldPoint> held = {});

  std::string_view name() const override { return "fluid_content"; }
  std::size_t size() const override { return points_ + accumulators(); }
  std::string place(std::size_t unknown) const override;
  std::size_t accumulators() const override {
    return drive_.faces() + 1 + (brings_energy() ? 1 : 0) + (brings_volume() ? 1 : 0) +
           (smooths() ? 1 : 0);
  }
  void rhs(double t, std::span<const double> y, std::span<double> dydt) override;
  void jacobian_times(double t, std::span<const double> y, std::span<const double> v,
                      std::span<double> product) override;
  std::uint64_t jacobian_version() const override { return version_; }
  double fastest_rate(double t) override;
  double jacobian_growth(double t, std::span<const double> y) override;
  bool is_answered_late() const override { return is_answered_late_; }
  void magnitudes(double t, std::span<const double> y, std::span<double> magnitude) override;

  /// Takes the input of the next window; spans must stay valid while it is integrated.
  void set_dilatation(const DilatationInput& input);
  /// Asked by choose_storage() until it makes one.
  void let_storage_be_chosen(StorageChoice choice) { choice_ = std::move(choice); }
  /// Takes the storage that suits a dilatation of this slope; true where it is another now.
  bool choose_storage(std::span<const double> slope);

  /// Takes the bonds that broke in the body, or mended as a state was restored, out of the flow;
  /// true where any did.
  bool follow(const BondState<D>& bonds);
  /// Of the bonds that flow follows: H is another matrix where it is another.
  std::uint64_t bond_version() const { return bond_version_; }
  /// Rises where H, or which points storage ties to each other, changes.
  std::uint64_t pattern_version() const { return pattern_version_; }

  /// What other modules hand over within windows.
  MassExchange& exchange() { return exchange_; }
  /// zeta at the points. Valid until the next call.
  std::span<const double> fluid_content(double t, std::span<const double> y);
  /// Energy that comes with the fluid handed over in this window, at these pressures [J].
  double exchanged_energy(std::span<const double> p) const;

  /// Takes y at the window's beginning, after its dilatation: the rates of held points follow.
  void lead_held_points(const TimeWindow& window, std::span<const double> y);

  /// Smooths the potentials of all later steps, except of held points: pressures without gravity.
  void set_smoothing(PressureSmoothing<D> smoothing);
  bool smooths() const { return smoothing_.has_value(); }
  /// Smooths them once; what that makes of fluid is the last accumulator's (paper Eq 14, last
  /// term).
  void smooth(double t, std::span<double> y);

  /// Pressure at the points [Pa].
  void pressure(double t, std::span<const double> y, std::span<double> p);

  /// Darcy velocity of the point pressures p at time t, D blocks of point values [m/s].
  void darcy_velocity(double t, std::span<const double> p, std::span<double> velocity);

  /// Where schedules change their rate, rising [s]: integrate up to them and start anew.
  const std::vector<double>& break_points() const { return drive_.break_points(); }

  /// An integrator starts anew: takes out of y what only added up, so that it stays small beside
  /// its own rounding, and puts in what was handed over.
  void renew(std::span<double> y);
  void start() { std::ranges::fill(taken_out_, 0.0); }
  void visit_state(StateVisitor& visitor);
  /// How the flow goes over the bonds.
  std::string path() const { return flow_->path(); }

  /// What came in since `start` by faces and sources: volume at zero pressure, and energy [J].
  double gained_volume(double start, double t, std::span<const double> y) const;
  double gained_energy(std::span<const double> y) const;
  double dissipated_energy(std::span<const double> y) const { return accumulated(y, faces()); }
  /// What smoothing made, volume at zero pressure.
  double artificial_volume(std::span<const double> y) const {
    return accumulated(y, accumulators() - 1);
  }
  /// Energy of fluid and pores at the fluid content zeta, that of the fluid's height included [J].
  double stored_energy(std::span<const double> zeta, std::span<const double> p) const;

  std::span<const HeldPoint> held_points() const { return held_; }
  /// Of a held point at time t [Pa].
  double held_pressure(double t, const HeldPoint& held);

  Index points() const { return points_; }
  const std::vector<double>& volume() const { return flow_->volume(); }
  /// d(zeta)/d(psi) with the dilatation's answer [1/Pa], per point; of the rock at rest where y is
  /// empty. Valid until the next call.
  std::span<const double> effective_storage(double t, std::span<const double> y);
  double biot_coefficient(Index i) const { return storage_->materials().at(i).biot_coefficient; }
  PoreStorage& storage() const { return *storage_; }
  /// Makes room for, and adds, volume times d(zeta)/d(psi), as a matrix on points; y as above.
  void add_storage_pattern_to(Eigen::SparseMatrix<double>& matrix) const {
    storage_->add_pattern_to(matrix);
  }
  void add_storage_to(Eigen::SparseMatrix<double>& matrix, double t, std::span<const double> y) {
    storage_->add_to(matrix, t, y.empty() ? y : fluid_content(t, y), volume());
  }
  const FlowOperator<D>& flow() const { return *flow_; }
  const PoreFluid& fluid() const { return fluid_; }
  /// -rho_0 g.x of point i [Pa].
  double gravity(Index i) const { return gravity_.size() > 0 ? gravity_[i] : 0.0; }

 private:
  /// Face values that the flow operator knows; those of layers follow.
  Index mirrored_faces() const { return flow_->size() - points_; }
  Index faces() const { return static_cast<Index>(face_potential_.size()); }
  bool brings_energy() const { return drive_.has_sources() || drive_.pressures_change(); }
  bool brings_volume() const { return drive_.sources_change(); }
  double accumulated(std::span<const double> y, std::size_t k) const {
    return taken_out_[2 * k] + (taken_out_[2 * k + 1] + y[points_ + k]);
  }
  void find_face_potential(double t);
  void scale_mobility(std::span<const double> p);
  void pressure_to_potential(double t);

  std::unique_ptr<FlowOperator<D>> flow_;
  std::unique_ptr<PoreStorage> storage_;
  StorageChoice choice_;
  PoreFluid fluid_;
  FlowDrive drive_;
  Eigen::VectorXd gravity_;
  std::vector<HeldPoint> held_;
  std::vector<double> held_rate_;  ///< dy/dt of the held points in this window [1/s]
  MassExchange exchange_;
  std::vector<double> taken_out_;  ///< of each accumulator: a sum, and what rounding cuts off it
  Index points_;
  std::uint64_t version_ = 0;
  bool is_answered_late_ = false;
  Eigen::VectorXd face_potential_;
  std::vector<double> potential_;  ///< workspace: pressures, then psi, of points and face values
  std::vector<double> outflow_;    ///< workspace: H psi
  std::vector<double> mobility_;   ///< (rho/rho_0)^2; empty for a linear fluid
  std::optional<PressureSmoothing<D>> smoothing_;
  std::uint64_t pattern_version_ = 1;
  std::uint64_t bond_version_ = 0;
};

}  // namespace perifrac
