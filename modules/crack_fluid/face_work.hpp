#pragma once

#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/crack_fluid/crack_flow.hpp"

namespace perifrac {

/// What fluid does to the faces of a crack, step by step: the mean of the pressure on a facet
/// before and after, that of contact included, times what it has opened (not its aperture, for
/// what a residual aperture takes in moves no rock). Between a linear body and its cracks that is
/// exact, in the sum over all facets, however far they open.
///
/// A new facet beside a full one is opened by fluid that follows the tip, under the pressure that
/// it comes to hold.
class FaceWork {
 public:
  void clear() { facets_.clear(); }
  /// All facets as they are at rest, before anything acts: what comes on at once with the fluid at
  /// the start does half of what it comes to, and so does the fluid.
  void start(Index count) { facets_.assign(count, {0.0, 0.0, false}); }
  /// Takes facets that are new as they are before the step.
  void add_new(const CrackFlow& before);
  bool knows_all_of(const CrackFlow& now) const;

  /// Work on facet f since the last time [J], in 2D per metre.
  double book(const CrackFlow& now, Index f);

  void visit_state(StateVisitor& visitor);

 private:
  struct Facet {
    double opening;      ///< [m]
    double pressure;     ///< on the faces [Pa]
    bool fluid_follows;  ///< and has not come yet
  };
  std::vector<Facet> facets_;
};

}  // namespace perifrac
