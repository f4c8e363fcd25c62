#include "coupling/mapping.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace perifrac {
namespace {

double squared_distance(const PointSet& a, std::size_t i, const PointSet& b, std::size_t j) {
  double sum = 0.0;
  for (int axis = 0; axis < a.dimension; ++axis) {
    const double difference = a.position[axis][i] - b.position[axis][j];
    sum += difference * difference;
  }
  return sum;
}

/// For each point of `from` the nearest of `to`. Candidates are sorted by their first coordinate
/// and searched outwards from the asking point's, until that coordinate alone is too far off.
std::vector<std::size_t> nearest_points(const PointSet& from, const PointSet& to) {
  std::vector<std::size_t> order(to.count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto x = to.position[0];
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return x[a] < x[b] || (x[a] == x[b] && a < b); });

  std::vector<std::size_t> nearest(from.count);
  for (std::size_t i = 0; i < from.count; ++i) {
    const double here = from.position[0][i];
    double best = std::numeric_limits<double>::infinity();
    std::size_t found = 0;
    // True once this candidate, and so all beyond it, lie too far off.
    const auto try_candidate = [&](std::size_t j) {
      if ((x[j] - here) * (x[j] - here) > best) return true;
      const double distance = squared_distance(from, i, to, j);
      if (distance < best || (distance == best && j < found)) {
        best = distance;
        found = j;
      }
      return false;
    };
    const auto middle = std::lower_bound(order.begin(), order.end(), here,
                                         [&](std::size_t j, double value) { return x[j] < value; });
    std::find_if(middle, order.end(), try_candidate);
    std::find_if(std::make_reverse_iterator(middle), order.rend(), try_candidate);
    nearest[i] = found;
  }
  return nearest;
}

}  // namespace

void Mapping::update(const PointSet& source, const PointSet& target) {
  if (source_ == key(source) && target_ == key(target)) return;
  source_ = key(source);
  target_ = key(target);
  identity_ = source.same_points(target);
  nearest_.clear();
  if (identity_) return;

  const PointSet& from = kind_ == PortKind::intensive ? target : source;
  const PointSet& to = kind_ == PortKind::intensive ? source : target;
  if (to.dimension == 0) {
    nearest_.assign(from.count, 0);
    return;
  }
  if (from.dimension != to.dimension || (to.count == 0 && from.count > 0)) {
    throw std::logic_error(
        fmt::format("no mapping from points '{}' ({} in {}D) to '{}' ({} in {}D)", source.name,
                    source.count, source.dimension, target.name, target.count, target.dimension));
  }
  nearest_ = nearest_points(from, to);
}

void Mapping::apply(std::span<const double> source, std::span<double> target) const {
  if (identity_) {
    std::copy(source.begin(), source.end(), target.begin());
    return;
  }
  const std::size_t components = source_.count > 0   ? source.size() / source_.count
                                 : target_.count > 0 ? target.size() / target_.count
                                                     : 0;
  if (kind_ == PortKind::extensive) std::fill(target.begin(), target.end(), 0.0);
  for (std::size_t c = 0; c < components; ++c) {
    const std::size_t from = c * source_.count;
    const std::size_t to = c * target_.count;
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      if (kind_ == PortKind::intensive) {
        target[to + i] = source[from + nearest_[i]];
      } else {
        target[to + nearest_[i]] += source[from + i];
      }
    }
  }
}

}  // namespace perifrac
