#include "modules/solid/material/corotational_elasticity.hpp"

namespace perifrac {

template class CorotationalElasticity<2, IsotropicElasticity<2>>;
template class CorotationalElasticity<3, IsotropicElasticity<3>>;
template class CorotationalElasticity<2, LawByRegion<IsotropicElasticity<2>>>;
template class CorotationalElasticity<3, LawByRegion<IsotropicElasticity<3>>>;

}  // namespace perifrac
