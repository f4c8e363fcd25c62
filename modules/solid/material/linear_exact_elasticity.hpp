#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/eigen_view.hpp"
#include "core/base/small_vector.hpp"
#include "core/operators/linear_exact.hpp"
#include "modules/solid/material/bond_energy.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"

namespace perifrac {

/// `material.type: linear_exact`: the linear-exact operator with a law of elasticity.
template <int D, class Law>
class LinearExactElasticity : public BreakableElasticity<D> {
 public:
  /// `initial_stress`: normal stresses of the body at rest, tension positive [Pa].
  explicit LinearExactElasticity(LinearExactOperator<D, Law> op,
                                 std::optional<Vector<D>> initial_stress = {})
      : operator_(std::move(op)), initial_stress_(initial_stress) {}

  Index size() const override { return operator_.size(); }

  void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
             std::span<double> dilatation) override {
    if (pore.value.empty() && dilatation.empty() && !initial_stress_) {
      LinearExactElasticity::apply_stiffness(u, force);
      return;
    }
    with_pore_stress(pore, [&](auto pore_stress) {
      if (initial_stress_) {
        apply_with(u, force, dilatation, pore_stress, [&](auto& stress) { add_initial(stress); });
      } else {
        apply_with(u, force, dilatation, pore_stress, [](auto&) {});
      }
    });
  }

  void apply_stiffness(std::span<const double> u, std::span<double> force,
                       std::span<double> dilatation = {}) override {
    if (!dilatation.empty() && !operator_.family().curved) {
      with_pore_stress({},
                       [&](auto none) { apply_with(u, force, dilatation, none, [](auto&) {}); });
      return;
    }
    operator_.apply(u, force);
    for (const ThinPoint& thin : thin_points_) add_force(thin.stiffness, u, force);
    if (dilatation.empty()) return;
    operator_.look_at(u);
    for_each_point(operator_.family().point_count,
                   [&](Index i) { dilatation[i] = trace(operator_.gradient_at(i)); });
  }

  void add_pore_force(std::span<const double> pore_stress, std::span<double> force) override {
    if (operator_.family().curved) {
      const Index points = operator_.family().point_count;
      Eigen::VectorXd stress = Eigen::VectorXd::Zero(D * D * points);
      for (Index i = 0; i < points; ++i) {
        for (int a = 0; a < D; ++a) {
          stress[(a * D + a) * points + i] = operator_.family().volume[i] * pore_stress[i];
        }
      }
      view(force) += force_of_stress(stress);
      return;
    }
    const std::vector<double> rest(size(), 0.0);
    std::vector<double> inner(size());
    operator_.apply(rest, inner, [&](auto i, const auto&, auto& stress) {
      add_to_diagonal(stress, -value_at(pore_stress.data(), i));
    });
    view(force) -= view(inner);
  }

  void stress(std::span<const double> u, std::span<double> stress) override {
    operator_.gradient(u, stress);
    const Index points = operator_.family().point_count;
    for_each_point(points, [&](Index i) {
      Tensor<D, D> gradient;
      for (int k = 0; k < D * D; ++k)
        gradient[k] = stress[static_cast<std::size_t>(k) * points + i];
      Tensor<D, D> result = law_at(operator_.law(), i).stress(gradient);
      if (initial_stress_) add_initial(result);
      for (int k = 0; k < D * D; ++k) stress[static_cast<std::size_t>(k) * points + i] = result[k];
    });
  }

  Eigen::SparseMatrix<double> assemble() const override {
    return sum_of_points(*this, operator_.family().point_count);
  }

  Eigen::VectorXd force_of_stress(const Eigen::VectorXd& stress) const override {
    return operator_.force_of_stress(stress);
  }
  std::string path() const override { return operator_.path(); }

  double drained_bulk_modulus(Index i) const override { return law(i).drained_bulk_modulus(); }

  const IsotropicElasticity<D>& law(Index i) const override {
    const auto& own = law_at(operator_.law(), i);
    if constexpr (requires { own.isotropic(); }) {
      return own.isotropic();
    } else {
      return own;
    }
  }

