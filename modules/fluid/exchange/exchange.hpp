#pragma once

#include <span>
#include <vector>

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// What the pores tell the fluid, at all points of the body: the pressure at time t is
/// pressure + rate (t - end) + slope m, with m what they got in the window so far.
struct PoreInput {
  std::span<const double> pressure{};  ///< [Pa]
  std::span<const double> rate{};      ///< [Pa/s]
  std::span<const double> slope{};     ///< [Pa/kg]
  std::span<const double> mobility{};  ///< permeability / viscosity [m^2/(Pa s)]
  double end = 0.0;                    ///< [s]
  std::span<const double> mass{};      ///< m [kg]

  double at(Index point, double t) const {
    return pressure[point] + rate[point] * (t - end) + slope[point] * mass[point];
  }
};

/// How mass passes between the free fluid and the pores of the body.
template <int D>
class Exchange {
 public:
  virtual ~Exchange() = default;

  /// What the fluid loses, the body gets, and nothing else.
  virtual bool keeps_mass() const { return true; }

  /// Sets the mass per time that every fluid point gets [kg/s] in a step of this length [s] from t
  /// on, at its own velocity, and every near wall point: those of the body take from the fluid, or
  /// give to it; rigid ones do nothing. All rates are 0 before.
  virtual void find(const FluidStep<D>& step, const PoreInput& pores, double t, double length,
                    NearWalls<D>& walls, std::vector<double>& rate) = 0;
};

}  // namespace perifrac
