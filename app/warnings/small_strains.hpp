#pragma once

#include <array>
#include <span>

#include "core/body/body.hpp"

namespace perifrac {

/// Beyond it a strain is not small.
inline constexpr double large_strain = 0.1;

/// The largest of a body at one moment, and where.
struct LargestStrain {
  double strain = 0.0;    ///< by size, of the principal ones
  double rotation = 0.0;  ///< [rad]
  Index strained = 0, rotated = 0;
};

/// From displacements [m], component by component: gradients by least squares over every point's
/// bonds, exact where they are linear. Ends of broken bonds are left out: an opening is no strain.
/// Where no two points have moved apart by more than `negligible`, all is 0.
template <int D>
LargestStrain largest_strain(const Body<D>& body, std::span<const double> displacement,
                             double negligible);

}  // namespace perifrac
