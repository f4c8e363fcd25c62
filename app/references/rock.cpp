#include "app/references/rock.hpp"

#include "app/references/comparison.hpp"
#include "modules/pore_flow/pore_material.hpp"
#include "modules/solid/isotropic_elasticity.hpp"

namespace perifrac {

double ElasticRock::youngs_modulus() const {
  return shear_modulus * (3.0 * lame_lambda + 2.0 * shear_modulus) / (lame_lambda + shear_modulus);
}

ElasticRock read_elastic_rock(const Section& scene, const std::string& region) {
  const std::string there = "regions." + region + ".material";
  const auto elasticity = read_isotropic_elasticity<3>(
      scene.at("solid"), writes(scene, "solid." + there) ? there : "material");
  return {elasticity.lame_lambda, elasticity.shear_modulus};
}

PorousRock read_porous_rock(const Section& scene, const std::string& region) {
  const PoreMaterial pore = read_pore_material(scene.at("pore_flow"));
  const std::string there = "pore_flow.regions." + region + ".permeability";
  const double permeability = scene.number("pore_flow.permeability");
  const double here = writes(scene, there) ? scene.number(there) : permeability;
  return {pore.biot_coefficient, pore.storage, pore.mobility * here / permeability};
}

}  // namespace perifrac
