#pragma once

#include <span>
#include <vector>

#include "core/operators/point_stiffness.hpp"
#include "modules/solid/material/elastic_operator.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// An elastic material whose bonds may break: what a solid that cracks needs beyond
/// ElasticOperator. Its energy is a sum over points, each on the bonds that the point has left.
template <int D>
class BreakableElasticity : public ElasticOperator<D> {
 public:
  /// Takes the displacements that gradient_at(), stress_at() and point_energy() are of; apply()
  /// does so too.
  virtual void look_at(std::span<const double> u) = 0;
  /// Gradient of the displacement at a point.
  virtual Tensor<D, D> gradient_at(Index i) const = 0;

  /// The stress at a point that does work on a uniform gradient, initial stress apart [Pa];
  /// `gradient` is gradient_at(i).
  virtual Tensor<D, D> stress_at(Index i, const Tensor<D, D>& gradient) const {
    return law(i).stress(gradient);
  }

  /// Adds the unknowns that gradient_at() and point_energy() of point i depend on.
  virtual void append_unknowns(Index i, std::vector<Index>& unknowns) const = 0;

  /// What the energy of point i alone adds to the stiffness.
  virtual PointStiffness point_stiffness(Index i) const = 0;

  /// The energy of point i alone at u, which is looked at.
  virtual double point_energy(Index i, std::span<const double> u) const = 0;

  /// Bonds of these points broke: their weights are 0 in the family now.
  virtual void update(std::span<const Index> points) = 0;

  /// The elastic constants at a point.
  virtual const IsotropicElasticity<D>& law(Index i) const = 0;
};

}  // namespace perifrac
