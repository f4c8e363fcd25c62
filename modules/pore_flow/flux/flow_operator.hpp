#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "core/bonds/bond_state.hpp"

namespace perifrac {

/// A discretisation of Darcy flow in space: all that the equations of pore flow need to know of it.
/// Pressures are a vector of size(): of the points, then of the faces (MirrorCondition).
template <int D>
class FlowOperator {
 public:
  virtual ~FlowOperator() = default;

  virtual Index point_count() const = 0;
  /// Of the points first, per metre in 2D [m^3].
  virtual const std::vector<double>& volume() const = 0;
  virtual Vector<D> place(Index i) const = 0;
  virtual Index size() const = 0;

  /// Of point i, the mean over all directions; the factors of scale_mobility apart [m^2/(Pa s)].
  virtual double mobility(Index i) const = 0;

  /// Multiplies the mobility of every point by a factor, from now on; for fluids whose density
  /// changes. Throws std::logic_error where the operator was not made for it.
  virtual void scale_mobility(std::span<const double> factor) {
    throw std::logic_error("an operator of constant mobility, asked to scale it by " +
                           std::to_string(factor.size()) + " factors");
  }

  /// No fluid crosses what is broken in the body; what mended, as a state was restored, conducts.
  virtual void follow(const BondState<D>& bonds) = 0;

  /// outflow = H p: volume that leaves every point per time, and that enters through every face
  /// value's faces [m^3/s, per metre in 2D].
  virtual void apply(std::span<const double> p, std::span<double> outflow) = 0;

  /// Darcy velocity at the points, D blocks [m/s].
  virtual void velocity(std::span<const double> p, std::span<double> velocity) = 0;

  /// H is, on the points.
  virtual bool is_symmetric() const { return true; }

  /// How apply() goes over the points and their neighbours, and why.
  virtual std::string path() const = 0;

  /// H as a matrix.
  virtual Eigen::SparseMatrix<double> assemble() const = 0;

  /// A symmetric positive semidefinite matrix with the spectrum of H up to a factor and fewer
  /// entries.
  virtual Eigen::SparseMatrix<double> preconditioner() const = 0;
};

}  // namespace perifrac
