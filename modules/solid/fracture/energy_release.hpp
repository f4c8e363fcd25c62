#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "modules/solid/fracture/crack_state.hpp"
#include "modules/solid/fracture/cut_body.hpp"

namespace perifrac {

/// A tip of a crack in 2D.
struct CrackTip {
  Vector<2> place;      ///< [m]
  Vector<2> direction;  ///< of unit length, ahead
  Index facet;          ///< the one that ends here
  Index before;         ///< the one behind that; no_facet: none
};

/// Mean jumps of the faces one to four spacings behind a tip, in the frame of the mean direction in
/// which these run. A tip that has left that direction by one facet is drawn back to it by as much
/// (K_II = K_I angle / 2), which a frame of its last facet would see twice.
struct TipJump {
  double opening;        ///< [m]
  double sliding;        ///< positive turns the crack to its right [m]
  double turn_to = 0.0;  ///< from the tip's direction to that of the frame, to the left [rad]

  /// Faces that touch are apart by rounding.
  bool is_open() const { return opening > 1e-9 * std::abs(sliding); }
  /// What K_II / K_I of the tip itself is beyond that in the frame.
  double more_at_tip() const { return -0.5 * turn_to; }
};

/// Stress intensities of the modes at a tip, in a common unit.
struct TipModes {
  double opening;  ///< K_I
  double sliding;  ///< K_II, positive turns the crack to its right
};

/// What a crack has at a tip, per length of its front.
struct TipLoad : TipJump {
  double energy_release;  ///< J, what growth straight ahead would set free [J/m^2]
};

/// J as an integral over the points around the tip (Li, Shih & Needleman 1985; with inertia
/// Nakamura, Shih & Freund 1985), from the remaining bonds' gradients and the whole energy of every
/// point:
///   J = sum V [(grad u^T sigma) grad q . d - W d . grad q + rho u'' . (grad u d) q]
///       - int q (p dw/ds + tau dv/ds) ds,
/// q = 1 within a spacing of the tip and 0 beyond `radius`, 4.5 spacings, less where another tip is
/// nearer: two that run at each other have none together. p and tau are what the faces carry, w
/// and v their jumps, s along the crack to the tip. Of displacements from the state at rest, so
/// that an initial stress counts as what faces are relieved of. With a pore stress a, sigma is the
/// total stress, W is less a theta, and there is
///   + sum V theta (d . grad a) q,
/// for a field that is held while the crack grows makes the rock another along the crack. The
/// kinetic energy T is left out: its two terms, -T d . grad q and -rho u' . (grad u' d) q, are the
/// integral of -d . grad(T q), which vanishes along a crack but for what a tip carries along with
/// it, a part of (speed of the tip / speed of sound)^2.
class EnergyRelease {
 public:
  /// `holes` of the rock, which no ring that can be avoided looks into.
  EnergyRelease(CutBody<2>& body, double spacing, std::vector<Face> holes = {});

  /// `unknowns`: all displacements; `pressure`: on the faces, by facet [Pa]; `pore_stress`: of all
  /// points [Pa], or empty; `shear`: of friction on the faces, by facet [Pa], or empty.
  TipLoad at(const CrackTip& tip, std::span<const double> unknowns, const Eigen::VectorXd& pressure,
             std::span<const double> pore_stress = {}, const PointInertia<2>& inertia = {},
             std::span<const double> shear = {}) const;
  /// Of the same traction on the faces named, along normal and tangent [Pa], and nothing else.
  TipLoad under(const CrackTip& tip, std::span<const double> unknowns, std::span<const Index> faces,
                const Vector<2>& traction) const;
  /// The cracks near the tip run as it does, within `angle` [rad]: else J, which is of a straight
  /// crack, is not quite that of its tip.
  bool is_straight(const CrackTip& tip, double angle) const;
  /// The unknowns that at() depends on, but for `inertia`.
  std::vector<Index> looks_at(const CrackTip& tip) const;
  /// The jumps alone, from those of all facets along their normal and tangent.
  TipJump jump(const CrackTip& tip, std::span<const Vector<2>> jumps) const;
  /// Of the jump of a facet along its normal and tangent, what parts the faces of a tip that runs
  /// in this direction: across a kink faces slide apart.
  double opening_across(const Vector<2>& ahead, Index facet, const Vector<2>& jump) const;
  /// Another tip that is as open, or the image of this one beyond a plane of symmetry, meets() it.
  bool meets_another(const CrackTip& tip, const Eigen::VectorXd& opening) const;

