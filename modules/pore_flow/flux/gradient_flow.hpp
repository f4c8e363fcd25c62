#pragma once

#include <utility>
#include <vector>

#include "core/base/small_vector.hpp"
#include "core/operators/linear_exact.hpp"
#include "modules/pore_flow/flux/cut_bonds.hpp"
#include "modules/pore_flow/flux/flow_operator.hpp"

namespace perifrac {

/// What all operators of Darcy flow share: pressures with their images, the nonlocal gradient, the
/// velocity of the law in it, and flow on bonds alone.
template <int D, class Law>
class GradientFlow : public FlowOperator<D> {
 public:
  explicit GradientFlow(LinearExactOperator<D, Law> op) : operator_(std::move(op)) {}

  const Family<D>& family() const { return operator_.family(); }
  Index point_count() const override { return family().point_count; }
  const std::vector<double>& volume() const override { return family().volume; }
  Vector<D> place(Index i) const override { return vector_at(family().position, i); }
  Index size() const override { return operator_.size(); }

  double mobility(Index i) const override {
    if constexpr (requires(Law law) { law.factor; }) {
      return operator_.law().law.at(i).mean_mobility();
    } else {
      return law_at(operator_.law(), i).mean_mobility();
    }
  }

  void scale_mobility(std::span<const double> factor) override {
    if constexpr (requires(Law law) { law.factor; }) {
      operator_.change_law([&](Law& law) { law.factor.assign(factor.begin(), factor.end()); });
    } else {
      FlowOperator<D>::scale_mobility(factor);
    }
  }

  void follow(const BondState<D>& bonds) override {
    if (bonds_.follow(bonds, family())) take_bonds(bonds_.family(), bonds_.points());
  }

  /// Takes a family of the same bonds in which others are broken, of weight 0, at these points.
  virtual void take_bonds(std::shared_ptr<const Family<D>> family, std::span<const Index> points) {
    operator_.update(std::move(family), points);
  }

  void velocity(std::span<const double> p, std::span<double> velocity) override {
    operator_.gradient(p, velocity);
    const Index points = family().point_count;
    for_each_point(points, [&](Index i) {
      const Tensor<1, D> gradient = vector_at<D>(velocity, points, i);
      set_at(velocity, points, i, -law_at(operator_.law(), i).stress(gradient));
    });
  }

  std::string path() const override { return "bond by bond: not the conservative operator"; }

  Eigen::SparseMatrix<double> preconditioner() const override {
    std::vector<double> stiffness(family().point_count);
    find_bond_stiffness(stiffness);
    return bond_matrix(family(), operator_.mirror(), std::span<const double>(stiffness));
  }

 protected:
  /// s_i = D kappa_i / m_i of the flow on bonds alone, sum_i V_i s_i sum_j w_ij (p_j - p_i)^2 / 2.
  void find_bond_stiffness(std::span<double> stiffness) const {
    for_each_point(family().point_count, [&](Index i) {
      stiffness[i] = D * law_at(operator_.law(), i).mean_mobility() / operator_.weighted_volume(i);
    });
  }

  LinearExactOperator<D, Law> operator_;

 private:
  CutBonds<D> bonds_;
};

}  // namespace perifrac
