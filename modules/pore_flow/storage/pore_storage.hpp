#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

#include <Eigen/SparseCore>

#include "core/bonds/bond_state.hpp"
#include "modules/pore_flow/material/pore_material.hpp"

namespace perifrac {

/// The dilatation that pore flow is told for a window: at time t and pore stress x it is
/// value + rate (t - end) + slope x. Empty spans: no dilatation at all.
struct DilatationInput {
  std::span<const double> value{};
  std::span<const double> rate{};
  std::span<const double> slope{};
  double end = 0.0;

  /// What does not answer the pore stress.
  double at(Index i, double t) const {
    return value.empty() ? 0.0 : value[i] + (t - end) * rate[i];
  }
};

/// How the fluid content zeta of every point, its pressure and its dilatation belong together.
/// zeta is the fluid gained per volume of rock, as volume at zero pressure.
class PoreStorage {
 public:
  explicit PoreStorage(PoreMaterials materials) : materials_(std::move(materials)) {}
  virtual ~PoreStorage() = default;

  const PoreMaterials& materials() const { return materials_; }

  /// Takes the input of the next window; spans must stay valid. True where its slope is another.
  virtual bool set_dilatation(const DilatationInput& input) = 0;

  /// These bonds are broken, and no others; for storage that reaches from point to point.
  virtual void take_bonds(std::span<const BrokenBond>) {}

  /// False: a point's pressure follows from its neighbours' fluid content too, and by so much that
  /// no single pressure answers its own dilatation much; undrained_slope() does not say it.
  virtual bool is_local() const { return true; }

  /// Pressure p at fluid content zeta [Pa].
  virtual void pressure(double t, std::span<const double> zeta, std::span<double> p) const = 0;

  /// d(zeta)/d(potential) [1/Pa] with the dilatation's answer; see PoreFluid::potential(). Of the
  /// rock at rest where zeta is empty. Valid until the next call.
  virtual std::span<const double> effective_storage(double t, std::span<const double> zeta) = 0;

  /// Of what is sought: as near to a solution as rounding lets it be.
  static constexpr double to_rounding = 1e-14;

  /// By how much the potential changes with zeta, near zeta, which may be empty as above, where
  /// points have to be solved for together to `tolerance` [Pa].
  virtual void pressure_change(double t, std::span<const double> zeta,
                               std::span<const double> change, std::span<double> dp,
                               double tolerance);

  /// Makes room in a matrix on points for all that add_to() adds.
  virtual void add_pattern_to(Eigen::SparseMatrix<double>&) const {}

  /// Adds volume times d(zeta)/d(potential), as a matrix on points.
  virtual void add_to(Eigen::SparseMatrix<double>& matrix, double t, std::span<const double> zeta,
                      std::span<const double> volume);

  /// zeta of point i at pressure p [Pa] and no dilatation.
  virtual double content(Index i, double p) const = 0;

  /// zeta of point i at pressure p [Pa] and the window's dilatation at time t, its answer included.
  virtual double content(double t, Index i, double p) const = 0;

  /// d(pore stress)/d(dilatation) of point i [Pa] while no fluid moves.
  virtual double undrained_slope(Index i, double zeta, double p) const = 0;

  /// Energy of point i per volume of rock [J/m^3]: its rates are potential d(zeta) - pore stress
  /// d(dilatation).
  virtual double energy(Index i, double zeta, double p) const = 0;

  /// Energy beyond that of the points [J, per metre in 2D].
  virtual double energy_between_points(std::span<const double>) const { return 0.0; }

 private:
  PoreMaterials materials_;
};

/// Makes the storage for a dilatation of this slope; null where what there is will do.
using StorageChoice = std::function<std::unique_ptr<PoreStorage>(std::span<const double> slope)>;

}  // namespace perifrac
