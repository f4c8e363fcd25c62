#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/geometry/bond_state.hpp"
#include "modules/solid/breakable_elasticity.hpp"
#include "modules/solid/face_jump.hpp"
#include "modules/solid/initial_stress.hpp"

namespace perifrac {

/// A linear elastic body in plane strain while cracks cut its bonds facet by facet: what its cracks
/// are, whatever moves it.
class CutBody {
 public:
  /// `family` is the one of `elastic`, with nothing broken. New faces are relieved
  /// of the `initial_stress`. Writes `bonds`.
  CutBody(std::shared_ptr<Family<2>> family, double spacing,
          std::shared_ptr<BreakableElasticity<2>> elastic, BondState<2>& bonds,
          std::optional<InitialStress<2>> initial_stress, std::vector<CrackFacet<2>> seeds);
  virtual ~CutBody() = default;
  CutBody(const CutBody&) = delete;
  CutBody& operator=(const CutBody&) = delete;

  /// Cuts one more facet; false, and nothing done, where it meets no bond.
  virtual bool cut(const CrackFacet<2>& facet) = 0;
  /// Would cut() meet a bond?
  bool is_intact_along(const CrackFacet<2>& facet) const;

  /// K_I at a tip that this facet is close behind, up to a factor that stays, under fluid of fixed
  /// volume.
  virtual double intensity_at_fixed_volume(Index facet) const = 0;

  std::span<const FaceJump> jumps() const { return jumps_; }
  /// Normal and tangential stress that facet f is relieved of [Pa].
  Vector<2> relief(Index f) const;
  bool relief_varies() const { return initial_stress_ && !initial_stress_->inside.empty(); }
  /// Mean jump across facet f in a field of all unknowns, along normal and tangent [m].
  Vector<2> jump(Index f, std::span<const double> unknowns) const;

  std::span<const CrackFacet<2>> facets() const { return bonds_.facets(); }
  /// The body's bounding box goes on beyond `distance` [m] from x on all sides.
  bool reaches(const Vector<2>& x, double distance) const;

  const Family<2>& family() const { return *family_; }
  BreakableElasticity<2>& elastic() { return *elastic_; }

 protected:
  void cut_seeds();
  void break_bonds(std::span<const std::pair<Index, Index>> bonds);
  /// Takes family and material back to the body without cracks.
  void mend();

  std::shared_ptr<Family<2>> family_;
  Family<2> intact_;
  double spacing_;
  std::shared_ptr<BreakableElasticity<2>> elastic_;
  BondState<2>& bonds_;
  std::uint64_t followed_ = 0;  ///< version of the bonds that this body has
  std::vector<CrackFacet<2>> seeds_;
  std::optional<InitialStress<2>> initial_stress_;
  std::vector<FaceJump> jumps_;                   ///< by facet
  std::array<std::pair<double, double>, 2> box_;  ///< of the points, by axis
};

}  // namespace perifrac
