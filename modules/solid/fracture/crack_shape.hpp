#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/energy_release.hpp"

namespace perifrac {

/// K_I and K_II at a tip behind which its crack turns sharply, of the even stress, in the plane,
/// that comes nearest to the jumps there. How the faces answer to such stresses says the body
/// itself, on its lattice; how K_I and K_II divide, the crack alone in an infinite body, in plane
/// strain, by displacement discontinuities that are constant on elements (Crouch 1976), four to a
/// facet near the tip: of a crack with a kink of 45 degrees within 2 %; how large they are, J,
/// where it is known.
struct CrackShape {
  std::vector<Index> facets;        ///< whose jumps are looked at
  std::vector<double> jumps;        ///< theirs along normal and tangent in turn, by each stress
                                    ///< xx, yy, xy of 1 Pa one after the other [m/Pa]
  std::vector<double> intensities;  ///< K_I and K_II by each, in an infinite body [m^0.5]
  double scale = 0.0;               ///< of K in the body over those

  bool is_known() const { return !facets.empty(); }
  /// K by a stress xx, yy, xy [Pa m^0.5].
  TipModes modes(const Eigen::Vector3d& stress) const;
  /// By an even pressure of 1 Pa on the faces.
  TipModes under_pressure() const { return modes({1.0, 1.0, 0.0}); }
  /// sqrt(J E') by that is this [m^0.5].
  void scale_to(double intensity) {
    const TipModes both = under_pressure();
    scale *= intensity / std::hypot(both.opening, both.sliding);
  }
};

/// It runs straight on to the tip, from all the facets named.
bool is_line(const CutBody<2>& body, const CrackTip& tip, std::span<const Index> crack);

/// Of these facets, those whose jumps say what K is at a tip there.
std::vector<Index> facets_near(const CutBody<2>& body, std::span<const Index> crack,
                               const Vector<2>& tip);

/// `crack`: all facets that hang together with the tip's; `loaded`: these, and those that are to be
/// cut ahead; `facets`: those that are looked at. Its scale is that of how far these open. Empty of
/// a body that does not say how its faces answer.
CrackShape crack_shape(CutBody<2>& body, const CrackTip& tip, std::span<const Index> crack,
                       std::span<const Index> loaded, std::vector<Index> facets,
                       double plane_strain_modulus);

/// The stress xx, yy, xy [Pa] that comes nearest to the jumps of all facets [m], of a crack whose
/// facets' jumps are as far as `share` between those of two shapes. Near the tip faces are relieved
/// of `relief` and carry `pressure` [Pa]; another stress is believed in as far as the jumps stand
/// out of what no even stress says of them, as beside fluid that lags.
Eigen::Vector3d stress_of(const CrackShape& begin, const CrackShape& end, double share,
                          std::span<const Vector<2>> jumps, const Vector<2>& relief,
                          double pressure);

}  // namespace perifrac
