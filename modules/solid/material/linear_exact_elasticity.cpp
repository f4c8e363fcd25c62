#include "modules/solid/material/linear_exact_elasticity.hpp"

namespace perifrac {

template class LinearExactOperator<2, IsotropicElasticity<2>>;
template class LinearExactOperator<3, IsotropicElasticity<3>>;
template class LinearExactElasticity<2, IsotropicElasticity<2>>;
template class LinearExactElasticity<3, IsotropicElasticity<3>>;
template class LinearExactElasticity<2, LawByRegion<IsotropicElasticity<2>>>;
template class LinearExactElasticity<3, LawByRegion<IsotropicElasticity<3>>>;

}  // namespace perifrac
