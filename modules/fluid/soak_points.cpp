#include "modules/fluid/soak_points.hpp"

namespace perifrac {

template <int D>
Index soak_points(const FluidStep<D>& step, const NearWalls<D>& walls, double least,
                  FluidPoints<D>& points, std::vector<double>& exchanged_mass,
                  std::vector<double>& impulse) {
  const auto share_out = [&](Index i, double per_weight) {
    return sum_over_neighbours<1, D>(step.neighbours.walls_of_fluid(), i, points.at(i),
                                     walls.position, step.influence,
                                     [&](Index w, const Vector<D>&, double omega) {
                                       const Index wall = walls.wall[w];
                                       if (step.cloud.is_rigid(wall)) return std::array{0.0};
                                       const double weight = omega * walls.volume[w];
                                       const Index owner = step.cloud.owner[wall];
                                       exchanged_mass[owner] += per_weight * weight;
                                       for (int a = 0; a < D; ++a) {
                                         impulse[a * exchanged_mass.size() + owner] +=
                                             per_weight * weight * points.velocity[a][i];
                                       }
                                       return std::array{weight};
                                     })[0];
  };
  Index gone = 0;
  for (Index i = 0; i < points.count; ++i) {
    if (points.mass[i] >= least) continue;
    const double weights = share_out(i, 0.0);
    if (weights == 0.0) continue;
    share_out(i, points.mass[i] / weights);
    points.mass[i] = 0.0;
    ++gone;
  }
  return gone;
}

template Index soak_points<2>(const FluidStep<2>&, const NearWalls<2>&, double, FluidPoints<2>&,
                              std::vector<double>&, std::vector<double>&);
template Index soak_points<3>(const FluidStep<3>&, const NearWalls<3>&, double, FluidPoints<3>&,
                              std::vector<double>&, std::vector<double>&);

}  // namespace perifrac
