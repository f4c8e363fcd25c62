#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// Space that repeats along some axes: what leaves at one end comes in at the other.
template <int D>
struct Period {
  /// Per axis the two ends [m]; nothing where space does not repeat.
  std::array<std::optional<std::pair<double, double>>, D> ends;

  bool any() const {
    for (const auto& end : ends) {
      if (end) return true;
    }
    return false;
  }

  /// By how many whole periods x is to be moved, to be between the ends along `axis` [m].
  double shift(int axis, double x) const {
    if (!ends[axis]) return 0.0;
    const auto [low, high] = *ends[axis];
    return -(high - low) * std::floor((x - low) / (high - low));
  }
  /// x, brought back between the ends along `axis`.
  double wrapped(int axis, double x) const { return x + shift(axis, x); }
  Vector<D> wrapped(Vector<D> x) const {
    for (int a = 0; a < D; ++a) x[a] = wrapped(a, x[a]);
    return x;
  }

  /// Of all that lead from one place to the images of another, one of which is `way`.
  Vector<D> shortest(Vector<D> way) const {
    for (int a = 0; a < D; ++a) {
      if (ends[a]) way[a] = std::remainder(way[a], ends[a]->second - ends[a]->first);
    }
    return way;
  }
};

/// Images of points near the ends of a period, so that loops over neighbours need not know of it.
/// Image k stands for `source[k]`, moved by `shift`.
template <int D>
struct PeriodicImages {
  std::vector<Index> source;
  std::array<std::vector<double>, D> shift;  ///< [m]

  /// Images of all points within `reach` [m] of an end, corners included.
  void find(const Period<D>& period, const std::array<std::vector<double>, D>& position,
            Index count, double reach) {
    source.clear();
    for (auto& s : shift) s.clear();
    for (int a = 0; a < D; ++a) {
      if (!period.ends[a]) continue;
      const auto add = [&](Index point, const Vector<D>& moved) {
        add_across(a, *period.ends[a], reach, position[a][point], point, moved);
      };
      const Index before = size();
      for (Index i = 0; i < count; ++i) add(i, {});
      for (Index k = 0; k < before; ++k) {
        add(source[k], vector_at(shift, k));
      }
    }
  }

  /// Images behind either end of one axis of a point at x there, which has been moved already.
  void add_across(int axis, const std::pair<double, double>& ends, double reach, double x,
                  Index point, const Vector<D>& moved) {
    const auto [low, high] = ends;
    const double there = x + moved[axis];
    for (const double by : {high - low, low - high}) {
      if (by > 0.0 ? there >= low + reach : there <= high - reach) continue;
      source.push_back(point);
      for (int b = 0; b < D; ++b) shift[b].push_back(moved[b] + (b == axis ? by : 0.0));
    }
  }

  Index size() const { return static_cast<Index>(source.size()); }

  /// Puts the sources' values behind the first `count` values.
  void copy(std::vector<double>& values, Index count) const {
    values.resize(count + source.size());
    for (Index k = 0; k < size(); ++k) values[count + k] = values[source[k]];
  }
  void copy_positions(std::array<std::vector<double>, D>& position, Index count) const {
    for (int a = 0; a < D; ++a) {
      copy(position[a], count);
      for (Index k = 0; k < size(); ++k) position[a][count + k] += shift[a][k];
    }
  }
};

}  // namespace perifrac
