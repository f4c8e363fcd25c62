#include "modules/fluid/points/merge_points.hpp"

#include <utility>
#include <vector>

namespace perifrac {

namespace {

/// Gives away all of point i; false where nobody is there to take it.
template <int D>
bool give_away(FluidPoints<D>& points, const FluidNeighbours<D>& neighbours,
               const PairInfluence& influence, Index i) {
  const PeriodicImages<D>& images = neighbours.images();
  const auto point_of = [&](Index j) {
    return j < points.count ? j : images.source[j - points.count];
  };
  const Vector<D> x = points.at(i);
  std::vector<std::pair<Index, double>> weights;
  const double all = sum_over_neighbours<1, D>(
      neighbours.fluid_of_fluid(), i, x, points.position, influence,
      [&](Index j, const Vector<D>&, double omega) {
        const Index receiver = point_of(j);
        const bool takes = receiver != i && points.mass[receiver] != 0.0;
        const double weight = takes ? omega * points.volume[receiver] : 0.0;
        weights.emplace_back(j, weight);
        return std::array{weight};
      })[0];
  if (!(all > 0.0)) return false;
  for (const auto& [j, weight] : weights) {
    if (weight == 0.0) continue;
    const Index receiver = point_of(j);
    const double share = weight / all;
    const double mass = share * points.mass[i];
    const double together = points.mass[receiver] + mass;
    const double part = mass / together;
    for (int a = 0; a < D; ++a) {
      const double shift = j < points.count ? 0.0 : images.shift[a][j - points.count];
      points.position[a][receiver] += part * (x[a] - shift - points.position[a][receiver]);
      points.velocity[a][receiver] += part * (points.velocity[a][i] - points.velocity[a][receiver]);
    }
    points.mass[receiver] = together;
    points.volume[receiver] += share * points.volume[i];
    points.density[receiver] = together / points.volume[receiver];
  }
  points.mass[i] = 0.0;
  return true;
}

}  // namespace

template <int D>
Index merge_points(FluidPoints<D>& points, const FluidNeighbours<D>& neighbours,
                   const PairInfluence& influence, double least) {
  Index gone = 0;
  for (Index i = 0; i < points.count; ++i) {
    if (points.mass[i] >= least || points.mass[i] == 0.0) continue;
    if (give_away(points, neighbours, influence, i)) ++gone;
  }
  return gone;
}

template Index merge_points<2>(FluidPoints<2>&, const FluidNeighbours<2>&, const PairInfluence&,
                               double);
template Index merge_points<3>(FluidPoints<3>&, const FluidNeighbours<3>&, const PairInfluence&,
                               double);

}  // namespace perifrac
