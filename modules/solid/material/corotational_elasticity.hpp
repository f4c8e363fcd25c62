#pragma once

#include "core/base/block_sum.hpp"
#include "core/base/small_vector.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/turned_law.hpp"
#include "modules/solid/material/turning_bonds.hpp"

namespace perifrac {

/// `solid.kinematics: corotational`: the linear-exact material of strains that are small beside
/// rotations of any size. With F_i = I + G_i = R_i U_i, G_i the gradient of the displacement, a
/// point stores
///   V_i [1/2 E : C : E + 1/2 s_i sum_j w_ij |u_j - u_i - G_i xi|^2],  E = U_i - I,
/// whose second term does not see a rotation. The force is its exact derivative: the linear-exact
/// operator with R_i (C : E_i - pore stress) for stress, since an isotropic stress has the axes of
/// U_i, so that turning those does no work. So linear and angular momentum are kept to
/// rounding, and with a linear law's E = sym G to first order. The pore stress works on
/// theta = tr E.
///
/// Loads keep the directions and areas of the undeformed body. Not for initial stress, which would
/// have to turn, nor for curved ghosts.
template <int D, class Law>
class CorotationalElasticity final : public LinearExactElasticity<D, Law> {
  using Small = LinearExactElasticity<D, Law>;
  using Small::operator_;

 public:
  explicit CorotationalElasticity(LinearExactOperator<D, Law> op) : Small(std::move(op)) {}

  void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
             std::span<double> dilatation) override {
    with_pore_stress(pore,
                     [&](auto pore_stress) { apply_with(u, force, dilatation, pore_stress); });
    for (const Thin& thin : turning_) thin.bonds.add_force(u, force);
  }

  void apply_small(std::span<const double> u, const PoreStress& pore, std::span<double> force,
                   std::span<double> dilatation) override {
    Small::apply(u, pore, force, dilatation);
  }

  double energy(std::span<const double> u, std::span<const double>) override {
    this->take(u);
    return block_sum(operator_.family().point_count, block_sums_,
                     [&](Index i) { return point_energy(i, u); });
  }

  double point_energy(Index i, std::span<const double> u) const override {
    const auto thin = std::ranges::lower_bound(turning_, i, {}, &Thin::point);
    if (thin != turning_.end() && thin->point == i) return thin->bonds.energy(u);
    const Tensor<D, D> gradient = operator_.gradient_at(i);
    const Tensor<D, D> strain = turned(gradient).strain;
    const Tensor<D, D> stress = law_at(operator_.law(), i).stress(strain);
    double density = 0.0;
    for (int k = 0; k < D * D; ++k) density += strain[k] * stress[k];
    return 0.5 * operator_.family().volume[i] * density + operator_.rest_energy(i, gradient);
  }

  /// In the axes of space: R (C : E) R^T.
  void stress(std::span<const double> u, std::span<double> stress) override {
    operator_.gradient(u, stress);
    const Index points = operator_.family().point_count;
    for_each_point(points, [&](Index i) {
      Tensor<D, D> gradient;
      for (int k = 0; k < D * D; ++k) {
        gradient[k] = stress[static_cast<std::size_t>(k) * points + i];
      }
      const Turned<D> at = turned(gradient);
      Tensor<D, D> back;
      for (int k = 0; k < D * D; ++k) back[k] = at.rotation[k % D * D + k / D];
      const auto turned_stress =
          product<D>(at.rotation, law_at(operator_.law(), i).stress(at.strain));
      const Tensor<D, D> result = product<D>(turned_stress, back);
      for (int k = 0; k < D * D; ++k) stress[static_cast<std::size_t>(k) * points + i] = result[k];
    });
  }

  void update(std::span<const Index> points) override {
    Small::update(points);
    for (const Index i : points) {
      const auto thin = std::ranges::lower_bound(turning_, i, {}, &Thin::point);
      const auto place = thin != turning_.end() && thin->point == i ? turning_.erase(thin) : thin;
      if (!is_thin(operator_.family(), i)) continue;
      turning_.insert(
          place, {i, TurningBonds<D>(operator_.family(), operator_.mirror(), this->law(i), i)});
    }
  }

 private:
  /// What Small::ThinPoint is beside small rotations.
  struct Thin {
    Index point;
    TurningBonds<D> bonds;
  };

  template <class PoreStressAt>
  void apply_with(std::span<const double> u, std::span<double> force, std::span<double> dilatation,
                  PoreStressAt&& pore_stress) {
    const auto add = [&](auto i, const auto& gradient, auto& stress) {
      const auto at = turned(gradient);
      const auto theta = trace(at.strain);
      if (!dilatation.empty()) set_value(dilatation.data(), i, theta);
      auto unturned = perifrac::stress_at(operator_.law(), i, at.strain);
      add_to_diagonal(unturned, -pore_stress(i, theta));
      stress = product<D>(at.rotation, unturned);
    };
    operator_.apply(u, force, add, dilatation);
  }

  std::vector<Thin> turning_;       ///< in the order of their points
  std::vector<double> block_sums_;  // workspace
};

// Compiled once, in corotational_elasticity.cpp.
extern template class CorotationalElasticity<2, IsotropicElasticity<2>>;
extern template class CorotationalElasticity<3, IsotropicElasticity<3>>;
extern template class CorotationalElasticity<2, LawByRegion<IsotropicElasticity<2>>>;
extern template class CorotationalElasticity<3, LawByRegion<IsotropicElasticity<3>>>;

}  // namespace perifrac
