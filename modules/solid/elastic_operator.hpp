#pragma once

#include <span>

#include <Eigen/SparseCore>

#include "core/geometry/points.hpp"

namespace perifrac {

/// The pore stress that loads a solid: at point i value[i] + slope[i] * dilatation[i] [Pa].
/// Empty spans: none, or no slope.
struct PoreStress {
  std::span<const double> value{};
  std::span<const double> slope{};
};

/// An elastic material on a body's bonds: all that a solid needs to know of it. Displacements are a
/// vector of size(): D blocks of point displacements, then face values (MirrorCondition) [m].
template <int D>
class ElasticOperator {
 public:
  virtual ~ElasticOperator() = default;

  virtual Index size() const = 0;

  /// force = dE/du, the inner force on every unknown [N, per metre in 2D], pore stress included,
  /// and the points' dilatation on the way.
  virtual void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
                     std::span<double> dilatation) = 0;

  /// Stress in the solid without pore stress (effective), tension positive: D * D blocks of points
  /// [Pa].
  virtual void stress(std::span<const double> u, std::span<double> stress) = 0;

  /// The stiffness: apply without pore stress as a matrix.
  virtual Eigen::SparseMatrix<double> assemble() const = 0;

  /// Takes displacements to point dilatations; volume-weighted, its transpose makes force of pore
  /// stress.
  virtual Eigen::SparseMatrix<double> dilatation_matrix() const = 0;

  /// Takes displacements to D * D blocks of point gradients; its transpose makes loads of
  /// tractions.
  virtual Eigen::SparseMatrix<double> gradient_matrix() const = 0;

  /// Stiffness of a point against a change of volume at fixed mean stress [Pa].
  virtual double drained_bulk_modulus(Index i) const = 0;
};

}  // namespace perifrac
