#pragma once

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
  const Index first = family.offset[i];
  const Index bonds = family.offset[i + 1] - first;
  Eigen::MatrixXd extension = Eigen::MatrixXd::Zero(bonds, D * (bonds + 1));
  Eigen::VectorXd length(bonds), weight(bonds);
  for (Index b = 0; b < bonds; ++b) {
    const Vector<D> xi =
        vector_at(family.position, family.other[first + b]) - vector_at(family.position, i);
    length[b] = norm(xi);
    weight[b] = family.weight[first + b];
    for (int a = 0; a < D; ++a) {
      extension(b, a * (bonds + 1) + b) += xi[a] / length[b];
      extension(b, a * (bonds + 1) + bonds) -= xi[a] / length[b];
    }
  }
  const double weighted_volume = weight.dot(length.cwiseAbs2());
  if (!(weighted_volume > 0.0)) {
    return on_unknowns(family, mirror, i, Eigen::MatrixXd::Zero(D * (bonds + 1), D * (bonds + 1)));
  }
  const Eigen::RowVectorXd dilatation =
      D / weighted_volume * weight.cwiseProduct(length).transpose() * extension;
  const Eigen::MatrixXd deviation = extension - length / D * dilatation;
  const Eigen::MatrixXd matrix = law.drained_bulk_modulus() * dilatation.transpose() * dilatation +
                                 D * (D + 2) * law.shear_modulus / weighted_volume *
                                     deviation.transpose() * weight.asDiagonal() * deviation;
  return on_unknowns(family, mirror, i, family.volume[i] * matrix);
}

}  // namespace perifrac
