#include "app/warnings/pressure_swing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace perifrac {

namespace {

/// The next point along an axis; -1 where there is none.
template <int D>
std::vector<Index> next_along(const Body<D>& body, const Family<D>& family, int axis) {
  const Points<D>& points = body.points();
  const double spacing = body.spacing();
  std::vector<Index> next(family.point_count, -1);
  for (Index i = 0; i < family.point_count; ++i) {
    for (const auto& bond : family.bonds(i)) {
      const Index j = bond.other;
      if (j >= family.point_count) continue;
      double off = 0.0;
      for (int a = 0; a < D; ++a) {
        const double step = points.position[a][j] - points.position[a][i];
        off = std::max(off, std::abs(step - (a == axis ? spacing : 0.0)));
      }
      if (off < 1e-6 * spacing) next[i] = j;
    }
  }
  return next;
}

/// What values range over; of nearly equal ones a thousandth of their size.
double range_of(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return std::max(high - low, 1e-3 * std::max(std::abs(low), std::abs(high)));
}

}  // namespace

template <int D>
double largest_step(const Body<D>& body, std::span<const double> values) {
  const auto families = body.families();
  if (families.empty() || body.irregular()) return 1.0;
  const double range = range_of(values);
  double largest = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    const std::vector<Index> next = next_along(body, *families.front(), axis);
    for (Index i = 0; i < static_cast<Index>(next.size()); ++i) {
      if (next[i] >= 0) largest = std::max(largest, std::abs(values[next[i]] - values[i]));
    }
  }
  return range > 0.0 ? largest / range : 0.0;
}

template <int D>
double largest_swing(const Body<D>& body, std::span<const double> values) {
  constexpr double noticed = 0.1;  // of the steps beside it
  const auto families = body.families();
  if (families.empty() || body.irregular()) return 0.0;
  const double range = range_of(values);
  double largest = 0.0;
  for (int axis = 0; axis < D; ++axis) {
    const std::vector<Index> next = next_along(body, *families.front(), axis);
    for (Index i = 0; i < static_cast<Index>(next.size()); ++i) {
      const Index j = next[i], k = j < 0 ? -1 : next[j], l = k < 0 ? -1 : next[k];
      if (l < 0) continue;
      const double step = values[k] - values[j];
      const double before = values[j] - values[i], after = values[l] - values[k];
      const double against =
          -std::max(std::copysign(1.0, step) * before, std::copysign(1.0, step) * after);
      if (against > noticed * std::abs(step)) largest = std::max(largest, std::abs(step));
    }
  }
  return range > 0.0 ? largest / range : 0.0;
}

template double largest_step(const Body<2>&, std::span<const double>);
template double largest_step(const Body<3>&, std::span<const double>);
template double largest_swing(const Body<2>&, std::span<const double>);
template double largest_swing(const Body<3>&, std::span<const double>);

}  // namespace perifrac
