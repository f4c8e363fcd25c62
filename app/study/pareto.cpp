#include "app/study/pareto.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace perifrac {

std::vector<std::size_t> pareto_front(std::span<const ErrorAndCost> points) {
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost
                                            : points[a].error < points[b].error;
  });
  for (const std::size_t i : order) {
    if (points[i].error >= least) continue;
    least = points[i].error;
    front.push_back(i);
  }
  return front;
}

std::vector<std::size_t> cheapest(std::span<const ErrorAndCost> points, double accuracy) {
  std::vector<std::size_t> reaching;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].error <= accuracy) reaching.push_back(i);
  }
  std::ranges::stable_sort(reaching, {}, [&](std::size_t i) { return points[i].cost; });
  return reaching;
}

}  // namespace perifrac
