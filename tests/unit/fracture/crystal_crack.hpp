#pragma once

#include <array>
#include <cmath>
#include <complex>

#include <Eigen/Dense>

#include "core/base/points.hpp"

namespace perifrac::test {

/// Plane stiffness: what takes (e_xx, e_yy, 2 e_xy) to (s_xx, s_yy, s_xy) [Pa].
using PlaneStiffness = Eigen::Matrix3d;

/// A straight crack in an infinite plate of any plane elasticity, after Lekhnitskii: displacement
/// under uniform stresses far away, given in the frame of the crack (x along it), and a pressure on
/// its faces. Not for isotropic plates, where the two roots below are one: see ExactCrack.
struct CrystalCrack {
  Vector<2> centre;
  double angle;        ///< of the crack against the x-axis [rad]
  double half_length;  ///< [m]
  double normal;       ///< stress across it, far away [Pa]
  double along;        ///< stress along it, far away [Pa]
  double shear;        ///< [Pa]
  double pressure;     ///< on its faces [Pa]
  PlaneStiffness stiffness;

  double mode_one() const { return (normal + pressure) * std::sqrt(M_PI * half_length); }
  /// The jump of displacement in the middle over the half length, across and along the crack.
  Vector<2> middle_jump() const {
    const Roots roots(*this);
    Vector<2> jump{};
    for (int k = 0; k < 2; ++k) {
      jump[0] -= 4.0 * (roots.q[k] * roots.share[k]).imag();
      jump[1] -= 4.0 * (roots.p[k] * roots.share[k]).imag();
    }
    return jump;
  }
  /// At each tip, what half the crack's work of opening and sliding grows by.
  double energy_release() const {
    const auto [opening, sliding] = middle_jump();
    return 0.25 * M_PI * half_length * ((normal + pressure) * opening + shear * sliding);
  }

  Vector<2> displacement(const Vector<2>& at) const {
    const Roots roots(*this);
    const double c = std::cos(angle), s = std::sin(angle);
    const double dx = at[0] - centre[0], dy = at[1] - centre[1];
    const double x = c * dx + s * dy, y = -s * dx + c * dy;
    double u = 0.0, v = 0.0;
    for (int k = 0; k < 2; ++k) {
      const Complex z = x + roots.mu[k] * y;
      // The branch of the root that is z far away and cut along the crack.
      const Complex root = std::sqrt(z - half_length) * std::sqrt(z + half_length);
      u += 2.0 * (roots.p[k] * roots.share[k] * (root - z)).real();
      v += 2.0 * (roots.q[k] * roots.share[k] * (root - z)).real();
    }
    const Eigen::Vector3d strain = roots.compliance * Eigen::Vector3d(along, normal, shear);
    u += strain[0] * x + 0.5 * strain[2] * y;
    v += strain[1] * y + 0.5 * strain[2] * x;
    return {c * u - s * v, s * u + c * v};
  }

 private:
  using Complex = std::complex<double>;

  /// Of a11 mu^4 - 2 a16 mu^3 + (2 a12 + a66) mu^2 - 2 a26 mu + a22 = 0, those with Im mu > 0.
  struct Roots {
    Eigen::Matrix3d compliance;  ///< in the frame of the crack
    std::array<Complex, 2> mu, p, q, share;

    explicit Roots(const CrystalCrack& crack);
  };
};

}  // namespace perifrac::test
