#pragma once

#include "modules/pore_flow/flux/gradient_flow.hpp"

namespace perifrac {

/// `operator: nested`: the paper's scheme, for comparison. Velocities q_i = -kappa G_i p (Eq 11),
/// outflow V_i sum_j w_ij (q_j - q_i) . K_i^-1 xi (Eq 12). Ghosts carry the image of the velocity:
/// normal component odd at a sealed face, even at one of prescribed pressure.
///
/// H is not symmetric. Where families are cut it makes and loses mass and has modes that grow, and
/// nothing seals such a surface; a checkerboard of pressures does not flow at all.
template <int D, class Law>
class NestedFlow final : public GradientFlow<D, Law> {
 public:
  explicit NestedFlow(LinearExactOperator<D, Law> op)
      : GradientFlow<D, Law>(std::move(op)),
        velocity_(static_cast<std::size_t>(D) * this->family().point_count),
        nodes_(static_cast<std::size_t>(D) * this->family().node_count()),
        face_gradient_(face_gradient()) {}

  void take_bonds(std::shared_ptr<const Family<D>> family, std::span<const Index> points) override {
    GradientFlow<D, Law>::take_bonds(std::move(family), points);
    face_gradient_ = face_gradient();
  }

  bool is_symmetric() const override { return false; }

  void apply(std::span<const double> p, std::span<double> outflow) override {
    const Family<D>& family = this->family();
    const Index points = family.point_count, nodes = family.node_count();
    this->velocity(p, velocity_);
    for (int a = 0; a < D; ++a) {
      std::copy_n(velocity_.begin() + a * points, points, nodes_.begin() + a * nodes);
    }
    this->operator_.mirror().fill_conjugate(nodes_);
    const double* const q = nodes_.data();
    for_each_shared_point(points, [&](Index i) {
      const auto moment =
          sum_over_bonds<D * D>(family, i, [=](Index j, const Vector<D>& xi, double w) {
            std::array<double, D * D> t;
            for (int a = 0; a < D; ++a) {
              const double difference = w * (q[a * nodes + j] - q[a * nodes + i]);
              for (int b = 0; b < D; ++b) t[a * D + b] = difference * xi[b];
            }
            return t;
          });
      double divergence = 0.0;
      for (int k = 0; k < D * D; ++k) {
        divergence += moment[k] * this->operator_.moments().inverse_shape[k][i];
      }
      outflow[i] = family.volume[i] * divergence;
    });
    ranks::gather_shares(outflow.first(points), points);
    const Eigen::VectorXd inflow = face_gradient_.transpose() *
                                   Eigen::Map<const Eigen::VectorXd>(velocity_.data(), D * points);
    for (Index f = 0; f < inflow.size(); ++f) outflow[points + f] = -inflow[f];
  }

  Eigen::SparseMatrix<double> assemble() const override {
    const Family<D>& family = this->family();
    const Index points = family.point_count;
    // Rows of V div and of the inflow through faces, both on velocities.
    const Eigen::SparseMatrix<double> flux_gradient =
        gradient_matrix(family, this->operator_.moments(), velocity_mirror());
    std::vector<Eigen::Triplet<double>> triplets;
    for (Index column = 0; column < D * points; ++column) {
      for (typename Eigen::SparseMatrix<double>::InnerIterator entry(flux_gradient, column); entry;
           ++entry) {
        const auto row = static_cast<Index>(entry.row());
        const Index block = row / points, i = row % points;
        if (block % (D + 1) == 0)
          triplets.emplace_back(i, column, family.volume[i] * entry.value());
      }
    }
    for (Index f = 0; f < face_gradient_.cols(); ++f) {
      for (typename Eigen::SparseMatrix<double>::InnerIterator entry(face_gradient_, f); entry;
           ++entry) {
        triplets.emplace_back(points + f, entry.row(), -entry.value());
      }
    }
    Eigen::SparseMatrix<double> balance(this->size(), D * points);
    balance.setFromTriplets(triplets.begin(), triplets.end());
    return balance * (velocity_matrix() * this->operator_.gradient_matrix());
  }

 private:
  /// V dG/dU of the face values U: inflow through them as the volume-weighted mean of velocities
  /// beside the face, as conservative flow has it.
  Eigen::SparseMatrix<double> face_gradient() const {
    const Index points = this->family().point_count;
    Eigen::SparseMatrix<double> columns =
        this->operator_.gradient_matrix().rightCols(this->size() - points);
    for (Index f = 0; f < columns.cols(); ++f) {
      for (typename Eigen::SparseMatrix<double>::InnerIterator entry(columns, f); entry; ++entry) {
        entry.valueRef() *= this->family().volume[entry.row() % points];
      }
    }
    return columns;
  }

  /// The images of velocities, as fill_conjugate makes them.
  MirrorCondition<D, D> velocity_mirror() const {
    MirrorCondition<D, D> mirror(this->family());
    for (int face = 0; face < 2 * D; ++face) {
      const bool pressure = this->operator_.mirror().face_value(face, 0) >= 0;
      for (int a = 0; a < D; ++a) {
        if ((a == face / 2) != pressure) mirror.set_odd(face, a);
      }
    }
    return mirror;
  }

  /// -kappa, from gradients to velocities.
  Eigen::SparseMatrix<double> velocity_matrix() const {
    const Index points = this->family().point_count;
    std::vector<Eigen::Triplet<double>> triplets;
    for (Index i = 0; i < points; ++i) {
      for (int b = 0; b < D; ++b) {
        Tensor<1, D> unit{};
        unit[b] = 1.0;
        const Tensor<1, D> column = law_at(this->operator_.law(), i).stress(unit);
        for (int a = 0; a < D; ++a) {
          triplets.emplace_back(a * points + i, b * points + i, -column[a]);
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(D * points, D * points);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  }

  std::vector<double> velocity_;  ///< workspace: D blocks, on points
  std::vector<double> nodes_;     ///< the same on points and ghosts
  Eigen::SparseMatrix<double> face_gradient_;
};

}  // namespace perifrac
