#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/region.hpp"
#include "core/state/compensated_sum.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/periodic_images.hpp"

namespace perifrac {

/// The box that fluid is expected to stay in. Points that leave it are removed; when more than a
/// few did, something leaks.
template <int D>
class FluidDomain {
 public:
  FluidDomain(Region<D> box, std::int64_t most_lost)
      : box_(std::move(box)), most_lost_(most_lost) {}

  /// Removes the points outside at t [s]; returns how many. Throws NumericalError where too many
  /// have left by now.
  Index remove(FluidPoints<D>& points, double t);

  const Region<D>& box() const { return box_; }
  bool may_lose() const { return most_lost_ > 0; }
  std::int64_t points_left() const { return left_; }   ///< since the start
  double removed() const { return removed_.value(); }  ///< their mass [kg]

  void visit_state(StateVisitor& visitor);

 private:
  Region<D> box_;
  std::int64_t most_lost_;
  std::int64_t left_ = 0;
  CompensatedSum removed_;
};

/// The keys of `domain` in the section of the fluid.
KeyTable fluid_domain_keys();

/// Reads the domain. Where the scene does not say, it is `all`, the box that holds everything at
/// the start, grown on all sides by five times its longest edge: splashes fly up through open
/// faces. It has no ends along an axis that repeats. Throws InputError.
template <int D>
FluidDomain<D> read_fluid_domain(const Section& section, const Region<D>& all,
                                 const Period<D>& period);

}  // namespace perifrac
