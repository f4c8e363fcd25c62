#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/SparseCore>

#include "core/base/packet.hpp"
#include "core/base/points.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

class NonlinearResponse;

/// The pore stress that loads a solid: at point i value[i] + slope[i] * dilatation[i] [Pa].
/// Empty spans: none, or no slope.
struct PoreStress {
  std::span<const double> value{};
  std::span<const double> slope{};
};

/// Calls use(at), at(i, dilatation) being the pore stress of point i, or of a packet of points, so
/// that its kind is asked for once and not at every point.
template <class Use>
void with_pore_stress(const PoreStress& pore, Use&& use) {
  const double* const value = pore.value.data();
  const double* const slope = pore.slope.data();
  if (value == nullptr) {
    use([](auto, const auto& dilatation) { return std::decay_t<decltype(dilatation)>{}; });
  } else if (slope == nullptr) {
    use([=](auto i, const auto&) { return value_at(value, i); });
  } else {
    use([=](auto i, const auto& dilatation) {
      return value_at(value, i) + value_at(slope, i) * dilatation;
    });
  }
}

/// An elastic material on a body's bonds: all that a solid needs to know of it. Displacements are a
/// vector of size(): D blocks of point displacements, then face values (MirrorCondition) [m].
template <int D>
class ElasticOperator {
 public:
  virtual ~ElasticOperator() = default;

  virtual Index size() const = 0;

  /// force = dE/du, the inner force on every unknown [N, per metre in 2D], pore stress included,
  /// and the points' dilatation on the way (empty: it is not asked for).
  virtual void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
                     std::span<double> dilatation) = 0;

  /// The same for displacements that are small: linear in u.
  virtual void apply_small(std::span<const double> u, const PoreStress& pore,
                           std::span<double> force, std::span<double> dilatation) {
    apply(u, pore, force, dilatation);
  }

  /// The stiffness times u: apply_small() without pore stress and initial stress.
  virtual void apply_stiffness(std::span<const double> u, std::span<double> force,
                               std::span<double> dilatation = {}) = 0;

  /// dE/du without pore stress and initial stress, of displacements of any size that it bears:
  /// where it is linear, the stiffness times u.
  virtual void respond(std::span<const double> u, std::span<double> force,
                       std::span<double> dilatation = {}) {
    apply_stiffness(u, force, dilatation);
  }

  /// Adds the force of a pore stress [Pa] on every unknown [N].
  virtual void add_pore_force(std::span<const double> pore_stress, std::span<double> force) = 0;

  /// E(u) without pore stress and initial stress [J, per metre in 2D]; `force` is that of
  /// respond().
  virtual double energy(std::span<const double> u, std::span<const double> force) {
    double sum = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) sum += 0.5 * u[k] * force[k];
    return sum;
  }

  /// Inner force at u = 0 [N]: that of the initial stress. What lies behind the faces of the intact
  /// body bears it, so that a solid counts it, once, among its external forces.
  std::vector<double> initial_force() {
    std::vector<double> rest(size(), 0.0), force(size());
    apply(rest, {}, force, {});
    return force;
  }

  /// Stress in the solid without pore stress (effective), initial stress included, tension
  /// positive: D * D blocks of points [Pa].
  virtual void stress(std::span<const double> u, std::span<double> stress) = 0;

  /// The stiffness as a matrix.
  virtual Eigen::SparseMatrix<double> assemble() const = 0;

  /// What makes loads of tractions.
  virtual Eigen::VectorXd force_of_stress(const Eigen::VectorXd& stress) const = 0;

  /// The elastic constants at a point.
  virtual const IsotropicElasticity<D>& law(Index i) const = 0;

  /// How apply() goes over the bonds, and why: a line for whoever asks what is slow.
  virtual std::string path() const = 0;

  /// Stiffness of a point against a change of volume at fixed mean stress [Pa].
  virtual double drained_bulk_modulus(Index i) const = 0;

  /// What it tells beyond a linear operator; none: it is linear, and remembers nothing.
  virtual NonlinearResponse* nonlinear() { return nullptr; }

  /// 1, the pore stress pushes points apart; -1 in formulas that have its sign wrong.
  virtual double pore_sign() const { return 1.0; }
};

}  // namespace perifrac
