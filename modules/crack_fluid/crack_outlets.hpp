#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/body/body.hpp"
#include "core/config/section.hpp"
#include "core/time/schedule.hpp"
#include "modules/crack_fluid/crack_graph.hpp"
#include "modules/crack_fluid/crack_inlets.hpp"
#include "modules/crack_fluid/crack_step.hpp"

namespace perifrac {

/// What a crack that grows to a face of its body finds there.
struct BehindFace {
  enum class Kind { open, held, free_fluid };
  Kind kind = Kind::open;
  double pressure = 0.0;  ///< times the schedule [Pa]
  Schedule schedule{};
  bool gives = false;  ///< fluid stands there, and comes in too
};

/// Where a crack has grown to a face: it opens there and drains to what is behind. At a face that
/// is held, or beside free fluid, it stays closed. Mouths that the scene gives, where a crack meets
/// a face from the start, stay as they are; in 3D all along that face.
template <int D>
class CrackOutlets {
 public:
  /// `behind` by face of the body.
  CrackOutlets(std::shared_ptr<const Body<D>> body, std::vector<BehindFace> behind);

  /// The facets that there are now are the scene's.
  void start();
  /// Follows the facets.
  void match(const CrackGraph& graph);
  /// Says in the log what was found since it last did, and of inlets that are near.
  void tell(double t, std::span<const CrackInlet> inlets);
  /// What comes and goes there over a step; nothing in one of no length, nor where an inlet is.
  void append_to(std::vector<FacetInflow>& inflows, const TimeWindow& step,
                 double vapour_pressure) const;

 private:
  struct Outlet {
    Index facet;
    int face;
    Vector<D> at;
  };
  int face_at(const FacetSide<D>& side) const;
  void tell_of_near(const Vector<D>& at, std::span<const CrackInlet> inlets) const;

  std::shared_ptr<const Body<D>> body_;
  std::vector<BehindFace> behind_;
  std::size_t seeds_ = 0;
  std::vector<Outlet> outlets_;
  std::set<std::pair<int, Index>> told_;  ///< by face and facet, in 3D by face
};

/// What the scene says of the faces of its body.
template <int D>
std::vector<BehindFace> read_behind_faces(const Section& scene, const Body<D>& body);

}  // namespace perifrac
