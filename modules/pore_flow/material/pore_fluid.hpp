#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Fluid in the pores. Linear: its compressibility counts as storage and its density is constant.
/// Tait (the paper's section 2.2): p = K_f / gamma [(rho / rho_0)^gamma - 1].
struct PoreFluid {
  double bulk_modulus;         ///< K_f, at zero pressure [Pa]
  double viscosity;            ///< [Pa s]
  double density;              ///< rho_0, at zero pressure [kg/m^3]
  double tait_exponent = 0.0;  ///< gamma > 1; 0: linear

  bool is_linear() const { return tait_exponent == 0.0; }

  /// rho / rho_0 at pressure p; not a number where p tears the fluid.
  double density_ratio(double p) const;

  /// What drives the flow, the energy that fluid at pressure p brings with it, per volume that it
  /// takes at zero pressure: the integral of rho_0 / rho dp [Pa]. The pressure itself if linear.
  double potential(double p) const;
  /// The pressure of a potential [Pa].
  double pressure_of(double potential) const;
};

/// The keys of `fluid` in the section of pore flow.
KeyTable pore_fluid_keys();

/// Reads them; throws InputError.
PoreFluid read_pore_fluid(const Section& section);

}  // namespace perifrac
