#include "modules/fluid/sph/sph_momentum.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

template <int D>
void find_sph_forces(const FluidStep<D>& step, const WendlandInfluence& influence,
                     FluidValues<D>& values, std::array<std::vector<double>, D>& force) {
  const FluidPoints<D>& points = step.points;
  const double bulk = step.moments.bulk_trace / D;
  const double least = step.fluid.density * step.scheme.artificial_viscosity *
                       step.fluid.sound_speed() * step.scheme.spacing;
  const double drag = 2.0 * std::max(step.fluid.viscosity, least);
  for (auto& along : force) along.resize(points.count);
  values.set(points.position, points.velocity, points.volume, points.pressure);
  for_each_shared_point(points.count, [&](Index i) {
    const double pressure = points.pressure[i];
    const Vector<D> v = vector_at(points.velocity, i);
    const auto sum = sum_over_values<D, D>(
        step.neighbours.fluid_of_fluid(), i, points.at(i), values, influence,
        [&](const auto& other, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * other[2 * D];
          const Packet both = pressure + other[2 * D + 1];
          PacketVector<D> term;
          for (int a = 0; a < D; ++a) {
            term[a] = weight * (drag * (other[D + a] - v[a]) - both * y[a]);
          }
          return term;
        });
    set_at(force, i, points.volume[i] / bulk * sum);
  });
  for (auto& along : force) ranks::gather_shares(along, points.count);
}

template void find_sph_forces<2>(const FluidStep<2>&, const WendlandInfluence&, FluidValues<2>&,
                                 std::array<std::vector<double>, 2>&);
template void find_sph_forces<3>(const FluidStep<3>&, const WendlandInfluence&, FluidValues<3>&,
                                 std::array<std::vector<double>, 3>&);

}  // namespace perifrac
