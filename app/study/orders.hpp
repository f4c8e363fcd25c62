#pragma once

#include <optional>
#include <span>
#include <vector>

namespace perifrac {

/// p of y = c x^p by least squares of the logarithms. Pairs that are not positive and finite are
/// left out; nothing where fewer than two places are left.
std::optional<double> power(std::span<const double> x, std::span<const double> y);

/// The places along x at which two curves cross, straight lines between the logarithms. x rises.
/// Where they lie apart by less than the factor `blur`, neither is taken to be the larger one.
std::vector<double> crossings(std::span<const double> x, std::span<const double> a,
                              std::span<const double> b, double blur = 1.0);

/// Richardson's extrapolation from three values at h r^2, h r and h, by the distances of
/// neighbours: `coarse` between the first two, `fine` between the last two. The limit lies
/// `share` of the last step beyond the finest value.
struct Extrapolation {
  double order;
  double share;
};
/// Nothing where the distances do not fall. `ratio` is r, over 1.
std::optional<Extrapolation> extrapolate(double coarse, double fine, double ratio);

}  // namespace perifrac
