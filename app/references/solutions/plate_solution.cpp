#include "app/references/solutions/plate_solution.hpp"

namespace perifrac {

std::array<double, 3> uniform_strain(double youngs_modulus, double poisson_ratio,
                                     std::array<double, 3> stress, int dimension) {
  // What keeps the third strain at zero.
  if (dimension == 2) stress[2] = poisson_ratio * (stress[0] + stress[1]);
  const double sum = stress[0] + stress[1] + stress[2];
  std::array<double, 3> strain;
  for (int a = 0; a < 3; ++a) {
    strain[a] = ((1.0 + poisson_ratio) * stress[a] - poisson_ratio * sum) / youngs_modulus;
  }
  return strain;
}

}  // namespace perifrac
