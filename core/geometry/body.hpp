#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/faces.hpp"
#include "core/geometry/family.hpp"
#include "core/geometry/points.hpp"
#include "core/module/point_set.hpp"
#include "core/operators/influence_function.hpp"

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
  const PointSet& point_set() const { return point_set_; }
  Index nearest_point(const Vector<D>& x) const;

  /// Families with mirror ghosts behind the faces in `mirrored`. Modules that mirror the same faces
  /// share one.
  std::shared_ptr<const Family<D>> family(FaceSet mirrored) const;
  /// All families that are in use.
  std::vector<std::shared_ptr<const Family<D>>> families() const;

 private:
  Points<D> points_;
  std::vector<Face> faces_;
  double spacing_;
  double horizon_;
  InfluenceFunction influence_;
  PointSet point_set_;
  mutable std::vector<std::pair<FaceSet, std::weak_ptr<const Family<D>>>> families_;
};

using AnyBody = std::variant<std::shared_ptr<const Body<2>>, std::shared_ptr<const Body<3>>>;

/// The keys of the scene's `body` section.
KeyTable body_keys();

/// Builds the body that the section describes; throws InputError.
AnyBody make_body(const Section& section, int dimension);

}  // namespace perifrac
