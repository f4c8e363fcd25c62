#pragma once

#include <cmath>
#include <complex>

#include "core/base/points.hpp"

namespace perifrac::test {

/// A straight crack in an infinite plate in plane strain, after Westergaard: displacement and
/// stress intensity under uniform stresses far away, given in the frame of the crack (x along it),
/// and a pressure on its faces.
struct ExactCrack {
  Vector<2> centre;
  double angle;        ///< of the crack against the x-axis [rad]
  double half_length;  ///< [m]
  double normal;       ///< stress across it, far away [Pa]
  double along;        ///< stress along it, far away [Pa]
  double shear;        ///< [Pa]
  double pressure;     ///< on its faces [Pa]
  double shear_modulus;
  double poisson_ratio;

  double mode_one() const { return (normal + pressure) * std::sqrt(M_PI * half_length); }
  double mode_two() const { return shear * std::sqrt(M_PI * half_length); }

  Vector<2> displacement(const Vector<2>& at) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const double dx = at[0] - centre[0], dy = at[1] - centre[1];
    const std::complex<double> z(c * dx + s * dy, -s * dx + c * dy);
    const double y = z.imag();
    // The branch of the root that is z far away and cut along the crack.
    const std::complex<double> root = std::sqrt(z - half_length) * std::sqrt(z + half_length);
    const double kappa = 3.0 - 4.0 * poisson_ratio;
    const double opening = normal + pressure;
    // Equal stress in all directions, with the crack free.
    double u = opening * (0.5 * (kappa - 1.0) * root.real() - y * (z / root).imag());
    double v = opening * (0.5 * (kappa + 1.0) * root.imag() - y * (z / root).real());
    u += shear * (0.5 * (kappa + 1.0) * root.imag() + y * (z / root).real());
    v += shear * (-0.5 * (kappa - 1.0) * root.real() - y * (z / root).imag());
    // Uniform stresses make up the difference: along it, and the pressure all around taken off.
    const auto uniform = [&](double xx, double yy) {
      const double mean = poisson_ratio * (xx + yy);
      u += (xx - mean) * z.real();
      v += (yy - mean) * z.imag();
    };
    uniform(along - opening, 0.0);
    uniform(0.0, -pressure);
    u /= 2.0 * shear_modulus;
    v /= 2.0 * shear_modulus;
    return {c * u - s * v, s * u + c * v};
  }
};

}  // namespace perifrac::test
