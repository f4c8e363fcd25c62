#pragma once

#include <string>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// What solutions ask of a free fluid.
struct FreeFluid {
  double density;        ///< at zero pressure [kg/m^3]
  double bulk_modulus;   ///< at zero pressure [Pa]
  double tait_exponent;  ///< 1: linear
  double viscosity;      ///< dynamic [Pa s]
  double spacing;        ///< of its points [m]

  /// Pressure [Pa] at rest, at a depth [m] below a surface without pressure; gravity in [m/s^2].
  double pressure_at_rest(double depth, double gravity) const;
};

/// Reads it from the scene.
FreeFluid read_free_fluid(const Section& scene);

/// Size of gravity [m/s^2], which must point straight down. `problem` names what was solved.
double read_weight(const Section& scene, const std::string& problem);

/// A box, low corner and high corner [m].
struct Box {
  std::vector<double> from;
  std::vector<double> to;

  double size(int axis) const { return to[axis] - from[axis]; }
};

/// The box that the section at `path` describes.
Box read_box(const Section& scene, const std::string& path);

/// The one block of fluid that the scene starts with.
Box read_block(const Section& scene, const std::string& problem);

}  // namespace perifrac
