#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/body/body.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/fracture_energy.hpp"
#include "modules/solid/fracture/tensile_strength.hpp"

namespace perifrac {

/// Length of the crack that a uniform tension of the rock's strength pays for, over
/// E' Gc / strength^2: of an inner crack pi s^2 a^2 / E' = Gc 2a, of one at a free face, whose K is
/// 1.1215 s sqrt(pi a), half of 1.1215^2 pi s^2 a^2 / E' = Gc a.
inline constexpr double inner_nucleus = 1.2732, edge_nucleus = 0.5062;
/// Facets of the least nucleus, so that J at one of its tips sees neither the other nor the face.
inline constexpr int least_inner_facets = 5, least_edge_facets = 3;

/// Where cracks begin by themselves: a straight piece of crack, a nucleus, is cut where the normal
/// stress across it, in its mean over the piece, reaches the tensile strength (finite fracture
/// mechanics with the mean stress, Cornetti et al. 2006; Taylor's line method). It is as long as
/// uniform tension pays for, normal to the largest principal stress at a point where that is
/// largest; at a face it opens to outside. Of places that are as ready the shortest nucleus is cut,
/// and of those the first in the body's order. Of places under even stress a random few are looked
/// at.
class CrackNucleation {
 public:
  CrackNucleation(const Body<2>& body, CutBody<2>& cracked, FractureEnergy<2> fracture_energy,
                  const TensileStrength<2>& strength);

  /// How close the body is to a new crack: the largest mean stress over strength. `stress`:
  /// effective, of all points, blocks of components [Pa]. Nothing begins within 4.5 spacings of a
  /// crack, where its tips decide.
  double find_readiness(std::span<const double> stress);
  /// Cuts the nucleus that was found readiest; returns the energy that it takes [J/m].
  double cut();

 private:
  struct Nucleus {
    Vector<2> begin;
    Vector<2> end;
    int facets;
    double readiness;  ///< 0: it would come near a crack
  };
  struct LinePoint {
    double along;      ///< of the line, from the point that it belongs to [m]
    double readiness;  ///< stress across the line over strength
    bool is_above;     ///< the line
    bool near_crack;
  };

  void find_near_cracks();
  bool is_largest(Index i) const;
  Nucleus nucleus_at(Index i, std::span<const double> stress) const;
  std::vector<LinePoint> points_along(const Vector<2>& x, const Vector<2>& normal,
                                      std::span<const double> stress) const;
  std::span<const LinePoint> part_in_body(std::span<const LinePoint> line) const;
  std::pair<double, double> piece_of(std::span<const LinePoint> part, double length) const;
  double readiness_over(std::span<const LinePoint> part, double begin, double end) const;

  const Body<2>& body_;
  CutBody<2>& cracked_;
  FractureEnergy<2> fracture_energy_;
  std::vector<double> strength_;    ///< by point [Pa]
  std::vector<double> readiness_;   ///< by point, of the largest principal stress, in whole units
  double unit_ = 0.0;               ///< of readiness: less is rounding
  std::vector<std::uint8_t> near_;  ///< by point: a crack is
  std::uint64_t looked_at_ = 0;     ///< version of the cracks
  Nucleus readiest_{};
};

}  // namespace perifrac
