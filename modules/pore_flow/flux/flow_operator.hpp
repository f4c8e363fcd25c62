#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include <Eigen/SparseCore>

#include "core/bonds/family.hpp"

namespace perifrac {

/// A discretisation of Darcy flow in space: all that the equations of pore flow need to know of it.
/// Pressures are a vector of size(): of the points, then of the faces (MirrorCondition).
template <int D>
class FlowOperator {
 public:
  virtual ~FlowOperator() = default;

  virtual const Family<D>& family() const = 0;
  virtual Index size() const = 0;

  /// Of point i, the mean over all directions; the factors of scale_mobility apart [m^2/(Pa s)].
  virtual double mobility(Index i) const = 0;

  /// Multiplies the mobility of every point by a factor, from now on; for fluids whose density
  /// changes. Throws std::logic_error where the operator was not made for it.
  virtual void scale_mobility(std::span<const double> factor) {
    throw std::logic_error("an operator of constant mobility, asked to scale it by " +
                           std::to_string(factor.size()) + " factors");
  }

  /// Takes a family of the same bonds in which others are broken, of weight 0, at these points.
  virtual void take_bonds(std::shared_ptr<const Family<D>> family,
                          std::span<const Index> points) = 0;

  /// outflow = H p: volume that leaves every point per time, and that enters through every face
  /// value's faces [m^3/s, per metre in 2D].
  virtual void apply(std::span<const double> p, std::span<double> outflow) = 0;

  /// Darcy velocity at the points, D blocks [m/s].
  virtual void velocity(std::span<const double> p, std::span<double> velocity) = 0;

  /// How apply() goes over the bonds, and why.
  virtual std::string path() const { return "bond by bond: not the conservative operator"; }

  /// H as a matrix.
  virtual Eigen::SparseMatrix<double> assemble() const = 0;

  /// A symmetric positive semidefinite matrix with the spectrum of H up to a factor and fewer
  /// entries.
  virtual Eigen::SparseMatrix<double> preconditioner() const = 0;
};

}  // namespace perifrac
