#pragma once

#include <string>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"

namespace perifrac {

// Points of a free fluid move, appear and vanish: all these read them afresh whenever they are
// asked.

/// The largest coordinate of any point along `axis`, and half a spacing: the edge of the fluid [m].
Reference::Computed edge_of(const Field& field, int axis, double spacing);

/// Mean of one component over the points between two coordinates along `axis`; NaN without points.
Reference::Computed mean_between(const Field& field, int component, int axis, double low,
                                 double high);

/// The means over layers one spacing thick along `axis`, from `low` to `high`.
Reference::Profile profile_over_layers(const Field& field, int component, int axis, double low,
                                       double high, double spacing, const std::string& quantity,
                                       std::function<double(double x, double t)> exact);

}  // namespace perifrac
