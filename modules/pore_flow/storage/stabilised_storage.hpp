#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/bonds/family.hpp"
#include "core/operators/linear_exact.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "modules/pore_flow/storage/linear_storage.hpp"
#include "modules/pore_flow/storage/roughness_law.hpp"

namespace perifrac {

/// Storage of a linear fluid in rock that answers pressures which vary from point to point too
/// softly: V zeta = V alpha theta + (V S + B) p. B is `strength` dx^2 times the part of the
/// linear-exact operator that linear fields do not have, weighted with alpha^2 times the slope of
/// the dilatation: symmetric, positive semidefinite, nothing on linear pressures, columns that sum
/// to nothing, so that what the body holds is what the points' own storage says (Brezzi and
/// Pitkaranta 1984 for the idea). Its bonds are those of the body with all faces free; bonds that
/// break are taken out. B is small beside what points hold by themselves: pressures are found by
/// conjugate gradients in some fifteen steps at any number of points.
template <int D>
class StabilisedStorage final : public LinearStorage {
 public:
  /// `family` without ghosts; `spacing` dx [m]. `irregular`: points are no lattice, and those near
  /// faces, whose gradients fit what few bonds they have, get more of it.
  StabilisedStorage(PoreMaterials materials, std::shared_ptr<const Family<D>> family,
                    double strength, double spacing, bool irregular = false);

  bool set_dilatation(const DilatationInput& input) override;
  void take_bonds(std::span<const BrokenBond> broken) override;
  bool is_local() const override { return !splits_well_; }
  void pressure(double t, std::span<const double> zeta, std::span<double> p) const override;
  void pressure_change(double t, std::span<const double> zeta, std::span<const double> change,
                       std::span<double> dp, double tolerance) override;
  void add_pattern_to(Eigen::SparseMatrix<double>& matrix) const override;
  void add_to(Eigen::SparseMatrix<double>& matrix, double t, std::span<const double> zeta,
              std::span<const double> volume) override;
  double energy_between_points(std::span<const double> p) const override;

 private:
  RoughnessLaws<D> laws() const;
  const Eigen::SparseMatrix<double>& between() const;
  void find_own();
  /// (own + B) x_ = right_side_, from x_ on. Throws NumericalError.
  void solve(double t, double tolerance) const;

  std::shared_ptr<const Family<D>> intact_;
  double scale_;                    ///< strength dx^2 [m^2]
  bool splits_well_;                ///< what a pass leaves of any error is below 0.68 of it
  std::vector<double> answer_;      ///< alpha^2 slope by point [1/Pa]
  std::vector<double> raise_;       ///< a factor by point; empty: 1
  std::vector<BrokenBond> broken_;  ///< of the bonds of roughness_
  mutable LinearExactOperator<D, RoughnessLaws<D>> roughness_;  ///< B
  Eigen::VectorXd own_;                                         ///< V (S + alpha^2 slope)
  Eigen::VectorXd inverse_;  ///< of what is near to the diagonal of own + B
  mutable ConjugateGradients gradients_;
  mutable Eigen::VectorXd right_side_, x_, residual_;  ///< workspace
  mutable Eigen::VectorXd last_right_side_,
      last_p_;  ///< of pressure() since the input came, if any
  mutable std::optional<Eigen::SparseMatrix<double>> between_;  ///< B, where it was asked for
};

}  // namespace perifrac
