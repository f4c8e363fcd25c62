#pragma once

#include <utility>

#include "core/base/block_sum.hpp"
#include "modules/solid/material/law_check.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/tangent_law.hpp"

namespace perifrac {

/// The linear-exact operator with a law whose stress is not linear in the gradient of displacement;
/// for a solid with inertia. A point stores V_i [W(G_i) + 1/2 s_i sum_j w_ij |u_j - u_i - G_i
/// xi|^2], and the force is its exact derivative, so that momentum is kept to rounding. What is
/// small is linearised at rest. Not for curved ghosts.
template <int D, class Law>
class NonlinearElasticity final : public LinearExactElasticity<D, LawByRegion<Law>> {
  using Base = LinearExactElasticity<D, LawByRegion<Law>>;
  using Base::operator_;

 public:
  /// `stiffening`: how many times as stiff as at rest it may become, 1 or more; the step follows.
  NonlinearElasticity(std::shared_ptr<const Family<D>> family, const MirrorCondition<D, D>& mirror,
                      LawByRegion<Law> law, std::optional<Vector<D>> initial_stress,
                      double stiffening)
      : Base(LinearExactOperator<D, LawByRegion<Law>>(family, mirror, law), initial_stress),
        at_rest_(LinearExactOperator<D, LawByRegion<TangentLaw<D>>>(family, mirror, tangent(law))),
        stiffening_(stiffening) {}

  /// The stiffest that it may be: the step is to be stable there.
  void apply_small(std::span<const double> u, const PoreStress& pore, std::span<double> force,
                   std::span<double> dilatation) override {
    at_rest_.apply(u, pore, force, dilatation);
    for (double& f : force) f *= stiffening_;
  }
  void apply_stiffness(std::span<const double> u, std::span<double> force,
                       std::span<double> dilatation = {}) override {
    at_rest_.apply_stiffness(u, force, dilatation);
  }
  void add_pore_force(std::span<const double> pore_stress, std::span<double> force) override {
    at_rest_.add_pore_force(pore_stress, force);
  }
  Eigen::SparseMatrix<double> assemble() const override { return at_rest_.assemble(); }

  double energy(std::span<const double> u, std::span<const double>) override {
    this->take(u);
    return block_sum(operator_.family().point_count, block_sums_,
                     [&](Index i) { return point_energy(i, u); });
  }

 private:
  double point_energy(Index i, std::span<const double>) const override {
    const Tensor<D, D> gradient = operator_.gradient_at(i);
    return operator_.family().volume[i] * law_energy(law_at(operator_.law(), i), gradient) +
           operator_.rest_energy(i, gradient);
  }

  static LawByRegion<TangentLaw<D>> tangent(const LawByRegion<Law>& law) {
    LawByRegion<TangentLaw<D>> tangents{{}, law.law_of_point};
    for (const Law& each : law.laws) tangents.laws.push_back(TangentLaw<D>::of(each));
    return tangents;
  }

  LinearExactElasticity<D, LawByRegion<TangentLaw<D>>> at_rest_;
  double stiffening_;
  std::vector<double> block_sums_;  // workspace
};

}  // namespace perifrac
