#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/solid/equilibrium/tip_search.hpp"
#include "modules/solid/fracture/crack_shape.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/energy_release.hpp"
#include "modules/solid/fracture/even_loads.hpp"
#include "modules/solid/fracture/partial_cuts.hpp"

namespace perifrac {

/// Of even loads of 1 Pa on the faces of a crack, at its tip.
struct EvenTip {
  double root_of_j = 0.0;  ///< 0: not known
  ModeAnswer modes{};
  double slid = 0.0;  ///< by a shear [m/Pa]; 0: not known
};

/// A tip within its facet, and what is known of it while it crosses that.
struct MovingTip {
  CrackTip at{};      ///< where its facet begins
  Index facet = -1;   ///< that it is within
  bool ends = false;  ///< with this facet
  Index nearest = -1;
  double part = 0.0;         ///< of its facet that lay behind it as the window began
  double rate = 0.0;         ///< at which that grew last [1/s]
  double per_spacing = 0.0;  ///< spacing over half the crack's length
  CutLoad load{};            ///< when last booked

  // Of even loads of 1 Pa on the crack's faces; the first of two as its facet begins, the other as
  // it ends:
  std::array<EvenTip, 2> even{};
  std::int64_t facets = 0;  ///< that the body had when the other was asked
  double release = 0.0;     ///< of its facet, whole, times 2 [m^2/Pa]
  /// Opening of the last facet and the one before, with its own not cut and cut [m].
  std::array<double, 2> held{}, cut{};
  std::array<double, 2> sheared_held{}, sheared_cut{};  ///< likewise, by a shear

  /// Without its facet and with it; empty where the crack does not turn sharply near it,
  /// intensities where it does not without its facet.
  std::array<CrackShape, 2> shapes{};
  double scale = 0.0;  ///< of the shape at the end of the facet before; 0: not known

  TipSearch search{};
  double expected_rate = 0.0;  ///< as rate, where the window is tried again [1/s]

  /// How far its facet is open. Under one load the energy release of a crack goes as its length.
  double opened(double crossed) const {
    return crossed + 0.5 * per_spacing * crossed * (crossed - 1.0);
  }
  /// It has crossed its facet.
  CrackTip end(const CutBody<2>& body) const {
    return {body.facets()[facet][1], body.jumps()[facet].tangents[0], facet, at.facet};
  }
};

void visit_moving_tips(StateVisitor& visitor, std::vector<MovingTip>& tips);

}  // namespace perifrac
