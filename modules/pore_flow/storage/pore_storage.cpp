#include "modules/pore_flow/storage/pore_storage.hpp"

namespace perifrac {

void PoreStorage::pressure_change(double t, std::span<const double> zeta,
                                  std::span<const double> change, std::span<double> dp,
                                  double /*tolerance*/) {
  const std::span<const double> storage = effective_storage(t, zeta);
  for (Index i = 0; i < materials_.points(); ++i) dp[i] = change[i] / storage[i];
}

void PoreStorage::add_to(Eigen::SparseMatrix<double>& matrix, double t,
                         std::span<const double> zeta, std::span<const double> volume) {
  const std::span<const double> storage = effective_storage(t, zeta);
  for (Index i = 0; i < materials_.points(); ++i) matrix.coeffRef(i, i) += volume[i] * storage[i];
}

}  // namespace perifrac
