#pragma once

#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/region.hpp"
#include "core/state/compensated_sum.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/periodic_images.hpp"

namespace perifrac {

/// Boxes that take in fluid for good.
template <int D>
class Outlets {
 public:
  Outlets(std::vector<Region<D>> boxes, Period<D> period)
      : boxes_(std::move(boxes)), period_(std::move(period)) {}

  /// Removes the points that lie in a box; returns how many.
  Index remove(FluidPoints<D>& points);

  const std::vector<Region<D>>& boxes() const { return boxes_; }
  double removed() const { return removed_.value(); }  ///< [kg]

  void visit_state(StateVisitor& visitor) { removed_.visit_state(visitor, "drained_mass"); }

 private:
  std::vector<Region<D>> boxes_;
  Period<D> period_;
  CompensatedSum removed_;
};

/// The keys of `outlets` in the section of the fluid.
KeyTable outlet_keys();

/// Reads the boxes. Throws InputError.
template <int D>
std::vector<Region<D>> read_outlets(const Section& section);

}  // namespace perifrac
