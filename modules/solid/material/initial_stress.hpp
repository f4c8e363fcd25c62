#pragma once

#include "core/geometry/by_region.hpp"

namespace perifrac {

/// Normal stress of the body at rest along every axis, tension positive [Pa].
template <int D>
struct InitialStress {
  ByRegion<D, Vector<D>> at_datum;
  Vector<D> by_height{};  ///< what comes to it along the last axis, upwards [Pa/m]
  double datum = 0.0;     ///< the height at which nothing does [m]

  bool varies() const { return !at_datum.inside.empty() || by_height != Vector<D>{}; }
  Vector<D> at(const Vector<D>& x) const {
    Vector<D> stress = at_datum.at(x);
    for (int a = 0; a < D; ++a) stress[a] += by_height[a] * (x[D - 1] - datum);
    return stress;
  }
};

}  // namespace perifrac
