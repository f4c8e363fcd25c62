#pragma once

#include "core/base/points.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Points from a file and the box that they fill.
template <int D>
struct CloudPoints {
  Points<D> points;  ///< sorted along a space-filling curve
  Vector<D> low;     ///< [m]
  Vector<D> high;    ///< [m]
  double spacing;    ///< [m]; the scene's, else that of a lattice with as many points
};

/// The keys that only a body of `shape: points` has.
KeyTable cloud_keys();

/// What a `body` section of `shape: points` describes; throws InputError.
template <int D>
CloudPoints<D> read_cloud_points(const Section& section);

}  // namespace perifrac
