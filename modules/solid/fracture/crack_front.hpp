#pragma once

#include <span>
#include <vector>

#include "core/body/body.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/fracture/crack_plane.hpp"
#include "modules/solid/fracture/crack_state.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/fracture_energy.hpp"
#include "modules/solid/fracture/tip_law.hpp"

namespace perifrac {

/// The fronts of a body's plane cracks in 3D. A crack grows in its plane, facet by facet, where the
/// opening about 1.5 spacings behind its front has grown to the tip's asymptote (tip_law.hpp): that
/// of toughness, and of viscosity and Carter's leak-off for the front's speed where fluid is there.
/// The front is taken to lie evenly through the squares (CrackPlane::behind_front). Under fluid of
/// fixed volume a whole square takes the energy release down on its way: the mean of its beginning
/// and end counts, by what the last squares did.
class CrackFront {
 public:
  CrackFront(const Body<3>& body, CutBody<3>& cracked, FractureEnergy<3> fracture_energy);

  void start(std::span<const CrackFacet<3>> seeds, double t);

  /// How close the fronts are to growth, the largest: 1 at it.
  double find_readiness(const CrackState<3>& state);
  /// Of what was found ready the squares nearest to their front become facets, one for every fifty
  /// that there are, or one; returns the energy that they take [J].
  double grow(const CrackState<3>& state);

  void visit_state(StateVisitor& visitor);

 private:
  /// A facet that tells of the front beside a square, and by how much.
  struct Behind {
    Index facet;
    double distance;  ///< behind the front [m]
    double weight;
  };
  /// A square that may be next.
  struct Next {
    CrackFacet<3> facet;
    TipLaw law;
    double behind_front;  ///< its middle [spacing]
    double radius;        ///< of the crack [m]
    std::vector<Behind> behind;
    double readiness = 0.0;
  };

  void follow_facets();
  void find_next();
  std::vector<Next> choose() const;
  std::vector<Behind> behind(const CrackPlane& plane, const CrackPlane::Cell& cell) const;
  double readiness(const Next& next, const CrackState<3>& state) const;
  double intensity_at_fixed_volume(const std::vector<Behind>& behind);

  const Body<3>& body_;
  CutBody<3>& cracked_;
  FractureEnergy<3> fracture_energy_;
  // State.
  std::vector<double> since_;     ///< by facet: when it was cut [s]
  double intensity_ratio_ = 1.0;  ///< by the last square, at fixed volume
  // Of the facets that there are.
  std::vector<CrackPlane> planes_;
  std::vector<Next> next_;
  std::uint64_t version_ = 0;
};

}  // namespace perifrac
