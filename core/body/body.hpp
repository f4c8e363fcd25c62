#pragma once

#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/base/points.hpp"
#include "core/bonds/bond_state.hpp"
#include "core/bonds/family.hpp"
#include "core/bonds/influence_function.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/faces.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

/// Reference points and named faces of one body. Physics modules share it and change nothing in it.
template <int D>
class Body {
 public:
  Body(Points<D> points, std::vector<Face> faces, double spacing, double horizon,
       InfluenceFunction influence);

  const Points<D>& points() const { return points_; }
  const std::vector<Face>& faces() const { return faces_; }
  double spacing() const { return spacing_; }  ///< [m]
  double horizon() const { return horizon_; }  ///< [m]
  InfluenceFunction influence() const { return influence_; }
  const PointSet& point_set() const { return point_set_; }
  const std::vector<Region<D>>& regions() const { return regions_; }
  void set_regions(std::vector<Region<D>> regions) { regions_ = std::move(regions); }
  /// Boxes that were taken out: no point lies in one, no bond passes through one (cutouts.hpp).
  const std::vector<Region<D>>& cutouts() const { return cutouts_; }
  void set_cutouts(std::vector<Region<D>> cutouts) { cutouts_ = std::move(cutouts); }
  /// Round cut-outs: those of the faces that are walls of holes.
  std::vector<Face> holes() const;
  bool has_cutouts() const { return !cutouts_.empty() || !holes().empty(); }
  /// A cut-out, of any shape, lies between two places.
  bool are_parted_by_cutout(const Vector<D>& x, const Vector<D>& y) const;
  /// The points are no lattice; families get projected weights (projected_weights.hpp) or not.
  bool irregular() const { return irregular_; }
  void set_irregular(bool projected_weights);
  /// Points of the bonded layer behind a face, which stand in for its ghosts; empty where the face
  /// has none. A point behind two layered faces belongs to both layers.
  std::span<const Index> layer(int face) const { return layers_[face]; }
  void set_layers(std::vector<std::vector<Index>> layers) { layers_ = std::move(layers); }
  /// The face across the body: the other one normal to the same axis, or else the curved one.
  int opposite(int face) const;
  /// Of a box's face, without what layers beside it add [m^(D-1)].
  double area(int face) const;
  /// From a face to the opposite one, layers included except those behind faces in
  /// `without_layers` [m].
  double thickness(int face, FaceSet without_layers = 0) const;
  /// The nearest point of the body proper, layers left out.
  Index nearest_point(const Vector<D>& x) const;

  /// Families with mirror ghosts behind the faces in `mirrored`, none of which may have a layer;
  /// points of the layers behind the faces in `without_layers` have no bonds. Modules that ask for
  /// the same share one. Throws BodyError.
  std::shared_ptr<const Family<D>> family(FaceSet mirrored, FaceSet without_layers = 0) const;
  /// Broken bonds and cracks; a body that nothing breaks has none.
  const BondState<D>& bond_state() const { return *bond_state_; }
  /// The one handle that may change them, for the body's solid; a second claim is a logic_error.
  BondState<D>& claim_bond_state() const;

  /// All families that are in use.
  std::vector<std::shared_ptr<const Family<D>>> families() const;

 private:
  /// Projected weights come from the family with all faces mirrored, so that a free surface cuts a
  /// cloud that is as good as a lattice, and all families have the same.
  Family<D> make_family(FaceSet mirrored, FaceSet without_layers) const;

  Points<D> points_;
  std::vector<Face> faces_;
  std::vector<std::vector<Index>> layers_;  ///< by face
  std::vector<Region<D>> regions_;
  std::vector<Region<D>> cutouts_;
  double spacing_;
  double horizon_;
  bool irregular_ = false;
  bool projected_weights_ = false;
  InfluenceFunction influence_;
  PointSet point_set_;
  std::unique_ptr<BondState<D>> bond_state_ = std::make_unique<BondState<D>>();
  mutable bool bond_state_claimed_ = false;

  /// Throws BodyError where the body is thinner than the horizon between mirrored faces.
  void check_mirrored_faces(FaceSet mirrored, FaceSet without_layers) const;
  /// By point: it belongs to a layer behind one of the faces.
  std::vector<bool> in_layers(FaceSet faces) const;

  struct SharedFamily {
    FaceSet mirrored;
    FaceSet without_layers;
    std::weak_ptr<const Family<D>> family;
  };
  mutable std::vector<SharedFamily> families_;
};

/// Null in a scene without a body: what is held then only says the scene's dimension.
using AnyBody = std::variant<std::shared_ptr<const Body<2>>, std::shared_ptr<const Body<3>>>;

/// The keys of the scene's `body` section.
KeyTable body_keys();

/// Builds the body that the section describes; throws InputError.
AnyBody make_body(const Section& section, int dimension);

}  // namespace perifrac
