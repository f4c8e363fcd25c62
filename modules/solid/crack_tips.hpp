#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/geometry/body.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/cracked_body.hpp"
#include "modules/solid/energy_release.hpp"

namespace perifrac {

/// What tips need to know of the body at the end of a window.
struct CrackState {
  double t;  ///< [s]
  const CrackedBody::Faces& faces;
  /// Of the fluid at every facet, 0 where it is dry [Pa s]; empty where no fluid is simulated.
  std::span<const double> viscosity;
  /// Carter's coefficient of one side, likewise [m/s^0.5]; empty where nothing leaks by it.
  std::span<const double> leak_off;
  /// Displacements, found when they are asked for.
  std::function<std::span<const double>()> unknowns;

  bool has_fluid() const { return !viscosity.empty(); }
};

/// The tips of a body's cracks: when they go on, where to, and where they end. A tip goes on by one
/// facet of a spacing where J >= Gc or, where a viscous fluid reaches it, where the opening behind
/// it has grown to the tip's asymptote (tip_law.hpp); straight ahead or turned by the kink angle.
/// Where the facet would come close to the end of another it ends there, and so does the tip.
class CrackTips {
 public:
  /// `fracture_energy`: Gc [J/m^2].
  CrackTips(const Body<2>& body, CrackedBody& cracked, double fracture_energy);

  /// Takes the ends of the seeds that no other seed touches and that lie in the rock.
  void start(std::span<const CrackFacet<2>> seeds, double t);

  /// How close the tips are to growth, the largest: 1 at it.
  double find_readiness(const CrackState& state);
  /// Those that were found ready go on; returns the length of the new facets [m].
  double grow(const CrackState& state);

  void visit_state(StateVisitor& visitor);

 private:
  struct Tip {
    CrackTip at;
    double since;  ///< when it came there [s]
    bool grows;    ///< some bond lies ahead
    /// K_I under fluid of fixed volume, over that before the last step: falls as the crack grows.
    double intensity_ratio = 1.0;
    double readiness = 0.0;
  };

  double readiness(const Tip& tip, const CrackState& state) const;
  double intensity_at_fixed_volume(Index facet) const;
  CrackFacet<2> next_facet(const CrackTip& tip, double turn) const;
  bool joins(const CrackFacet<2>& facet, const CrackTip& tip, Vector<2>& end) const;
  double advance(Tip& tip, double turn, double t);

  const Body<2>& body_;
  CrackedBody& cracked_;
  double fracture_energy_;
  EnergyRelease energy_release_;
  std::vector<Tip> tips_;
};

/// A tip is ready from here on: it goes on within this of its criterion.
inline constexpr double ready = 0.995;

}  // namespace perifrac