 private:
  Vector<2> parted(const Vector<2>& ahead, Index facet, const Vector<2>& jump) const;
  /// Rock goes on beyond `distance` [m] from x on all sides.
  bool reaches(const Vector<2>& x, double distance) const;
  double largest_radius(const CrackTip& tip) const;
  double radius(const CrackTip& tip, std::span<const Vector<2>> jumps) const;
  struct OtherTip {
    double away;    ///< of it or its image [m]
    double clear;   ///< as meets() takes it [m]
    double cosine;  ///< of the direction to it
  };
  void for_tips_around(const CrackTip& tip, const std::function<bool(Index)>& counts,
                       const std::function<void(const OtherTip&)>& see) const;
  bool is_end(const Vector<2>& corner) const;
  std::vector<Index> points_around(const Vector<2>& centre, double radius) const;
  Vector<2> jump_at(const Vector<2>& corner, const CrackTip& tip,
                    std::span<const Vector<2>> jumps) const;
  std::vector<Vector<2>> jumps_in(std::span<const double> unknowns) const;
  double of_points(const CrackTip& tip, double radius, std::span<const double> unknowns,
                   std::span<const double> pore_stress, const PointInertia<2>& inertia) const;
  double of_faces(const CrackTip& tip, double radius, std::span<const Vector<2>> jumps,
                  const std::function<Vector<2>(Index)>& load) const;

  CutBody<2>& body_;
  double spacing_;
  std::vector<Face> holes_;
  std::vector<Index> by_x_;  ///< points
  /// By axis: its planes of symmetry, lower and upper, infinite where there is none [m].
  std::array<std::array<double, 2>, 2> mirrors_;
};

/// How far J looks around a tip that is alone in the rock [spacings].
constexpr double largest_ring = 4.5;

/// What the crack was before it turned by more than this, 34 degrees, is no part of how its tip is
/// loaded: until a facet lies beyond the turn that is far enough behind the tip, it goes straight
/// on.
constexpr bool is_other_leg(double cosine) { return cosine < 0.8253; }

/// Two tips run at each other, by the cosine between their directions: what one adds to the other's
/// J is of the other sign.
constexpr bool are_opposed(double cosine) { return cosine <= -0.75; }

/// A tip that runs at this one, in a direction from it with this cosine, lies within any ring that
/// J could be asked on. `clear` [spacings]: how far rock goes on to that tip, or to the plane of
/// symmetry that it is an image beyond.
constexpr bool meets(double clear, double cosine) { return clear < 1.75 && cosine >= 0.5; }

/// As far as their ratio goes: of a tip on a lattice, whose faces slide further than they open.
TipModes modes_of(const TipJump& jump);

/// K_II / K_I; 0 of a tip that is closed.
inline double ratio_of(const TipModes& modes) {
  return modes.opening > 0.0 ? modes.sliding / modes.opening : 0.0;
}

/// The angle by which a crack turns, to the left positive, in the direction of largest hoop stress
/// (Erdogan & Sih 1963); at most 70 degrees. `along`, in the unit of the modes: of a stress T
/// along the crack, less that across it, 4 sqrt(2 s / pi) T; where that is negative it holds a
/// crack to its direction, so that K_II vanishes once the crack has gone on by s (Amestoy & Leblond
/// 1992: K_II + K_I angle / 2 - 2 sqrt(2 s / pi) T angle).
double kink_angle(const TipModes& modes, double along = 0.0);

/// K_I of the crack that has turned so, in the unit of the modes: the intensity of the hoop stress
/// there. It is what toughness is compared with; a closed tip has no K_I.
double kink_intensity(const TipModes& modes);

}  // namespace perifrac
