#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// The elastic constants that solutions ask for.
struct ElasticRock {
  double lame_lambda;    ///< [Pa]
  double shear_modulus;  ///< [Pa]

  double bulk_modulus() const { return lame_lambda + 2.0 / 3.0 * shear_modulus; }
  double uniaxial_modulus() const { return lame_lambda + 2.0 * shear_modulus; }
  double youngs_modulus() const;
  double plane_strain_modulus() const {  ///< E / (1 - nu^2)
    return 4.0 * shear_modulus * (lame_lambda + shear_modulus) /
           (lame_lambda + 2.0 * shear_modulus);
  }
  double poisson_ratio() const { return 0.5 * lame_lambda / (lame_lambda + shear_modulus); }
};

/// What they ask of the pores.
struct PorousRock {
  double biot_coefficient;
  double storage;   ///< at constant strain [1/Pa]
  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]
};

/// The scene has a solid that deforms by two elastic constants: one from outside need not.
bool has_elastic_rock(const Section& scene);

/// Reads them from the scene; in a region of the body, what the physics says of it where it does;
/// of rock that scatters, the mean. Throws InputError.
ElasticRock read_elastic_rock(const Section& scene, const std::string& region = "");
PorousRock read_porous_rock(const Section& scene, const std::string& region = "");

/// The first key by which the rock differs from place to place by chance, if there is one.
std::optional<std::string> scatter_of_rock(const Section& scene);

}  // namespace perifrac
