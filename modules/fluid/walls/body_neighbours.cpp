#include "modules/fluid/walls/body_neighbours.hpp"

#include <numeric>

#include "core/base/small_vector.hpp"
#include "core/geometry/cell_grid.hpp"

namespace perifrac {

template <int D>
BodyNeighbours<D>::BodyNeighbours(const Body<D>& body, const WallCloud<D>& cloud,
                                  std::span<const Index> others, const Period<D>& period,
                                  double horizon)
    : position(body.points().position), volume(body.points().volume), source(volume.size()) {
  std::iota(source.begin(), source.end(), 0);
  for (const Index w : others) {
    append(position, cloud.at(w));
    volume.push_back(cloud.volume[w]);
    source.push_back(-1);
  }
  const Index count = static_cast<Index>(volume.size());
  PeriodicImages<D> images;
  images.find(period, position, count, horizon);
  images.copy_positions(position, count);
  images.copy(volume, count);
  for (const Index k : images.source) source.push_back(source[k]);
  CellGrid<D> grid;
  grid.build(positions_of(position), horizon);
  grid.find(positions_of(cloud.position), horizon, near);
}

template struct BodyNeighbours<2>;
template struct BodyNeighbours<3>;

}  // namespace perifrac
