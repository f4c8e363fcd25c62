#include "modules/fluid/points/fluid_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

/// The square of the farthest that any of `count` points has moved.
template <int D>
double farthest(const std::array<std::vector<double>, D>& now,
                const std::array<std::vector<double>, D>& before, Index count) {
  double largest = 0.0;
  for (Index i = 0; i < count; ++i) {
    largest = std::max(largest, squared_norm(vector_at(now, i) - vector_at(before, i)));
  }
  return largest;
}

}  // namespace

template <int D>
bool FluidNeighbours<D>::outdated(const FluidPoints<D>& points, const NearWalls<D>& walls) const {
  if (!known_) return true;
  const double fluid = std::sqrt(farthest<D>(points.position, found_at_, points.count));
  const double wall = std::sqrt(farthest<D>(walls.position, walls_found_at_, walls.count));
  return fluid + std::max(fluid, wall) >= skin_;
}

template <int D>
void FluidNeighbours<D>::find(FluidPoints<D>& points,
                              const std::array<std::vector<double>, D>& wall_position,
                              NearWalls<D>& walls) {
  points.trim();
  wrap(points);
  sort(points);
  images_.find(period_, points.position, points.count, reach_);
  images_.copy_positions(points.position, points.count);
  grid_.build(positions_of(points.position), reach_);
  grid_.find_others(points.count, reach_, fluid_of_fluid_);
  find_near_walls(points, wall_position, walls);
  grid_.build(positions_of(walls.position), reach_);
  grid_.find(positions_of(points.position, points.count), reach_, walls_of_fluid_);
  for (int a = 0; a < D; ++a) {
    found_at_[a].assign(points.position[a].begin(), points.position[a].begin() + points.count);
    walls_found_at_[a].assign(walls.position[a].begin(), walls.position[a].begin() + walls.count);
  }
  known_ = true;
  ++searches_;
}

/// The wall points within reach of the box that holds all fluid: a puddle on a large body is
/// sought beside it and not along all faces.
template <int D>
void FluidNeighbours<D>::find_candidates(const FluidPoints<D>& points,
                                         const std::array<std::vector<double>, D>& wall_position) {
  const double reach = reach_ * (1.0 + 1e-9);
  std::array<double, D> low, high;
  for (int a = 0; a < D; ++a) {
    low[a] = high[a] = std::numeric_limits<double>::quiet_NaN();  // without fluid none is near
    if (points.position[a].empty()) continue;
    const auto [least, most] = std::ranges::minmax(points.position[a]);
    low[a] = least - reach;
    high[a] = most + reach;
  }
  candidates_.clear();
  for (auto& position : candidate_position_) position.clear();
  for (Index w = 0; w < static_cast<Index>(wall_position[0].size()); ++w) {
    bool is_near = true;
    for (int a = 0; a < D; ++a) {
      is_near = is_near && wall_position[a][w] >= low[a] && wall_position[a][w] <= high[a];
    }
    if (!is_near) continue;
    candidates_.push_back(w);
    append(candidate_position_, vector_at(wall_position, w));
  }
}

/// The wall points that fluid is near, compactly, and their images.
template <int D>
void FluidNeighbours<D>::find_near_walls(const FluidPoints<D>& points,
                                         const std::array<std::vector<double>, D>& wall_position,
                                         NearWalls<D>& walls) {
  find_candidates(points, wall_position);
  grid_.find(positions_of(candidate_position_), reach_, fluid_of_candidates_);
  walls.wall.clear();
  fluid_of_walls_.offset.assign(1, 0);
  fluid_of_walls_.other.clear();
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const auto& [offset, other] = fluid_of_candidates_;
    if (offset[k] == offset[k + 1]) continue;
    walls.wall.push_back(candidates_[k]);
    fluid_of_walls_.other.insert(fluid_of_walls_.other.end(), other.begin() + offset[k],
                                 other.begin() + offset[k + 1]);
    fluid_of_walls_.offset.push_back(static_cast<Index>(fluid_of_walls_.other.size()));
  }
  walls.count = static_cast<Index>(walls.wall.size());
  for (int a = 0; a < D; ++a) {
    walls.position[a].resize(walls.count);
    for (Index k = 0; k < walls.count; ++k) walls.position[a][k] = wall_position[a][walls.wall[k]];
  }
  wall_images_.find(period_, walls.position, walls.count, reach_);
  wall_images_.copy_positions(walls.position, walls.count);
  for (const Index k : wall_images_.source) walls.wall.push_back(walls.wall[k]);
}

template <int D>
bool FluidNeighbours<D>::wraps_along(const Vector<D>& along) const {
  for (int a = 0; a < D; ++a) {
    if (period_.ends[a] && along[a] != 0.0) return true;
  }
  return false;
}

/// Brings points that left through an end of a period back in at the other.
template <int D>
void FluidNeighbours<D>::wrap(FluidPoints<D>& points) const {
  for (int a = 0; a < D; ++a) {
    if (!period_.ends[a]) continue;
    for (double& x : points.position[a]) x = period_.wrapped(a, x);
  }
}

template <int D>
void FluidNeighbours<D>::sort(FluidPoints<D>& points) {
  grid_.build(positions_of(points.position, points.count), reach_);
  const auto permute = [&](auto& values, auto& sorted) {
    sorted.clear();
    for (const Index i : grid_.order()) sorted.push_back(values[i]);
    values.swap(sorted);
  };
  for (int a = 0; a < D; ++a) {
    permute(points.position[a], sorted_);
    permute(points.velocity[a], sorted_);
  }
  permute(points.density, sorted_);
  permute(points.mass, sorted_);
  permute(points.id, sorted_id_);
}

template class FluidNeighbours<2>;
template class FluidNeighbours<3>;

}  // namespace perifrac
