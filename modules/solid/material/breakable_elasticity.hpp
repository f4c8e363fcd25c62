#pragma once

#include <span>
#include <vector>

#include "core/operators/point_stiffness.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

template <int D>
class BreakableElasticity;

/// A material under given displacements, point by point. Until it is deformed otherwise: by its
/// apply(), stress() or deform().
template <int D>
class DeformedMaterial {
 public:
  DeformedMaterial(const BreakableElasticity<D>& material, std::span<const double> u)
      : material_(material), u_(u) {}

  /// Of the displacement at a point.
  Tensor<D, D> gradient(Index i) const { return material_.gradient_at(i); }
  /// The stress at a point that does work on a uniform gradient, initial stress apart [Pa];
  /// `gradient` is gradient(i).
  Tensor<D, D> stress(Index i, const Tensor<D, D>& gradient) const {
    return material_.stress_at(i, gradient);
  }
  /// Of point i alone.
  double energy(Index i) const { return material_.point_energy(i, u_); }

 private:
  const BreakableElasticity<D>& material_;
  std::span<const double> u_;
};

/// An elastic material whose bonds may break: what a solid that cracks needs beyond
/// ElasticOperator. Its energy is a sum over points, each on the bonds that the point has left.
template <int D>
class BreakableElasticity : public ElasticOperator<D> {
 public:
  /// Under the displacements u, which must stay.
  DeformedMaterial<D> deform(std::span<const double> u) {
    take(u);
    return {*this, u};
  }

  /// Adds the unknowns that gradient and energy of point i depend on.
  virtual void append_unknowns(Index i, std::vector<Index>& unknowns) const = 0;

  /// What the energy of point i alone adds to the stiffness.
  virtual PointStiffness point_stiffness(Index i) const = 0;

  /// Bonds of these points broke: their weights are 0 in the family now.
  virtual void update(std::span<const Index> points) = 0;

 protected:
  friend class DeformedMaterial<D>;

  /// Takes the displacements that those below are of.
  virtual void take(std::span<const double> u) = 0;
  virtual Tensor<D, D> gradient_at(Index i) const = 0;
  virtual Tensor<D, D> stress_at(Index i, const Tensor<D, D>& gradient) const {
    return this->law(i).stress(gradient);
  }
  virtual double point_energy(Index i, std::span<const double> u) const = 0;
};

}  // namespace perifrac
