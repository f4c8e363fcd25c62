#include "modules/solid/material/isotropic_elasticity.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

namespace {

const std::vector<std::string> constant_names = {"youngs_modulus", "poisson_ratio", "bulk_modulus",
                                                 "shear_modulus", "lame_lambda"};

struct LameConstants {
  double lambda;
  double mu;
};

/// From any two of E, nu, K, mu, lambda; the others are empty.
LameConstants lame_constants(std::optional<double> young, std::optional<double> poisson,
                             std::optional<double> bulk, std::optional<double> shear,
                             std::optional<double> lambda) {
  if (shear && lambda) return {*lambda, *shear};
  if (bulk && shear) return {*bulk - 2.0 / 3.0 * *shear, *shear};
  if (bulk && lambda) return {*lambda, 1.5 * (*bulk - *lambda)};
  if (poisson) {
    const double nu = *poisson;
    double mu = 0.0;
    if (young) mu = *young / (2.0 * (1.0 + nu));
    if (shear) mu = *shear;
    if (bulk) mu = 1.5 * *bulk * (1.0 - 2.0 * nu) / (1.0 + nu);
    if (lambda) mu = *lambda * (1.0 - 2.0 * nu) / (2.0 * nu);
    return {2.0 * mu * nu / (1.0 - 2.0 * nu), mu};
  }
  const double e = *young;
  if (bulk) {
    const double mu = 3.0 * *bulk * e / (9.0 * *bulk - e);
    return {*bulk - 2.0 / 3.0 * mu, mu};
  }
  if (shear) return {*shear * (e - 2.0 * *shear) / (3.0 * *shear - e), *shear};
  const double root = std::sqrt(e * e + 9.0 * *lambda * *lambda + 2.0 * e * *lambda);
  return {*lambda, (e - 3.0 * *lambda + root) / 4.0};
}

}  // namespace

KeyTable elastic_constant_keys() {
  return {
      {.path = "material.youngs_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "Young's modulus of the drained rock."},
      {.path = "material.poisson_ratio",
       .range = "(-1, 0.5)",
       .meaning = "Poisson's ratio of the drained rock."},
      {.path = "material.bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "Bulk modulus of the drained rock."},
      {.path = "material.shear_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "Shear modulus."},
      {.path = "material.lame_lambda",
       .unit = "Pa",
       .meaning = "Lame's first constant of the drained rock."},
  };
}

template <int D>
IsotropicElasticity<D> read_isotropic_elasticity(const Section& section, const std::string& path) {
  std::vector<std::optional<double>> value;
  std::vector<std::string> given;
  for (const std::string& name : constant_names) {
    const std::string key = path + "." + name;
    value.push_back(section.has(key) ? std::optional(section.number(key)) : std::nullopt);
    if (value.back()) given.push_back(name);
  }
  const std::string expected = fmt::format("exactly two of {}", fmt::join(constant_names, ", "));
  if (given.size() != 2) {
    section.fail(path, fmt::format("elastic constants given: {}", given.size()), expected);
  }
  const auto [lambda, mu] = lame_constants(value[0], value[1], value[2], value[3], value[4]);
  if (!(mu > 0.0) || !(lambda + 2.0 / 3.0 * mu > 0.0) || !std::isfinite(lambda)) {
    section.fail(path, fmt::format("{} and {} leave no stable solid", given[0], given[1]),
                 "constants with positive shear and bulk modulus");
  }
  return {lambda, mu};
}

template IsotropicElasticity<2> read_isotropic_elasticity<2>(const Section&, const std::string&);
template IsotropicElasticity<3> read_isotropic_elasticity<3>(const Section&, const std::string&);

}  // namespace perifrac
