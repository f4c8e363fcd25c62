#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/block_sum.hpp"
#include "modules/solid/material/law_field.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/nonlinear_response.hpp"
#include "modules/solid/material/tangent_law.hpp"

namespace perifrac {

/// The linear-exact operator with a law whose stress is not linear in the gradient of displacement,
/// or that has a memory. A point stores V_i [W(G_i) + 1/2 s_i sum_j w_ij |u_j - u_i - G_i xi|^2],
/// and the force is its exact derivative, so that momentum is kept to rounding. What is small is
/// linearised at rest. Not for curved ghosts.
template <int D, class Law>
class NonlinearElasticity final : public LinearExactElasticity<D, LawField<Law>>,
                                  public NonlinearResponse {
  using Base = LinearExactElasticity<D, LawField<Law>>;
  using Base::operator_;
  using AtRest = LawByRegion<TangentLaw<D>>;

 public:
  /// `stiffening`: how many times as stiff as at rest it may become, 1 or more; explicit steps
  /// follow.
  NonlinearElasticity(std::shared_ptr<const Family<D>> family, const MirrorCondition<D, D>& mirror,
                      LawByRegion<Law> law, std::optional<Vector<D>> initial_stress,
                      double stiffening)
      : Base(LinearExactOperator<D, LawField<Law>>(family, mirror, LawField<Law>(law)),
             initial_stress),
        family_(std::move(family)),
        at_rest_(LinearExactOperator<D, AtRest>(family_, mirror, tangent(law))),
        stiffening_(stiffening),
        initial_force_(this->initial_force()) {}

  NonlinearResponse* nonlinear() override { return this; }

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
  void respond(std::span<const double> u, std::span<double> force,
               std::span<double> dilatation = {}) override {
    Base::apply(u, {}, force, dilatation);
    for (std::size_t k = 0; k < force.size(); ++k) force[k] -= initial_force_[k];
  }
  void add_pore_force(std::span<const double> pore_stress, std::span<double> force) override {
    at_rest_.add_pore_force(pore_stress, force);
  }
  Eigen::SparseMatrix<double> assemble() const override { return at_rest_.assemble(); }

  double energy(std::span<const double> u, std::span<const double>) override {
    operator_.look_at(u);
    return block_sum(family_->point_count, block_sums_, [&](Index i) {
      const Tensor<D, D> gradient = operator_.gradient_at(i);
      return family_->volume[i] * law_energy(law_of(i), gradient, field().memory_at(i)) +
             operator_.rest_energy(i, gradient);
    });
  }

  void linearise(std::span<const double> u) override {
    if (!tangent_) {
      tangent_.emplace(family_, operator_.mirror(), TangentField<D>{tangents_at_rest()});
    }
    operator_.look_at(u);
    tangent_->change_law([&](TangentField<D>& tangents) {
      for_each_point(family_->point_count, [&](Index i) {
        tangents.of_point[i] = TangentLaw<D>::of(field().at(i), operator_.gradient_at(i));
      });
    });
  }
  void apply_tangent(std::span<const double> v, std::span<double> force) override {
    tangent_->apply(v, force);
  }

  int memory_size() const override { return static_cast<int>(memory_of<Law>()); }
  std::span<double> memory() override { return *field().memory; }
  void forget() override {
    std::ranges::fill(*field().memory, 0.0);
    heat_ = 0.0;
  }
  void follow(std::span<const double> u, double seconds) override {
    if constexpr (memory_of<Law>() > 0) {
      operator_.look_at(u);
      heat_ += block_sum(family_->point_count, block_sums_, [&](Index i) {
        Memory<Law> own = field().memory_at(i);
        const double heat = law_of(i).follow(operator_.gradient_at(i), own, seconds);
        field().set_memory(i, own);
        return family_->volume[i] * heat;
      });
    }
  }
  double heat() const override { return heat_; }
  void visit_state(StateVisitor& visitor) override {
    if (memory_size() == 0) return;
    visitor.visit("material_memory", *field().memory);
    visitor.visit("material_heat", heat_);
  }

 private:
  const LawField<Law>& field() const { return operator_.law(); }
  const Law& law_of(Index i) const { return field().laws.at(i); }

  static AtRest tangent(const LawByRegion<Law>& law) {
    AtRest tangents{{}, law.law_of_point};
    for (const Law& each : law.laws) {
      tangents.laws.push_back(TangentLaw<D>::of(LawAtPoint<Law>{each, {}}));
    }
    return tangents;
  }
  std::vector<TangentLaw<D>> tangents_at_rest() const {
    std::vector<TangentLaw<D>> tangents;
    for (Index i = 0; i < family_->point_count; ++i) {
      tangents.push_back(TangentLaw<D>::of(field().at(i)));
    }
    return tangents;
  }

  std::shared_ptr<const Family<D>> family_;
  LinearExactElasticity<D, AtRest> at_rest_;
  std::optional<LinearExactOperator<D, TangentField<D>>> tangent_;  ///< once it is asked for
  double stiffening_;
  std::vector<double> initial_force_;
  double heat_ = 0.0;
  std::vector<double> block_sums_;  // workspace
};

}  // namespace perifrac
