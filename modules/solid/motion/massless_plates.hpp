#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/base/points.hpp"

namespace perifrac {

/// Rigid plates on mirrored faces of a body that moves. They have no mass: each is where its row of
/// the equations is in equilibrium.
class MasslessPlates {
 public:
  /// What unknowns u, alone, do: the force on every unknown [N], and the pore volume that they open
  /// at every point, per unit.
  using Apply = std::function<void(std::span<const double> u, std::span<double> force,
                                   std::span<double> pore_volume)>;

  void add(Index unknown) { plates_.push_back({unknown, {}, {}}); }
  /// The stiffness is another one.
  void forget() { rows_are_known_ = false; }
  /// Puts each plate in equilibrium with its load and the pore stress (empty: none), given every
  /// other of the unknowns. `apply` is asked where the stiffness is another one.
  void place(std::span<const double> load, std::span<const double> pore_stress, std::size_t points,
             const Apply& apply, std::vector<double>& unknowns);

 private:
  using Row = std::vector<std::pair<Index, double>>;
  struct Plate {
    Index unknown;
    Row stiffness;   ///< other plates apart [N/m]
    Row dilatation;  ///< what its force has of pore stress, by points
  };

  void find_rows(std::size_t unknowns, std::size_t points, const Apply& apply);

  std::vector<Plate> plates_;
  Eigen::MatrixXd compliance_;  ///< inverse of the plates' own stiffness [m/N]
  bool rows_are_known_ = false;
};

}  // namespace perifrac
