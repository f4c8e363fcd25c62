#pragma once

#include <cmath>
#include <functional>

#include "modules/fluid/wall_cloud.hpp"

namespace perifrac {

/// The plane that stands for a wall's surface around one of its points.
template <int D>
struct WallSurface {
  Vector<D> normal;  ///< unit, out of the wall
  double depth;      ///< of the point below it [m]
};

/// Picks the surface with the least, or the largest, depth from those that are offered. Where two or
/// three faces tie, as on the diagonal of a corner, it is the plane through the corner across their
/// bisector: neither the order of axes nor rounding decides.
template <int D, class Compare>
class BestSurface {
 public:
  /// `rounding` [m]: what depths may differ by and be the same.
  explicit BestSurface(double rounding) : rounding_(rounding) {}

  void offer(const WallSurface<D>& surface) {
    if (count_ > 0 && std::abs(surface.depth - depth_) <= rounding_) {
      for (int a = 0; a < D; ++a) sum_[a] += surface.normal[a];
      ++count_;
    } else if (count_ == 0 || Compare{}(surface.depth, depth_)) {
      first_ = sum_ = surface.normal;
      depth_ = surface.depth;
      count_ = 1;
    }
  }

  bool found() const { return count_ > 0; }

  WallSurface<D> surface() const {
    double square = 0.0;
    for (const double component : sum_) square += component * component;
    const double length = std::sqrt(square);
    if (count_ == 1 || length < 0.5) return {first_, depth_};  // or the middle of a thin wall
    WallSurface<D> result{sum_, count_ * depth_ / length};
    for (double& component : result.normal) component /= length;
    return result;
  }

 private:
  double rounding_;
  int count_ = 0;
  double depth_ = 0.0;
  Vector<D> first_{}, sum_{};
};

template <int D>
using DeepestSurface = BestSurface<D, std::greater<>>;
template <int D>
using NearestSurface = BestSurface<D, std::less<>>;

/// Of a depth in spacings.
inline constexpr double depth_rounding = 1e-6;

}  // namespace perifrac
