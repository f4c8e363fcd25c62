#pragma once

#include <cmath>
#include <functional>
#include <type_traits>

#include "core/base/small_vector.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// The plane that stands for a wall's surface around one of its points.
template <int D>
struct WallSurface {
  Vector<D> normal;  ///< unit, out of the wall
  double depth;      ///< of the point below it [m]
};

/// Picks the surface with the least or the largest depth from those that are offered; depths that
/// differ by rounding are the same. Of faces that tie outside a corner, `Compare` being `greater`,
/// it is the plane through the corner across their bisector, so that no axis comes before another.
/// Inside a corner that sticks out it is the first: a plane across would let fluid through the
/// faces.
template <int D, class Compare>
class BestSurface {
 public:
  /// `rounding` [m]: what depths may differ by and be the same.
  explicit BestSurface(double rounding) : rounding_(rounding) {}

  void offer(const WallSurface<D>& surface) {
    if (count_ > 0 && std::abs(surface.depth - first_.depth) <= rounding_) {
      sum_ += surface.normal;
      ++count_;
    } else if (count_ == 0 || Compare{}(surface.depth, first_.depth)) {
      first_ = surface;
      sum_ = surface.normal;
      count_ = 1;
    }
  }

  bool found() const { return count_ > 0; }

  WallSurface<D> surface() const {
    if (count_ == 1 || !std::is_same_v<Compare, std::greater<>>) return first_;
    const double length = std::sqrt(static_cast<double>(count_));  // axes are normal to each other
    return {sum_ / length, length * first_.depth};
  }

 private:
  double rounding_;
  int count_ = 0;
  WallSurface<D> first_{};
  Vector<D> sum_{};
};

template <int D>
using DeepestSurface = BestSurface<D, std::greater<>>;
template <int D>
using NearestSurface = BestSurface<D, std::less<>>;

/// Of a depth in spacings.
inline constexpr double depth_rounding = 1e-6;

}  // namespace perifrac
