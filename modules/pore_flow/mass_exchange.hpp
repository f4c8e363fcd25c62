#pragma once

#include <span>
#include <vector>

#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Fluid that another module hands over to the points within a window (negative: takes away), at a
/// steady rate. An integrator of single steps takes that as a source. A multistep one would smear
/// the jumps of the rate over several windows: there the fluid is kept beside the unknowns y, the
/// fluid content is y plus what was handed over, and not a drop depends on how y is integrated.
class MassExchange {
 public:
  enum class Way { by_rate, beside };

  void connect(std::size_t points) { mass_.resize(points); }
  bool is_linked() const { return !mass_.empty(); }
  /// The input: of every point over the next window [kg, per metre in 2D]; empty until connected.
  std::span<double> mass() { return mass_; }

  /// A window begins; volumes and density [kg/m^3] make fluid content of mass.
  void begin(const TimeWindow& window, Way way, const std::vector<double>& volume, double density);
  /// It has ended; `energy` came with the fluid [J].
  void end(double energy);

  /// Handed over to every point in this window, per volume of rock; empty before any.
  std::span<const double> added() const { return added_; }
  /// Of which a source that the equations must have [1/s], and what is kept beside.
  double rate(std::size_t i) const { return way_ == Way::by_rate ? added_[i] / length_ : 0.0; }
  double added_beside(std::size_t i) const { return way_ == Way::beside ? added_[i] : 0.0; }
  bool has_rate() const { return way_ == Way::by_rate && !added_.empty(); }

  /// There is fluid beside y.
  bool is_beside() const { return !content_.empty(); }
  /// y and what was handed over until t [s], at the points. Valid until the next call.
  std::span<const double> content(double t, std::span<const double> y);
  /// Makes it part of y, where an integrator starts anew.
  void merge_into(std::span<double> y);

  double energy() const { return energy_.empty() ? 0.0 : energy_[0]; }  ///< since the start [J]

  void visit_state(StateVisitor& visitor);
  void on_restored() { added_.assign(content_.size(), 0.0); }

 private:
  Way way_ = Way::beside;
  std::vector<double> mass_;     ///< input
  std::vector<double> added_;    ///< in this window; 0 between windows
  std::vector<double> content_;  ///< beside y, of earlier windows; empty where it goes by rate
  std::vector<double> energy_;   ///< one value once there was a window
  double begin_ = 0.0;           ///< [s]
  double length_ = 1.0;          ///< [s]
  std::vector<double> sum_;      ///< workspace: content()
};

}  // namespace perifrac
