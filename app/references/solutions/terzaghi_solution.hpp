#pragma once

namespace perifrac {

/// Terzaghi's problem for compressible constituents: a poroelastic column of height H on a rigid
/// sealed floor, kept from moving sideways, loaded and drained at its top.
struct TerzaghiProblem {
  double uniaxial_modulus;  ///< lambda + 2 mu, drained [Pa]
  double biot_coefficient;  ///< alpha
  double storage;           ///< at constant strain [1/Pa]
  double mobility;          ///< permeability / viscosity [m^2/(Pa s)]
  double height;            ///< H, from floor to drained top [m]
  double load;              ///< sigma, presses on the top [Pa]
};

/// Its solution: Wang, Theory of Linear Poroelasticity (2000), section 6.2.
class TerzaghiSolution {
 public:
  explicit TerzaghiSolution(const TerzaghiProblem& problem);

  double initial_pressure() const { return initial_pressure_; }        ///< p0, undrained [Pa]
  double consolidation_coefficient() const { return consolidation_; }  ///< c [m^2/s]
  double time_scale() const;                                           ///< H^2 / c [s]
  double drained_strain() const;                                       ///< vertical, negative
  double final_settlement() const;                                     ///< of the top [m]

  /// Pore pressure [Pa] at height z above the floor; p0 at t <= 0.
  double pressure(double z, double t) const;
  /// Vertical displacement [m] at height z, negative downwards; undrained at t <= 0.
  double displacement(double z, double t) const;

 private:
  TerzaghiProblem problem_;
  double consolidation_;
  double initial_pressure_;
};

}  // namespace perifrac
