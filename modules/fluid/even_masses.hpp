#pragma once

#include <array>
#include <vector>

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Lets mass flow from fluid points that have more to those that have less,
///   dm_i/dt = D sum_j omega 4d / (tr M_i + tr M_j) dx^d (m_j - m_i),   D = 0.002 c_0 dx,
/// and with it momentum, at the mean of both velocities: mass and momentum are kept.
///
/// What passes into the pores comes from the first row of points before them. Once these are
/// smaller than the others by some per cent, uniform pressure is no equilibrium any more: in a
/// steady flow the pressure of that row, and with it the flow, grew by half of what it had lost.
/// Points below nine tenths of a whole one are left alone: they end by being merged.
template <int D>
class EvenMasses {
 public:
  /// One step of `length` [s]. Masses, densities and velocities change, volumes do not.
  void step(const FluidStep<D>& step, double length, FluidPoints<D>& points);

 private:
  std::vector<double> mass_;                         ///< with images
  std::array<std::vector<double>, 1 + D> gained_{};  ///< mass [kg] and momentum [kg m/s]
};

}  // namespace perifrac
