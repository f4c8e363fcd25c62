#pragma once

#include <optional>
#include <utility>

#include "core/operators/linear_exact.hpp"
#include "modules/solid/elastic_operator.hpp"

namespace perifrac {

/// `material.type: linear_exact`: the linear-exact operator with a law of elasticity.
template <int D, class Law>
class LinearExactElasticity final : public ElasticOperator<D> {
 public:
  /// `initial_stress`: normal stresses of the body at rest, tension positive [Pa].
  explicit LinearExactElasticity(LinearExactOperator<D, Law> op,
                                 std::optional<Vector<D>> initial_stress = {})
      : operator_(std::move(op)), initial_stress_(initial_stress) {}

  Index size() const override { return operator_.size(); }

  void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
             std::span<double> dilatation) override {
    with_pore_stress(pore, [&](auto pore_stress) {
      if (initial_stress_) {
        apply_with(u, force, dilatation, pore_stress, [&](auto& stress) { add_initial(stress); });
      } else {
        apply_with(u, force, dilatation, pore_stress, [](auto&) {});
      }
    });
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

  Eigen::SparseMatrix<double> assemble() const override { return operator_.assemble(); }

  Eigen::SparseMatrix<double> dilatation_matrix() const override {
    const Index points = operator_.family().point_count;
    Eigen::SparseMatrix<double> trace(points, D * D * points);
    trace.reserve(Eigen::VectorXi::Ones(D * D * points));
    for (int a = 0; a < D; ++a) {
      for (Index i = 0; i < points; ++i) trace.insert(i, (a * D + a) * points + i) = 1.0;
    }
    return trace * gradient_matrix();
  }

  Eigen::SparseMatrix<double> gradient_matrix() const override {
    return operator_.gradient_matrix();
  }

  double drained_bulk_modulus(Index i) const override {
    return law_at(operator_.law(), i).drained_bulk_modulus();
  }

 private:
  void add_initial(Tensor<D, D>& stress) const {
    for (int a = 0; a < D; ++a) stress[a * D + a] += (*initial_stress_)[a];
  }

  template <class PoreStressAt, class AddInitial>
  void apply_with(std::span<const double> u, std::span<double> force, std::span<double> dilatation,
                  PoreStressAt&& pore_stress, AddInitial&& add_initial) {
    operator_.apply(u, force, [&](Index i, const Tensor<D, D>& gradient, Tensor<D, D>& stress) {
      double theta = 0.0;
      for (int a = 0; a < D; ++a) theta += gradient[a * D + a];
      dilatation[i] = theta;
      const double pressure = pore_stress(i, theta);
      for (int a = 0; a < D; ++a) stress[a * D + a] -= pressure;
      add_initial(stress);
    });
  }

  LinearExactOperator<D, Law> operator_;
  std::optional<Vector<D>> initial_stress_;
};

}  // namespace perifrac
