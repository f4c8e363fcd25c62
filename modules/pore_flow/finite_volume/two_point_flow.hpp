#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/body/body.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/geometry/cell_faces.hpp"
#include "modules/pore_flow/boundary/held_point.hpp"
#include "modules/pore_flow/flux/flow_operator.hpp"
#include "modules/pore_flow/material/anisotropic_darcy_law.hpp"

namespace perifrac {

/// What lies at the faces of the body that have no layer behind them.
template <int D>
struct OuterWalls {
  FaceSet sealed;
  MirrorCondition<D, 1> pressures;  ///< numbers the faces of prescribed pressure; has no ghosts
  std::vector<HeldPoint> held;      ///< points of layers; no fluid passes between two that hold
};

/// Finite volumes with two-point fluxes (Eymard, Gallouet and Herbin 2000). Between cells i and j,
///   J_ij = T_ij (p_i - p_j),   1/T_ij = d/(2 A k_i) + d/(2 A k_j),
/// A the area of their wall, d the distance of their points, k_i = n.K_i n the mobility of a cell
/// across it; to a face of prescribed pressure the cell's own half alone. Fluxes are equal and
/// opposite, so mass is exact; H is symmetric, positive semidefinite, one null mode a piece that
/// nothing cuts. Exact for pressures that are linear, on both sides of a border of regions too,
/// where K n points along n: any scalar, and on a lattice tensors along its axes.
///
/// A wall between two cells is cut by what breaks the bond between their points.
template <int D>
class TwoPointFlow final : public FlowOperator<D> {
 public:
  using Law = LawByRegion<AnisotropicDarcyLaw<D>>;

  TwoPointFlow(std::shared_ptr<const Body<D>> body, const CellFaces<D>& walls,
               const OuterWalls<D>& outer, Law law);

  Index point_count() const override { return body_->points().size(); }
  const std::vector<double>& volume() const override { return body_->points().volume; }
  Vector<D> place(Index i) const override { return body_->points().at(i); }
  Index size() const override { return point_count() + face_values_; }
  double mobility(Index i) const override { return law_.at(i).mean_mobility(); }
  void scale_mobility(std::span<const double> factor) override;
  void follow(const BondState<D>& bonds) override;
  void apply(std::span<const double> p, std::span<double> outflow) override;
  /// Fits the fluxes through all walls of a cell but those that are cut, and those on faces with
  /// inflow, which are not known here.
  void velocity(std::span<const double> p, std::span<double> velocity) override;
  std::string path() const override;
  Eigen::SparseMatrix<double> assemble() const override;
  Eigen::SparseMatrix<double> preconditioner() const override { return assemble(); }

 private:
  /// A wall on a face of the body.
  struct Outlet {
    Index cell;
    int face;
    int face_value;  ///< -1: sealed
    double area;
    double conductance;       ///< of the cell's half at factor 1 [m^3/(Pa s), m^2 in 2D]
    double transmissibility;  ///< the same now; 0 where sealed
  };

  double half_conductance(Index cell, const Vector<D>& normal, double area, double length) const;
  void add_walls(const CellFaces<D>& walls, const std::vector<HeldPoint>& held);
  void add_outlets(const CellFaces<D>& walls, const OuterWalls<D>& outer);
  void cut(Index i, Index j);
  void find_transmissibility();

  std::shared_ptr<const Body<D>> body_;
  Law law_;
  int face_values_;
  // Every wall twice, from either cell.
  std::vector<Index> offset_;                 ///< walls of i: offset_[i] .. offset_[i + 1]
  std::vector<Index> other_;                  ///< the cell beyond
  std::vector<double> area_;                  ///< [m^2], in 2D, per metre, its length
  std::vector<double> own_;                   ///< conductance of the cell's own half at factor 1
  std::vector<double> beyond_;                ///< of the other's half
  std::vector<std::uint8_t> open_;            ///< not cut
  std::vector<double> transmissibility_;      ///< [m^3/(Pa s), m^2 in 2D]
  std::vector<Outlet> outlets_;               ///< by cell
  std::vector<std::pair<Index, Index>> far_;  ///< cells beyond the horizon: no bond tells of them
  std::vector<double> factor_;                ///< of the mobility; empty: 1
};

}  // namespace perifrac
