#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/bonds/bond_state.hpp"
#include "modules/solid/fracture/face_jump.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"
#include "modules/solid/material/initial_stress.hpp"

namespace perifrac {

/// A linear elastic body while cracks cut its bonds facet by facet: what its cracks are, whatever
/// moves it. In 2D in plane strain.
template <int D>
class CutBody {
 public:
  /// `family` is the one of `elastic`, with nothing broken. New faces are relieved
  /// of the `initial_stress`. Writes `bonds`.
  CutBody(std::shared_ptr<Family<D>> family, double spacing,
          std::shared_ptr<BreakableElasticity<D>> elastic, BondState<D>& bonds,
          std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds);
  virtual ~CutBody() = default;
  CutBody(const CutBody&) = delete;
  CutBody& operator=(const CutBody&) = delete;

  /// Cuts one more facet; false, and nothing done, where it meets no bond.
  virtual bool cut(const CrackFacet<D>& facet) = 0;
  /// Would cut() meet a bond?
  bool is_intact_along(const CrackFacet<D>& facet) const;

  /// K_I at a tip that this facet is close behind, up to a factor that stays, under fluid of fixed
  /// volume.
  virtual double intensity_at_fixed_volume(Index facet) = 0;

  /// What an even pressure of 1 Pa on the faces named, and nothing else, does to the unknowns
  /// named; and an even shear along the first tangent. The others of both arrays are left. Returns
  /// the volume that the pressure opens there [m^3], in 2D per metre; nothing where no equilibrium
  /// says it.
  virtual std::optional<double> find_even_answers(std::span<const Index> faces,
                                                  std::span<const Index> named,
                                                  std::span<double> by_pressure,
                                                  std::span<double> by_shear) = 0;

  /// Jumps of all facets by tractions on them, along normal and tangents [Pa], and nothing else
  /// [m]. Of a body that may be partly cut; empty of others.
  virtual std::vector<Vector<D>> jumps_by(std::span<const Vector<D>> /*tractions*/) { return {}; }

  std::span<const FaceJump<D>> jumps() const { return jumps_; }
  /// Normal and tangential stress that facet f is relieved of [Pa].
  Vector<D> relief(Index f) const;
  /// Stress at rest along the axes [Pa].
  Vector<D> stress_at_rest(const Vector<D>& x) const {
    return initial_stress_ ? initial_stress_->at(x) : Vector<D>{};
  }
  /// Stress at rest along facet f less that across it, in 2D [Pa].
  double stress_along(Index f) const;
  bool relief_varies() const { return initial_stress_ && initial_stress_->varies(); }
  /// The points that a jump is between lie within the rock. What a load of its faces presses that
  /// rock together by is no part of how far the faces are apart; this times the load puts it back
  /// [m/Pa]. On the line of a crack both stresses in the plane are -p, and the strain across it is
  /// -p / (2 (lambda + mu)). Not in 3D: squares at the front open too far by more than that, where
  /// a radius is a few squares.
  double pressed_by(Index f) const;
  /// What a stress in the rock bears on the faces of all cracks: the force on every unknown that
  /// holds them under it [N]. `stress` is times volume, D * D blocks, as a ForceOfStress takes it.
  Eigen::VectorXd force_on_faces(const Eigen::VectorXd& stress) const;
  /// Mean jump across facet f in a field of all unknowns, along normal and tangents [m].
  Vector<D> jump(Index f, std::span<const double> unknowns) const;

  std::span<const CrackFacet<D>> facets() const { return bonds_.facets(); }
  /// Changes with every cut and every restored state.
  std::uint64_t version() const { return bonds_.version(); }
  /// The body's bounding box goes on beyond `distance` [m] from x on all sides.
  bool reaches(const Vector<D>& x, double distance) const;

  const Family<D>& family() const { return *family_; }
  double spacing() const { return spacing_; }
  BreakableElasticity<D>& elastic() { return *elastic_; }

 protected:
  void cut_seeds();
  void break_bonds(std::span<const std::pair<Index, Index>> bonds);
  /// Takes the last break_bonds() of these back.
  void heal_bonds(std::span<const std::pair<Index, Index>> bonds);
  /// Takes family and material back to the body without cracks.
  void mend();

  std::shared_ptr<Family<D>> family_;
  Family<D> intact_;
  double spacing_;
  double longest_ = 0.0;  ///< bond [m]
  std::shared_ptr<BreakableElasticity<D>> elastic_;
  BondState<D>& bonds_;
  std::uint64_t followed_ = 0;  ///< version of the bonds that this body has
  std::vector<CrackFacet<D>> seeds_;
  std::optional<InitialStress<D>> initial_stress_;
  std::vector<FaceJump<D>> jumps_;                ///< by facet
  std::array<std::pair<double, double>, D> box_;  ///< of the points, by axis
};

}  // namespace perifrac
