#pragma once

#include <cmath>

namespace perifrac {

/// Cross-section of Timoshenko's beam in plane strain, per metre of thickness.
struct BeamSection {
  double bending;  ///< E/(1 - nu^2) h^3/12 [N m]
  double shear;    ///< 5/6 G h [N/m]

  BeamSection(double youngs_modulus, double poisson_ratio, double height)
      : bending(youngs_modulus / (1.0 - poisson_ratio * poisson_ratio) * std::pow(height, 3) /
                12.0),
        shear(5.0 / 6.0 * youngs_modulus / (2.0 * (1.0 + poisson_ratio)) * height) {}

  /// Deflection [m] in the middle of a beam of this length [m], clamped at both ends, under a
  /// uniform load [Pa].
  double clamped_deflection(double length, double load) const {
    return load * std::pow(length, 4) / (384.0 * bending) + load * length * length / (8.0 * shear);
  }
};

}  // namespace perifrac
