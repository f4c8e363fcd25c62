#pragma once

#include <functional>
#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/region.hpp"
#include "core/state/compensated_sum.hpp"
#include "core/time/schedule.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/fluid_properties.hpp"
#include "modules/fluid/points/periodic_images.hpp"

namespace perifrac {

/// A source of mass in a box.
template <int D>
struct Inlet {
  Region<D> box;
  double rate;  ///< [kg/s, kg/(m s) in 2D], times the schedule
  Schedule schedule;

  double waiting = 0.0;  ///< state: came while no point was there, not yet fluid [kg]
};

/// The sources of mass of a fluid. Points in the box of an inlet grow, in proportion to volume:
/// their density rises, what enters has their velocity. Those beside a wall would drive out more
/// than comes in (docs/decisions/0011-free-fluid.md): they take a share only where the box holds no
/// others. While it holds none at all, mass waits until it makes a point at the centre; what still
/// waits when points come follows at the rate of the inlet.
template <int D>
class Inlets {
 public:
  /// `point_mass` [kg] is that of a point at zero pressure one spacing from the next.
  Inlets(std::vector<Inlet<D>> inlets, const FluidProperties& fluid, double point_mass,
         Period<D> period);

  /// Gives points the mass of a step about t [s]; needs their volumes. `is_beside_wall`: whether a
  /// wall is within the horizon of a point.
  void feed(FluidPoints<D>& points, double t, double length,
            const std::function<bool(Index)>& is_beside_wall);

  /// Makes points at rest and at zero pressure where a whole one waits, no other is in the box, and
  /// is_free(centre); returns how many.
  Index make_points(FluidPoints<D>& points, const std::function<bool(const Vector<D>&)>& is_free);

  const std::vector<Inlet<D>>& all() const { return inlets_; }
  double injected() const { return injected_.value(); }  ///< mass that became fluid [kg]

  void visit_state(StateVisitor& visitor);

 private:
  void find_inside(const FluidPoints<D>& points, const Region<D>& box);

  std::vector<Inlet<D>> inlets_;
  double density_;
  double point_mass_;
  Period<D> period_;
  CompensatedSum injected_;
  std::vector<Index> inside_;  // workspace
};

/// The keys of `inlets` in the section of the fluid.
KeyTable inlet_keys();

/// Reads them. Throws InputError.
template <int D>
std::vector<Inlet<D>> read_inlets(const Section& section, double spacing);

}  // namespace perifrac
