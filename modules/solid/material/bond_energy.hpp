#pragma once

#include <tuple>

#include <Eigen/Core>

#include "core/base/small_vector.hpp"
#include "core/operators/point_stiffness.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// The stiffness of one point as the linear peridynamic solid has it (paper Eq 3, corrected):
///   W = 1/2 k theta^2 + D (D + 2) mu / (2 m) sum_j w (e - theta |xi| / D)^2,
///   theta = D / m sum_j w |xi| e,  k = lambda + 2 mu / D,
/// with the weighted volume m of the bonds that are left. It takes bonds of any kind, those of a
/// family along a line too; without bonds it is 0.
template <int D>
PointStiffness bond_energy_stiffness(const Family<D>& family, const MirrorCondition<D, D>& mirror,
                                     const IsotropicElasticity<D>& law, Index i) {
  const PointBonds own_bonds = family.bonds(i);
  const Index bonds = own_bonds.count();
  const Eigen::Index size = D * (bonds + 1);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd dilatation = Eigen::VectorXd::Zero(size);  // sum_j w |xi| e
  double weighted_volume = 0.0;
  for (Index b = 0; b < bonds; ++b) {
    const Vector<D> xi =
        vector_at(family.position, own_bonds.other(b)) - vector_at(family.position, i);
    const double weight = own_bonds.weight(b), square = dot<D>(xi, xi);
    weighted_volume += weight * square;
    for (int a = 0; a < D; ++a) {
      dilatation[a * (bonds + 1) + b] += weight * xi[a];
      dilatation[a * (bonds + 1) + bonds] -= weight * xi[a];
      for (int c = 0; c < D; ++c) {
        const double pull = weight * xi[a] * xi[c] / square;
        for (const auto& [row, column, sign] :
             {std::tuple(b, b, 1.0), {bonds, bonds, 1.0}, {b, bonds, -1.0}, {bonds, b, -1.0}}) {
          matrix(a * (bonds + 1) + row, c * (bonds + 1) + column) += sign * pull;
        }
      }
    }
  }
  if (!(weighted_volume > 0.0)) {
    matrix.setZero();
    return on_unknowns(family, mirror, i, matrix);
  }
  // sum_j w (e - theta |xi| / D)^2 = sum_j w e^2 - theta^2 m / D^2.
  matrix *= family.volume[i] * D * (D + 2) * law.shear_modulus / weighted_volume;
  dilatation *= D / weighted_volume;
  const double volumetric = law.lame_lambda - law.shear_modulus;  // k - (D + 2) mu / D
  matrix.noalias() += (family.volume[i] * volumetric * dilatation) * dilatation.transpose();
  return on_unknowns(family, mirror, i, matrix);
}

}  // namespace perifrac
