#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/simulation/simulation.hpp"
#include "core/geometry/linear_fit.hpp"

namespace perifrac {

/// Reads fields of one set of points at a place, to second order (linear_fit.hpp).
///
/// Points of the body are read from the place's own side of cracks, cut-outs and regions, those of
/// bonded layers not at all. Facets of a crack are read along the crack, from those that hang
/// together with the nearest. Points that move are read as they lie now. Where neither facet nor
/// moving point is within a spacing there is nothing to read.
class PlaceReader {
 public:
  /// `points` is of the simulation; `fluid_spacing` [m] is that of moving points.
  PlaceReader(const Simulation& simulation, const PointSet& points, std::vector<double> place,
              double fluid_spacing);

  /// Looks where points and cracks are now, before values are read.
  void follow(const PointSet& points);
  /// One component; not a number where there is nothing to read.
  double value(const Field& field, int component = 0) const;
  double value(const PortView& view, int component) const;
  std::size_t points_read() const { return weights_.points.size(); }

 private:
  PlaceWeights weights_now(const PointSet& points) const;

  std::vector<double> place_;
  double reach_;
  double farthest_;  ///< [m]; the nearest point must not be farther
  /// The points that may be read now.
  std::function<std::vector<Index>(const PointSet& points)> choose_;
  std::function<std::uint64_t()> version_;  ///< of cracks; empty: points move at any time
  std::uint64_t known_ = 0;
  bool has_read_ = false;
  PlaceWeights weights_;
};

/// Between points of the scene's free fluid [m]; 0 where it has none.
double fluid_spacing(const Section& scene);

}  // namespace perifrac
