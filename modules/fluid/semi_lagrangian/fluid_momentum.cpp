#include "modules/fluid/semi_lagrangian/fluid_momentum.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

template <int D>
void find_pair_forces(const FluidStep<D>& step, const GaussianInfluence& influence,
                      std::array<std::vector<double>, D>& force) {
  const FluidPoints<D>& points = step.points;
  const FluidMoments<D>& moments = step.moments;
  const double least = step.fluid.density * step.scheme.artificial_viscosity *
                       step.fluid.sound_speed() * step.scheme.spacing;
  const double viscosity = 4.0 * D * std::max(step.fluid.viscosity, least);
  for (auto& values : force) values.resize(points.count);
  for_each_shared_point(points.count, [&](Index i) {
    std::array<double, symmetric_size<D>> own;
    for (int k = 0; k < symmetric_size<D>; ++k) own[k] = step.stress[k][i];
    const Vector<D> v = vector_at(points.velocity, i);
    const double trace = moments.trace[i];
    const auto sum = sum_over_neighbours<D, D>(
        step.neighbours.fluid_of_fluid(), i, points.at(i), points.position, influence,
        [&](const Index* j, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * gather(points.volume, j);
          const Packet drag = viscosity / (trace + gather(moments.trace, j));
          PacketVector<D> term;
          for (int a = 0; a < D; ++a) term[a] = drag * (gather(points.velocity[a], j) - v[a]);
          for (int a = 0; a < D; ++a) {
            for (int b = a; b < D; ++b) {
              const int k = symmetric_index<D>(a, b);
              const Packet stress = own[k] + gather(step.stress[k], j);
              term[a] += stress * y[b];
              if (b > a) term[b] += stress * y[a];
            }
          }
          for (Packet& component : term) component *= weight;
          return term;
        });
    set_at(force, i, points.volume[i] * sum);
  });
  for (auto& values : force) ranks::gather_shares(values, points.count);
}

template void find_pair_forces<2>(const FluidStep<2>&, const GaussianInfluence&,
                                  std::array<std::vector<double>, 2>&);
template void find_pair_forces<3>(const FluidStep<3>&, const GaussianInfluence&,
                                  std::array<std::vector<double>, 3>&);

}  // namespace perifrac
