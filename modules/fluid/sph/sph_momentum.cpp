#include "modules/fluid/sph/sph_momentum.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

namespace {

template <bool heats, int D>
void find_forces_of_sph(const FluidStep<D>& step, const WendlandInfluence& influence,
                        FluidValues<D>& values, FluidForces<D>& forces) {
  const FluidPoints<D>& points = step.points;
  const double bulk = step.moments.bulk_trace / D;
  const double least = step.fluid.density * step.scheme.artificial_viscosity *
                       step.fluid.sound_speed() * step.scheme.spacing;
  const double drag = 2.0 * std::max(step.fluid.viscosity, least);
  forces.resize(points.count);
  values.set(points.position, points.velocity, points.volume, points.pressure);
  for_each_shared_point(points.count, [&](Index i) {
    const double pressure = points.pressure[i];
    const Vector<D> v = vector_at(points.velocity, i);
    const auto sum = sum_over_values<D + heats, D>(
        step.neighbours.fluid_of_fluid(), i, points.at(i), values, influence,
        [&](const auto& other, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * other[2 * D];
          const Packet both = pressure + other[2 * D + 1];
          std::array<Packet, D + heats> term;
          Packet square{};
          for (int a = 0; a < D; ++a) {
            const Packet relative = other[D + a] - v[a];
            if constexpr (heats) square += relative * relative;
            term[a] = weight * (drag * relative - both * y[a]);
          }
          if constexpr (heats) term[D] = weight * drag * square;
          return term;
        });
    const double part = points.volume[i] / bulk;
    for (int a = 0; a < D; ++a) forces.force[a][i] = part * sum[a];
    if constexpr (heats) forces.heat[i] = 0.5 * part * sum[D];
  });
  forces.gather();
}

}  // namespace

template <int D>
void find_sph_forces(const FluidStep<D>& step, const WendlandInfluence& influence,
                     FluidValues<D>& values, FluidForces<D>& forces) {
  if (forces.finds_heat) {
    find_forces_of_sph<true>(step, influence, values, forces);
  } else {
    find_forces_of_sph<false>(step, influence, values, forces);
  }
}

template void find_sph_forces<2>(const FluidStep<2>&, const WendlandInfluence&, FluidValues<2>&,
                                 FluidForces<2>&);
template void find_sph_forces<3>(const FluidStep<3>&, const WendlandInfluence&, FluidValues<3>&,
                                 FluidForces<3>&);

}  // namespace perifrac
