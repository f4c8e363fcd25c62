#include "modules/solid/fracture/stretch_limit.hpp"

#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

struct Constants {
  double youngs_modulus, poisson_ratio;
};

template <int D>
Constants constants(const IsotropicElasticity<D>& law) {
  const double ratio = law.lame_lambda / (2.0 * (law.lame_lambda + law.shear_modulus));
  return {2.0 * law.shear_modulus * (1.0 + ratio), ratio};
}

}  // namespace

template <int D>
CrossingBonds crossing_bonds(const Family<D>& family, double spacing) {
  Index whole = 0;  // a point whose family no surface cuts
  for (Index i = 0; i < family.point_count; ++i) {
    if (family.bond_count(i) > family.bond_count(whole)) whole = i;
  }
  const auto sum_beyond = [&](double plane) {
    double sum = 0.0;
    for (const auto& [j, weight] : family.bonds(whole)) {
      const Vector<D> xi = vector_at(family.position, j) - vector_at(family.position, whole);
      if (xi[0] >= plane) sum += weight * squared_norm(xi);
    }
    return sum;
  };
  const double all = sum_beyond(-INFINITY);
  CrossingBonds result{0.0, 0.0};
  for (double plane = 0.5 * spacing;; plane += spacing) {
    const double share = sum_beyond(plane) / all;
    if (!(share > 0.0)) return result;
    result.single += spacing * share;
    result.squared += spacing * share * share;
  }
}

template <int D>
double consistent_stretch(const IsotropicElasticity<D>& law, double fracture_energy,
                          const CrossingBonds& bonds) {
  const double mu = law.shear_modulus;
  const double volumetric = D * D * law.drained_bulk_modulus() - D * (D + 2) * mu;
  return std::sqrt(fracture_energy /
                   (volumetric * bonds.squared + D * (D + 2) * mu * bonds.single));
}

double printed_stretch(const IsotropicElasticity<2>& law, double fracture_energy, double horizon) {
  const auto [e, nu] = constants(law);
  const double mu = law.shear_modulus;
  return std::sqrt(fracture_energy / ((4.0 * e / (2.0 * (1.0 - nu)) - 8.0 * mu) * 0.804 * horizon +
                                      8.0 * mu * 0.239 * horizon));
}

template <int D>
double calibrated_stretch(const IsotropicElasticity<D>& law, double fracture_energy,
                          double spacing) {
  const auto [e, nu] = constants(law);
  const double toughness = std::sqrt(fracture_energy * e / (1.0 - nu * nu));
  return (1.0 + nu) * (1.0 - 2.0 * nu) * toughness / (e * std::sqrt(M_PI * spacing));
}

template CrossingBonds crossing_bonds<2>(const Family<2>&, double);
template CrossingBonds crossing_bonds<3>(const Family<3>&, double);
template double consistent_stretch<2>(const IsotropicElasticity<2>&, double, const CrossingBonds&);
template double consistent_stretch<3>(const IsotropicElasticity<3>&, double, const CrossingBonds&);
template double calibrated_stretch<2>(const IsotropicElasticity<2>&, double, double);
template double calibrated_stretch<3>(const IsotropicElasticity<3>&, double, double);

}  // namespace perifrac
