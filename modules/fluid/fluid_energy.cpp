#include "modules/fluid/fluid_energy.hpp"

#include <array>
#include <string>

#include "core/base/small_vector.hpp"

namespace perifrac {

template <int D>
FluidEnergy<D>::FluidEnergy(const FluidProperties& fluid, const Vector<D>& gravity,
                            const FluidPoints<D>& points)
    : fluid_(fluid), gravity_(gravity) {
  double all = 0.0;
  for (const double mass : points.mass) all += mass;
  for (Index i = 0; i < points.count; ++i) centre_ += points.mass[i] / all * points.at(i);
  at_start_ = of_points(points, 0);
}

template <int D>
double FluidEnergy<D>::of_point(const FluidPoints<D>& points, Index i, double mass,
                                double density) const {
  const double square = squared_norm(vector_at(points.velocity, i));
  const double depth = dot(gravity_, points.at(i) - centre_);
  return mass * (0.5 * square + fluid_.elastic_energy(density) - depth);
}

template <int D>
double FluidEnergy<D>::of_points(const FluidPoints<D>& points, Index first) const {
  CompensatedSum sum;
  for (Index i = first; i < points.count; ++i) {
    sum.add(of_point(points, i, points.mass[i], points.density[i]));
  }
  return sum.value();
}

template <int D>
double FluidEnergy<D>::stored(const FluidPoints<D>& points) const {
  return of_points(points, 0) + lag_;
}

template <int D>
void FluidEnergy<D>::gain_with_mass(const FluidPoints<D>& points) {
  for (Index i = 0; i < points.count; ++i) {
    const double before = mass_[i], after = points.mass[i];
    if (after == before) continue;
    const double density = points.density[i];
    const double less = density - (after - before) / points.volume[i];
    gain(of_point(points, i, after, density) - of_point(points, i, before, less));
  }
}

template <int D>
void FluidEnergy<D>::visit_state(StateVisitor& visitor) {
  constexpr std::array axes = {"x", "y", "z"};
  for (int a = 0; a < D; ++a) visitor.visit(std::string("centre_") + axes[a], centre_[a]);
  visitor.visit("at_start", at_start_);
  gained_.visit_state(visitor, "gained");
  heat_.visit_state(visitor, "heat");
  visitor.visit("steps", steps_);
  visitor.visit("friction", friction_);
  visitor.visit("since_friction", since_);
  visitor.visit("lag", lag_);
}

template class FluidEnergy<2>;
template class FluidEnergy<3>;

}  // namespace perifrac
