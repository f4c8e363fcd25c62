#include "modules/fluid/fluid_neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

/// The square of the farthest that any of `count` points has moved.
template <int D>
double farthest(const std::array<std::vector<double>, D>& now,
                const std::array<std::vector<double>, D>& before, Index count) {
  double largest = 0.0;
  for (Index i = 0; i < count; ++i) {
    double square = 0.0;
    for (int a = 0; a < D; ++a) {
      const double moved = now[a][i] - before[a][i];
      square += moved * moved;
    }
    largest = std::max(largest, square);
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
  find_near_walls(wall_position, walls);
  grid_.build(positions_of(walls.position), reach_);
  grid_.find(positions_of(points.position, points.count), reach_, walls_of_fluid_);
  for (int a = 0; a < D; ++a) {
    found_at_[a].assign(points.position[a].begin(), points.position[a].begin() + points.count);
    walls_found_at_[a].assign(walls.position[a].begin(), walls.position[a].begin() + walls.count);
  }
  known_ = true;
  ++searches_;
}

/// The wall points that fluid is near, compactly, and their images.
template <int D>
void FluidNeighbours<D>::find_near_walls(const std::array<std::vector<double>, D>& wall_position,
                                         NearWalls<D>& walls) {
  const Index cloud = static_cast<Index>(wall_position[0].size());
  grid_.find(positions_of(wall_position, cloud), reach_, fluid_of_cloud_);
  walls.wall.clear();
  fluid_of_walls_.offset.assign(1, 0);
  fluid_of_walls_.other.clear();
  for (Index w = 0; w < cloud; ++w) {
    const Index begin = fluid_of_cloud_.offset[w], end = fluid_of_cloud_.offset[w + 1];
    if (begin == end) continue;
    walls.wall.push_back(w);
    fluid_of_walls_.other.insert(fluid_of_walls_.other.end(), fluid_of_cloud_.other.begin() + begin,
                                 fluid_of_cloud_.other.begin() + end);
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
