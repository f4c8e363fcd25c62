#include "modules/fluid/semi_lagrangian/fluid_momentum.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

namespace {

template <int D>
void set_values(const FluidStep<D>& step, ForceValues<D>& values) {
  std::array<std::span<const double>, 2 * D + 2 + symmetric_size<D>> columns;
  for (int a = 0; a < D; ++a) {
    columns[a] = step.points.position[a];
    columns[D + a] = step.points.velocity[a];
  }
  columns[2 * D] = step.points.volume;
  columns[2 * D + 1] = step.moments.trace;
  for (int k = 0; k < symmetric_size<D>; ++k) columns[2 * D + 2 + k] = step.stress[k];
  values.set(columns);
}

/// Of neighbours on a point of velocity v, and behind it the heat, if asked for.
template <bool heats, int D>
[[gnu::always_inline]] inline std::array<Packet, D + heats> drag_of(const auto& other,
                                                                    const Vector<D>& v,
                                                                    const Packet& drag) {
  std::array<Packet, D + heats> term;
  if constexpr (heats) term[D] = Packet{};
  for (int a = 0; a < D; ++a) {
    const Packet relative = other[D + a] - v[a];
    term[a] = drag * relative;
    if constexpr (heats) term[D] += term[a] * relative;
  }
  return term;
}

/// Of a point whose stress is `own` and its neighbours on each other.
template <int D>
[[gnu::always_inline]] inline void add_pressures(const auto& other,
                                                 const std::array<double, symmetric_size<D>>& own,
                                                 const PacketVector<D>& y, auto& term) {
  for (int a = 0; a < D; ++a) {
    for (int b = a; b < D; ++b) {
      const int k = symmetric_index<D>(a, b);
      const Packet stress = own[k] + other[2 * D + 2 + k];
      term[a] += stress * y[b];
      if (b > a) term[b] += stress * y[a];
    }
  }
}

template <bool heats, int D>
void find_forces(const FluidStep<D>& step, const GaussianInfluence& influence,
                 ForceValues<D>& values, FluidForces<D>& forces) {
  const FluidPoints<D>& points = step.points;
  const FluidMoments<D>& moments = step.moments;
  const double least = step.fluid.density * step.scheme.artificial_viscosity *
                       step.fluid.sound_speed() * step.scheme.spacing;
  const double viscosity = 4.0 * D * std::max(step.fluid.viscosity, least);
  forces.resize(points.count);
  set_values<D>(step, values);
  for_each_shared_point(points.count, [&](Index i) {
    std::array<double, symmetric_size<D>> own;
    for (int k = 0; k < symmetric_size<D>; ++k) own[k] = step.stress[k][i];
    const Vector<D> v = vector_at(points.velocity, i);
    const double trace = moments.trace[i];
    const auto sum = sum_over_values<D + heats, D>(
        step.neighbours.fluid_of_fluid(), i, points.at(i), values, influence,
        [&](const auto& other, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * other[2 * D];
          const Packet drag = viscosity / (trace + other[2 * D + 1]);
          auto term = drag_of<heats, D>(other, v, drag);
          add_pressures<D>(other, own, y, term);
          for (Packet& component : term) component *= weight;
          return term;
        });
    for (int a = 0; a < D; ++a) forces.force[a][i] = points.volume[i] * sum[a];
    if constexpr (heats) forces.heat[i] = 0.5 * points.volume[i] * sum[D];
  });
  forces.gather();
}

}  // namespace

template <int D>
void find_pair_forces(const FluidStep<D>& step, const GaussianInfluence& influence,
                      ForceValues<D>& values, FluidForces<D>& forces) {
  if (forces.finds_heat) {
    find_forces<true>(step, influence, values, forces);
  } else {
    find_forces<false>(step, influence, values, forces);
  }
}

template void find_pair_forces<2>(const FluidStep<2>&, const GaussianInfluence&, ForceValues<2>&,
                                  FluidForces<2>&);
template void find_pair_forces<3>(const FluidStep<3>&, const GaussianInfluence&, ForceValues<3>&,
                                  FluidForces<3>&);

}  // namespace perifrac
