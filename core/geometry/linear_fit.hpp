#pragma once

#include <span>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/base/points.hpp"

namespace perifrac {

/// How the values at some points make the value at a place: a sum with weights. Empty: they do not.
struct PlaceWeights {
  std::vector<Index> points;
  std::vector<double> weights;

  /// NaN where there is no point.
  double value(std::span<const double> values) const;
};

/// Of the values that a linear field has at `chosen`, its value at `place`: exact, inside and
/// beside them; of others to second order. Least squares that trust a point the more the nearer it
/// is, those at `reach` [m] and beyond not at all; a point at the place itself is read alone. Along
/// directions in which the points do not spread (a row of points, a single one) the field is taken
/// as constant.
PlaceWeights linear_fit(const PointSet& points, std::span<const Index> chosen,
                        std::span<const double> place, double reach);

/// Squared distance [m^2] of point i from a place.
double square_distance(const PointSet& points, std::size_t i, std::span<const double> place);

}  // namespace perifrac
