#pragma once

namespace perifrac {

/// What drives a penny-shaped hydraulic fracture, and what resists.
struct RadialProblem {
  double plane_strain_modulus;  ///< E' = E / (1 - nu^2) [Pa]
  double fracture_energy;       ///< Gc [J/m^2]
  double viscosity;             ///< [Pa s]
  double rate;                  ///< into the whole crack [m^3/s]

  /// K' = 4 (2/pi)^(1/2) K_IC [Pa m^0.5].
  double toughness() const;
  /// K' (t^2 / (mu'^5 Q^3 E'^13))^(1/18), mu' = 12 mu, at t [s]: below 1 viscosity decides, above
  /// 3.5 toughness.
  double dimensionless_toughness(double t) const;
};

/// Such a fracture in an infinite impermeable body, without fluid lag, for any toughness. The
/// opening has the tip's asymptote, carried inwards by a power of the distance from the far edge,
/// and holds what was pumped in (Dontsov 2016, Royal Society Open Science 3:160737). Pressure
/// follows from Poiseuille's law in it; its mean, weighted by the opening of an evenly pressed
/// crack, from the volume (reciprocity). Beside tests/references/penny.py, over all toughness:
/// radius within 0.75 %, opening in the middle 0.5 %, pressure at the source 1.6 %.
class RadialSolution {
 public:
  explicit RadialSolution(const RadialProblem& problem) : problem_(problem) {}

  double radius(double t) const;  ///< at t > 0 [s]; [m]
  /// At r [m] from the inlet [m]; 0 beyond the edge.
  double opening(double r, double t) const;
  /// Less the stress across the crack [Pa]: mean over the disc of radius `source` [m], less than
  /// the crack's, that fluid enters by evenly. At a point it would have no bound.
  double source_pressure(double source, double t) const;

 private:
  /// Opening over that in the middle at x of the radius: (1 + x)^outer (1 - x)^tip.
  struct Shape {
    double radius;  ///< [m]
    double middle;  ///< opening there [m]
    double tip, outer;
    double growth;  ///< the radius goes with this power of time
    double moment;  ///< integral of x times that over 0 < x < 1
  };
  Shape shape_of(double radius, double t) const;
  Shape shape_at(double t) const;

  RadialProblem problem_;
};

}  // namespace perifrac