  void append_unknowns(Index i, std::vector<Index>& unknowns) const override {
    operator_.append_unknowns(i, unknowns);
  }

  PointStiffness point_stiffness(Index i) const override {
    const auto thin = find_thin(i);
    return is_at(thin, i) ? thin->stiffness : operator_.point_stiffness(i);
  }

  void update(std::span<const Index> points) override {
    operator_.update(points);
    for (const Index i : points) {
      const auto thin = find_thin(i);
      const auto place = is_at(thin, i) ? thin_points_.erase(thin) : thin;
      if (!is_thin(operator_.family(), i)) continue;
      thin_points_.insert(
          place, {i, bond_energy_stiffness(operator_.family(), operator_.mirror(), law(i), i)});
    }
  }

 protected:
  void take(std::span<const double> u) override { operator_.look_at(u); }
  Tensor<D, D> gradient_at(Index i) const override { return operator_.gradient_at(i); }

  double point_energy(Index i, std::span<const double> u) const override {
    const auto thin = find_thin(i);
    if (!is_at(thin, i)) return operator_.energy(i);
    const std::vector<Index>& unknowns = thin->stiffness.unknowns;
    Eigen::VectorXd own(static_cast<Eigen::Index>(unknowns.size()));
    for (std::size_t k = 0; k < unknowns.size(); ++k) own[k] = u[unknowns[k]];
    return 0.5 * own.dot(thin->stiffness.matrix * own);
  }

  LinearExactOperator<D, Law> operator_;

 private:
  /// A point whose family does not span space any more: its bonds have the energy of the linear
  /// peridynamic solid instead, which needs no gradient.
  struct ThinPoint {
    Index point;
    PointStiffness stiffness;
  };

  std::vector<ThinPoint>::const_iterator find_thin(Index i) const {
    return std::ranges::lower_bound(thin_points_, i, {}, &ThinPoint::point);
  }
  bool is_at(std::vector<ThinPoint>::const_iterator thin, Index i) const {
    return thin != thin_points_.end() && thin->point == i;
  }

  template <class Number>
  void add_initial(std::array<Number, D * D>& stress) const {
    for (int a = 0; a < D; ++a) stress[a * D + a] += (*initial_stress_)[a];
  }

  template <class PoreStressAt, class AddInitial>
  void apply_with(std::span<const double> u, std::span<double> force, std::span<double> dilatation,
                  PoreStressAt&& pore_stress, AddInitial&& add_initial) {
    const auto add = [&](auto i, const auto& gradient, auto& stress) {
      const auto theta = trace(gradient);
      if (!dilatation.empty()) set_value(dilatation.data(), i, theta);
      add_to_diagonal(stress, -pore_stress(i, theta));
      add_initial(stress);
    };
    operator_.apply(u, force, add, dilatation);
    for (const ThinPoint& thin : thin_points_) add_force(thin.stiffness, u, force);
  }

  static void add_force(const PointStiffness& stiffness, std::span<const double> u,
                        std::span<double> force) {
    for (std::size_t row = 0; row < stiffness.unknowns.size(); ++row) {
      for (std::size_t column = 0; column < stiffness.unknowns.size(); ++column) {
        force[stiffness.unknowns[row]] +=
            stiffness.matrix(row, column) * u[stiffness.unknowns[column]];
      }
    }
  }

  std::optional<Vector<D>> initial_stress_;
  std::vector<ThinPoint> thin_points_;  ///< in the order of their points
};

// Compiled once, in linear_exact_elasticity.cpp.
extern template class LinearExactOperator<2, IsotropicElasticity<2>>;
extern template class LinearExactOperator<3, IsotropicElasticity<3>>;
extern template class LinearExactElasticity<2, IsotropicElasticity<2>>;
extern template class LinearExactElasticity<3, IsotropicElasticity<3>>;
extern template class LinearExactElasticity<2, LawByRegion<IsotropicElasticity<2>>>;
extern template class LinearExactElasticity<3, LawByRegion<IsotropicElasticity<3>>>;

}  // namespace perifrac
