#include "docs/example_material/reinforced.hpp"

#include <cmath>

#include "modules/solid/material/law_material.hpp"

namespace perifrac {

template <int D>
Reinforced<D> Reinforced<D>::read(const Section& material, const IsotropicElasticity<D>& rock) {
  Reinforced law{rock, material.number("along_stiffness"), {}};
  const std::vector<double> direction = material.numbers("along");
  double square = 0.0;
  for (const double component : direction) square += component * component;
  if (!(square > 0.0)) material.fail("along", "has no length", "a direction, as in [1, 0]");
  for (int a = 0; a < D; ++a) law.along[a] = direction[a] / std::sqrt(square);
  return law;
}

template struct Reinforced<2>;
template struct Reinforced<3>;

MaterialType reinforced_material() {
  return law_material<Reinforced>(
      "reinforced", "rock that is stiffer in one direction",
      {{.path = "along_stiffness",
        .unit = "Pa",
        .range = "[0, inf)",
        .required = true,
        .meaning = "Stiffness that the reinforcement adds in its direction."},
       {.path = "along",
        .type = KeyType::vector,
        .required = true,
        .meaning = "Direction of the reinforcement, of any length."}});
}

}  // namespace perifrac
