#pragma once

#include <vector>

#include <Eigen/Core>

namespace perifrac {

/// Faces of cracks that cannot pass through one another (without friction).
struct Contact {
  Eigen::VectorXd opening;   ///< [m]; 0 where closed
  Eigen::VectorXd pressure;  ///< of contact [Pa]; 0 where open
  std::vector<int> closed;
};

/// The pressures q >= 0 of contact under which no facet's opening, free + compliance q, is below
/// zero, and that act on closed facets alone. Overlaps below `smallest` [m] are none; a facet whose
/// opening does not answer to its own pressure is left as it is.
Contact find_contact(const Eigen::VectorXd& free, const Eigen::MatrixXd& compliance,
                     double smallest);

/// d(opening)/d(pressure) where these facets stay closed.
Eigen::MatrixXd compliance_beside(const std::vector<int>& closed,
                                  const Eigen::MatrixXd& compliance);

}  // namespace perifrac
