#pragma once

#include <array>
#include <vector>

namespace perifrac {

/// One layer of a column that consolidates upwards.
struct ColumnLayer {
  double thickness;         ///< [m]
  double uniaxial_modulus;  ///< lambda + 2 mu, drained [Pa]
  double biot_coefficient;
  double storage;   ///< at constant strain [1/Pa]
  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]
};

/// Consolidation of two layers on a rigid sealed floor under a load on the drained top: pressure
/// and flux are continuous between them. Eigenfunctions, as Carslaw and Jaeger, Conduction of Heat
/// in Solids, section 12.8, take them for a composite slab.
class LayeredColumnSolution {
 public:
  /// `lower` lies on the floor; `load` [Pa] presses on the top.
  LayeredColumnSolution(const ColumnLayer& lower, const ColumnLayer& upper, double load);

  /// Undrained pressure of a layer, 0 the lower [Pa].
  double initial_pressure(int layer) const { return initial_pressure_[layer]; }
  double time_scale() const { return 1.0 / (rate_[0] * rate_[0]); }  ///< of the slowest mode [s]
  /// Vertical, of the lower layer; negative.
  double drained_strain() const { return -load_ / layer_[0].uniaxial_modulus; }
  double final_settlement() const { return -drained_displacement(height()); }  ///< [m]

  /// Pore pressure [Pa] at height z above the floor; undrained at t <= 0.
  double pressure(double z, double t) const;
  /// Vertical displacement [m] at height z, negative downwards.
  double displacement(double z, double t) const;

 private:
  double height() const { return layer_[0].thickness + layer_[1].thickness; }
  double drained_displacement(double z) const;
  double frequency_condition(double rate) const;
  void add_mode(double rate);

  std::array<ColumnLayer, 2> layer_;
  double load_;
  std::array<double, 2> capacity_;          ///< storage at constant load [1/Pa]
  std::array<double, 2> root_diffusivity_;  ///< sqrt(c) [m/s^(1/2)]
  std::array<double, 2> initial_pressure_;
  std::vector<double> rate_;                      ///< s of a mode that decays as exp(-s^2 t)
  std::vector<std::array<double, 2>> amplitude_;  ///< of a mode in each layer [Pa]
};

}  // namespace perifrac
