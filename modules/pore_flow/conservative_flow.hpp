#pragma once

#include <utility>
#include <vector>

#include "core/operators/linear_exact.hpp"
#include "modules/pore_flow/darcy_law.hpp"
#include "modules/pore_flow/flow_operator.hpp"

namespace perifrac {

/// `operator: conservative`: the linear-exact operator with a law of Darcy flow. Bond fluxes are
/// equal and opposite, so mass is exact; H is symmetric, positive semidefinite, one null mode.
template <int D, class Law>
class ConservativeFlow final : public FlowOperator<D> {
 public:
  explicit ConservativeFlow(LinearExactOperator<D, Law> op) : operator_(std::move(op)) {}

  const Family<D>& family() const override { return operator_.family(); }
  Index size() const override { return operator_.size(); }

  void scale_mobility(std::span<const double> factor) override {
    if constexpr (requires(Law law) { law.factor; }) {
      operator_.change_law([&](Law& law) { law.factor.assign(factor.begin(), factor.end()); });
    } else {
      FlowOperator<D>::scale_mobility(factor);
    }
  }

  void apply(std::span<const double> p, std::span<double> outflow) override {
    operator_.apply(p, outflow);
  }

  void velocity(std::span<const double> p, std::span<double> velocity) override {
    operator_.gradient(p, velocity);
    const Index points = family().point_count;
    for_each_point(points, [&](Index i) {
      Tensor<1, D> gradient;
      for (int a = 0; a < D; ++a) gradient[a] = velocity[a * points + i];
      const Tensor<1, D> flux = law_at(operator_.law(), i).stress(gradient);
      for (int a = 0; a < D; ++a) velocity[a * points + i] = -flux[a];
    });
  }

  Eigen::SparseMatrix<double> assemble() const override { return operator_.assemble(); }

  /// kappa sum_i V_i (D / m_i) sum_j w_ij (p_j - p_i)^2 / 2: Darcy flow on bonds alone.
  Eigen::SparseMatrix<double> preconditioner() const override {
    std::vector<double> stiffness(family().point_count);
    for (Index i = 0; i < family().point_count; ++i) {
      stiffness[i] = D * law_at(operator_.law(), i).mean_mobility() / operator_.weighted_volume(i);
    }
    return bond_matrix(family(), operator_.mirror(), std::span<const double>(stiffness));
  }

 private:
  LinearExactOperator<D, Law> operator_;
};

}  // namespace perifrac
