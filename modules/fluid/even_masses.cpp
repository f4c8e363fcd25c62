#include "modules/fluid/even_masses.hpp"

#include <cmath>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

namespace {

constexpr double diffusivity = 0.002;  // over sound speed times spacing
constexpr double least_part = 0.9;     // of a whole point's mass

}  // namespace

template <int D>
void EvenMasses<D>::step(const FluidStep<D>& step, double length, FluidPoints<D>& points) {
  const double spacing = step.scheme.spacing, volume = std::pow(spacing, D);
  const double least = least_part * step.fluid.density * volume;
  const double rate = 4.0 * D * diffusivity * step.fluid.sound_speed() * spacing * volume * length;
  mass_ = points.mass;
  step.neighbours.images().copy(mass_, points.count);
  for (auto& values : gained_) values.resize(points.count);
  for_each_point(points.count, [&](Index i) {
    const double mass = mass_[i], trace = step.moments.trace[i];
    const Vector<D> v = vector_at(points.velocity, i);
    const auto sum = sum_over_neighbours<1 + D, D>(
        step.neighbours.fluid_of_fluid(), i, points.at(i), points.position, step.influence,
        [&](Index j, const Vector<D>&, double omega) {
          std::array<double, 1 + D> term{};
          if (mass < least || mass_[j] < least) return term;
          term[0] = rate * omega / (trace + step.moments.trace[j]) * (mass_[j] - mass);
          for (int a = 0; a < D; ++a) {
            term[1 + a] = 0.5 * term[0] * (v[a] + points.velocity[a][j]);
          }
          return term;
        });
    for (int k = 0; k < 1 + D; ++k) gained_[k][i] = sum[k];
  });
  for (Index i = 0; i < points.count; ++i) {
    const double gained = gained_[0][i], together = points.mass[i] + gained;
    for (int a = 0; a < D; ++a) {
      points.velocity[a][i] += (gained_[1 + a][i] - gained * points.velocity[a][i]) / together;
    }
    points.density[i] += gained / points.volume[i];
    points.mass[i] = together;
  }
  for (auto& component : points.velocity) step.neighbours.images().copy(component, points.count);
}

template class EvenMasses<2>;
template class EvenMasses<3>;

}  // namespace perifrac
