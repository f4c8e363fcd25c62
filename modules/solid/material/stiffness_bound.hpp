#pragma once

#include "modules/solid/material/breakable_elasticity.hpp"

namespace perifrac {

/// Of the energy of point i with the bonds that it has, per sum of |u_j - u_i|^2 over them in the
/// mean, up to a factor that all points share. Its gradient F has |F|^2 <= sum w |du|^2 /
/// lambda_min(K); where the family is too thin for a gradient, theta^2 <= D^2 / m sum w |du|^2.
template <int D>
double stiffness_bound(const Family<D>& family, const IsotropicElasticity<D>& law, Index i);

}  // namespace perifrac
