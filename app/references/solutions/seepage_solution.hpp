#pragma once

#include "core/time/schedule.hpp"

namespace perifrac {

/// A porous slab between a face at no pressure, z = 0, and water that presses on the other, z = L.
struct SeepageProblem {
  double length;    ///< L [m]
  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]
  double storage;   ///< at constant strain [1/Pa]
  double pressure;  ///< of the water, times the factor of `schedule` [Pa]
  Schedule schedule;
  double initial_pressure = 0.0;  ///< at z = L, falling evenly to 0 at z = 0 [Pa]
};

/// Diffusion of the water's pressure into the slab. What changes with time follows from the answers
/// to a step and to a ramp (Duhamel): a schedule is made of both.
class SeepageSolution {
 public:
  explicit SeepageSolution(const SeepageProblem& problem) : problem_(problem) {}

  double time_scale() const;   ///< L^2 / c [s]
  double steady_flux() const;  ///< at full pressure [m/s]

  /// Pressure of the water [Pa].
  double water_pressure(double t) const;
  /// Pore pressure [Pa] at height z.
  double pressure(double z, double t) const;
  /// Volume of water that has entered at z = L since t = 0, per area [m].
  double volume(double t) const;

 private:
  template <class Step, class Ramp>
  double answer(Step step, Ramp ramp, double t) const;

  SeepageProblem problem_;
};

}  // namespace perifrac
