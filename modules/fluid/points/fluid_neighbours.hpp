#pragma once

#include "core/geometry/cell_grid.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// Who is near whom: lists that reach beyond the horizon by a skin, so that they hold until points
/// have moved through half of it. Points are put in the order of their cells when lists are made.
template <int D>
class FluidNeighbours {
 public:
  FluidNeighbours(double horizon, double skin, Period<D> period)
      : reach_(horizon + skin), skin_(skin), period_(std::move(period)) {}

  /// Lists must be made anew before they are next used.
  void forget() { known_ = false; }
  bool known() const { return known_; }

  /// Makes the lists and the images, and reorders the points. `wall_position` is where all points
  /// of the cloud are now.
  void find(FluidPoints<D>& points, const std::array<std::vector<double>, D>& wall_position,
            NearWalls<D>& walls);

  /// Some point has moved so far that a neighbour may be missing.
  bool outdated(const FluidPoints<D>& points, const NearWalls<D>& walls) const;

  /// Whoever follows `along` for long comes back by the other end of a period.
  bool wraps_along(const Vector<D>& along) const;

  const PeriodicImages<D>& images() const { return images_; }
  const PeriodicImages<D>& wall_images() const { return wall_images_; }
  const Neighbours& fluid_of_fluid() const { return fluid_of_fluid_; }
  /// Of every fluid point, among the near walls.
  const Neighbours& walls_of_fluid() const { return walls_of_fluid_; }
  /// Of every near wall point, images apart.
  const Neighbours& fluid_of_walls() const { return fluid_of_walls_; }
  std::int64_t searches() const { return searches_; }  ///< in this process

 private:
  void wrap(FluidPoints<D>& points) const;
  void sort(FluidPoints<D>& points);
  void find_candidates(const FluidPoints<D>& points,
                       const std::array<std::vector<double>, D>& wall_position);
  void find_near_walls(const FluidPoints<D>& points,
                       const std::array<std::vector<double>, D>& wall_position,
                       NearWalls<D>& walls);

  double reach_;
  double skin_;
  Period<D> period_;
  bool known_ = false;
  CellGrid<D> grid_;
  PeriodicImages<D> images_;
  PeriodicImages<D> wall_images_;
  Neighbours fluid_of_fluid_;
  Neighbours walls_of_fluid_;
  Neighbours fluid_of_walls_;
  std::vector<Index> candidates_;  ///< of the wall cloud, that fluid may be near
  std::array<std::vector<double>, D> candidate_position_;
  Neighbours fluid_of_candidates_;
  std::array<std::vector<double>, D> found_at_;  ///< where the points were
  std::array<std::vector<double>, D> walls_found_at_;
  std::vector<double> sorted_;  // workspace
  std::vector<std::int64_t> sorted_id_;
  std::int64_t searches_ = 0;
};

}  // namespace perifrac
