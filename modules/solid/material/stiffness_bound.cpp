#include "modules/solid/material/stiffness_bound.hpp"

#include <Eigen/Dense>

#include "core/bonds/shape_tensor.hpp"
#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

template <int D>
double stiffness_bound(const Family<D>& family, const IsotropicElasticity<D>& law, Index i) {
  using Matrix = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  double weight = 0.0;
  for (const auto& bond : family.bonds(i)) weight += bond.weight;
  if (!(weight > 0.0)) return 0.0;
  const auto sum = shape_tensor_at(family, i);
  const Eigen::Matrix<double, D, D> shape = Eigen::Map<const Matrix>(sum.data());
  if (is_thin(family, i)) {
    return (D * D * law.drained_bulk_modulus() + D * (D + 2) * law.shear_modulus) * weight /
           shape.trace();
  }
  return D * law.drained_bulk_modulus() * weight / symmetric_spectrum(shape).values[0];
}

template double stiffness_bound<2>(const Family<2>&, const IsotropicElasticity<2>&, Index);
template double stiffness_bound<3>(const Family<3>&, const IsotropicElasticity<3>&, Index);

}  // namespace perifrac
