#include "core/operators/nonlocal_gradient.hpp"

#include "core/operators/node_unknowns.hpp"

namespace perifrac {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

}  // namespace

template <int D, int R>
Eigen::SparseMatrix<double> gradient_matrix(const Family<D>& family,
                                            const FamilyMoments<D>& moments,
                                            const MirrorCondition<D, R>& mirror) {
  const Index points = family.point_count;
  Triplets triplets;
  triplets.reserve(family.steps.total() * R * D * 2);
  for (Index i = 0; i < points; ++i) {
    for (const auto& [j, weight] : family.bonds(i)) {
      for (int b = 0; b < D; ++b) {
        double entry = 0.0;  // w (K^-1 xi)_b
        for (int c = 0; c < D; ++c) {
          entry +=
              moments.inverse_shape[b * D + c][i] * (family.position[c][j] - family.position[c][i]);
        }
        entry *= weight;
        for (int r = 0; r < R; ++r) {
          const Index row = (r * D + b) * points + i;
          const Combination end = node_unknowns(family, mirror, j, r);
          for (int k = 0; k < end.count; ++k) {
            triplets.emplace_back(row, end.terms[k].unknown, entry * end.terms[k].coefficient);
          }
          triplets.emplace_back(row, r * points + i, -entry);
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(R * D * points, R * points + mirror.face_value_count());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

template <int D, int R>
Eigen::VectorXd force_of_stress(const Family<D>& family,
                                const std::function<Tensor<D, D>(Index i)>& inverse_shape,
                                const MirrorCondition<D, R>& mirror,
                                const Eigen::VectorXd& stress) {
  const Index points = family.point_count, nodes = family.node_count();
  std::vector<double> force(static_cast<std::size_t>(R) * nodes, 0.0);
  for (Index i = 0; i < points; ++i) {
    Tensor<R, D> own;
    for (int k = 0; k < R * D; ++k) own[k] = stress[static_cast<Eigen::Index>(k) * points + i];
    if (own == Tensor<R, D>{}) continue;
    own = times_inverse_shape<R, D>(own, inverse_shape(i));
    for (const auto& [j, weight] : family.bonds(i)) {
      const Vector<D> xi = vector_at(family.position, j) - vector_at(family.position, i);
      for (int r = 0; r < R; ++r) {
        double pull = 0.0;
        for (int b = 0; b < D; ++b) pull += own[r * D + b] * xi[b];
        pull *= weight;
        force[static_cast<std::size_t>(r) * nodes + j] += pull;
        force[static_cast<std::size_t>(r) * nodes + i] -= pull;
      }
    }
  }
  Eigen::VectorXd result(R * points + mirror.face_value_count());
  mirror.collect(force, {result.data(), static_cast<std::size_t>(result.size())});
  return result;
}

template <int D>
Eigen::SparseMatrix<double> bond_matrix(const Family<D>& family,
                                        const MirrorCondition<D, 1>& mirror,
                                        std::span<const double> bond_stiffness) {
  const Index points = family.point_count, size = points + mirror.face_value_count();
  // Of a bond between points, which each of both knows: what this one adds beside the diagonal, in
  // place of four entries each. A triplet has 16 bytes, and in 3D bonds are many.
  Eigen::SparseMatrix<double> one_way(size, size);
  std::vector<double> diagonal(points, 0.0);
  Triplets rest;
  Eigen::VectorXi count = Eigen::VectorXi::Zero(size);
  for (Index i = 0; i < points; ++i) count[i] = family.first_ghost_bond(i);
  one_way.reserve(count);
  for (Index i = 0; i < points; ++i) {
    for (const auto& [j, weight] : family.bonds(i)) {
      const double stiffness = family.volume[i] * bond_stiffness[i] * weight;
      if (j < points) {
        one_way.insert(j, i) = -stiffness;
        diagonal[i] += stiffness;
        diagonal[j] += stiffness;
        continue;
      }
      Combination difference = node_unknowns(family, mirror, j, 0);
      difference.add(i, -1.0);
      for (int k = 0; k < difference.count; ++k) {
        for (int l = 0; l < difference.count; ++l) {
          rest.emplace_back(
              difference.terms[k].unknown, difference.terms[l].unknown,
              stiffness * difference.terms[k].coefficient * difference.terms[l].coefficient);
        }
      }
    }
  }
  for (Index i = 0; i < points; ++i) rest.emplace_back(i, i, diagonal[i]);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(rest.begin(), rest.end());
  const Eigen::SparseMatrix<double> back = one_way.transpose();
  one_way += back;
  return matrix + one_way;
}

template Eigen::SparseMatrix<double> gradient_matrix(const Family<2>&, const FamilyMoments<2>&,
                                                     const MirrorCondition<2, 1>&);
template Eigen::SparseMatrix<double> gradient_matrix(const Family<2>&, const FamilyMoments<2>&,
                                                     const MirrorCondition<2, 2>&);
template Eigen::SparseMatrix<double> gradient_matrix(const Family<3>&, const FamilyMoments<3>&,
                                                     const MirrorCondition<3, 1>&);
template Eigen::SparseMatrix<double> gradient_matrix(const Family<3>&, const FamilyMoments<3>&,
                                                     const MirrorCondition<3, 3>&);
template Eigen::VectorXd force_of_stress(const Family<2>&,
                                         const std::function<Tensor<2, 2>(Index)>&,
                                         const MirrorCondition<2, 1>&, const Eigen::VectorXd&);
template Eigen::VectorXd force_of_stress(const Family<2>&,
                                         const std::function<Tensor<2, 2>(Index)>&,
                                         const MirrorCondition<2, 2>&, const Eigen::VectorXd&);
template Eigen::VectorXd force_of_stress(const Family<3>&,
                                         const std::function<Tensor<3, 3>(Index)>&,
                                         const MirrorCondition<3, 1>&, const Eigen::VectorXd&);
template Eigen::VectorXd force_of_stress(const Family<3>&,
                                         const std::function<Tensor<3, 3>(Index)>&,
                                         const MirrorCondition<3, 3>&, const Eigen::VectorXd&);
template Eigen::SparseMatrix<double> bond_matrix(const Family<2>&, const MirrorCondition<2, 1>&,
                                                 std::span<const double>);
template Eigen::SparseMatrix<double> bond_matrix(const Family<3>&, const MirrorCondition<3, 1>&,
                                                 std::span<const double>);

}  // namespace perifrac
