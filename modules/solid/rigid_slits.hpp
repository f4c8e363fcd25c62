#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"

namespace perifrac {

/// A solid that does not deform, with cracks of a width that stays: slits for fluid to flow in.
/// Port: on the facets of the cracks (`crack`), out `crack_opening` and, for crack fluid,
/// `free_crack_opening`, which are the same [m].
template <int D>
class RigidSlits final : public PhysicsModule {
 public:
  /// Cuts the body's bonds; `opening` has a value a facet [m].
  RigidSlits(std::shared_ptr<const Body<D>> body, const std::vector<CrackFacet<D>>& facets,
             std::vector<double> opening);

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId) override { return {&bonds_.facet_points(), opening_}; }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override { return window.end; }
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}

 private:
  std::vector<Port> ports_{
      {"crack_opening", "m", PortDirection::out},
      {"free_crack_opening", "m", PortDirection::out, PortKind::intensive, PortRole::property}};
  std::shared_ptr<const Body<D>> body_;
  BondState<D>& bonds_;
  std::vector<double> opening_;
};

}  // namespace perifrac
