#include "tests/unit/fracture/crystal_crack.hpp"

#include <Eigen/Dense>

#include "tests/spectra.hpp"

namespace perifrac::test {

CrystalCrack::Roots::Roots(const CrystalCrack& crack) {
  const double c = std::cos(crack.angle), s = std::sin(crack.angle);
  Eigen::Matrix3d turn;  // takes strains in the frame of the crack to those along the axes
  turn << c * c, s * s, -c * s, s * s, c * c, c * s, 2 * c * s, -2 * c * s, c * c - s * s;
  compliance = (turn.transpose() * crack.stiffness * turn).inverse();
  const Eigen::Matrix3d& a = compliance;
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.bottomLeftCorner<3, 3>().setIdentity();
  companion.row(0) =
      Eigen::RowVector4d(2.0 * a(0, 2), -2.0 * a(0, 1) - a(2, 2), 2.0 * a(1, 2), -a(1, 1)) /
      a(0, 0);
  const Eigen::Vector4cd all = eigenvalues(companion);
  for (int k = 0, next = 0; k < 4; ++k) {
    if (all[k].imag() > 0.0) mu[next++] = all[k];
  }
  for (int k = 0; k < 2; ++k) {
    p[k] = a(0, 0) * mu[k] * mu[k] + a(0, 1) - a(0, 2) * mu[k];
    q[k] = a(0, 1) * mu[k] + a(1, 1) / mu[k] - a(1, 2);
  }
  // What takes the stresses off the faces.
  const double opening = 0.5 * (crack.normal + crack.pressure), sliding = 0.5 * crack.shear;
  share = {-(opening * mu[1] + sliding) / (mu[0] - mu[1]),
           (opening * mu[0] + sliding) / (mu[0] - mu[1])};
}

}  // namespace perifrac::test
