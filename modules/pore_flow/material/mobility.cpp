#include "modules/pore_flow/material/mobility.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/geometry/scatter.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "modules/pore_flow/material/region_path.hpp"

namespace perifrac {

namespace {

/// Where the components of a list stand: xx, yy, xy in 2D; xx, yy, zz, xy, yz, zx in 3D.
template <int D>
constexpr std::array<std::array<int, 2>, D*(D + 1) / 2> component_place() {
  if constexpr (D == 2) {
    return {{{0, 0}, {1, 1}, {0, 1}}};
  } else {
    return {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  }
}

template <int D>
Tensor<D, D> read_tensor(const Section& section, const std::string& path) {
  constexpr auto place = component_place<D>();
  const char* const list = D == 2 ? "[xx, yy, xy]" : "[xx, yy, zz, xy, yz, zx]";
  const std::vector<double> given = section.numbers(path);
  if (given.size() != place.size()) {
    section.fail(path, fmt::format("{} components", given.size()),
                 fmt::format("{} of them, {}", place.size(), list));
  }
  Eigen::Matrix<double, D, D> tensor;
  for (std::size_t k = 0; k < place.size(); ++k) {
    tensor(place[k][0], place[k][1]) = tensor(place[k][1], place[k][0]) = given[k];
  }
  const auto values = symmetric_spectrum(tensor).values;
  constexpr double rounding = 1e-12;
  if (values[0] < -rounding * std::abs(values[D - 1])) {
    section.fail(path,
                 fmt::format("negative along one direction, {:.3g} m^2: fluid would flow towards "
                             "the higher pressure",
                             values[0]),
                 fmt::format("components {} of a positive semidefinite tensor", list));
  }
  Tensor<D, D> result;
  Eigen::Map<Eigen::Matrix<double, D, D>>(result.data()) = tensor;
  return result;
}

template <int D>
Tensor<D, D> read_permeability(const Section& section, std::string region) {
  const auto has = [&](const char* key) { return section.has(region + key); };
  if (!has("permeability") && !has("permeability_tensor")) region.clear();
  const bool scalar = has("permeability"), tensor = has("permeability_tensor");
  const char* const expected = "exactly one of permeability, permeability_tensor";
  if (scalar && tensor) {
    section.fail(region + "permeability_tensor", "stands beside a scalar permeability", expected);
  }
  if (tensor) return read_tensor<D>(section, region + "permeability_tensor");
  if (!scalar) section.fail("", "no permeability", expected);
  Tensor<D, D> result{};
  for (int a = 0; a < D; ++a) result[a * D + a] = section.number(region + "permeability");
  return result;
}

}  // namespace

template <int D>
std::vector<Tensor<D, D>> read_mobilities(const Section& section, double viscosity) {
  std::vector<Tensor<D, D>> mobilities;
  for (const std::string& region : region_prefixes(section)) {
    mobilities.push_back(read_permeability<D>(section, region));
    for (double& entry : mobilities.back()) entry /= viscosity;
  }
  return mobilities;
}

template <int D>
double isotropic_part(const Tensor<D, D>& mobility) {
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      if (mobility[a * D + b] != (a == b ? mobility[0] : 0.0)) return -1.0;
    }
  }
  return mobility[0];
}

KeyTable permeability_keys() {
  const std::string tensor_meaning =
      "Symmetric permeability, [xx, yy, xy] in 2D and [xx, yy, zz, xy, yz, zx] in 3D, in place of "
      "permeability.";
  KeyTable keys = {
      {.path = "permeability",
       .unit = "m^2",
       .range = "[0, inf)",
       .meaning = "Intrinsic permeability, the same along every direction."},
      {.path = "permeability_tensor",
       .type = KeyType::numbers,
       .unit = "m^2",
       .meaning = tensor_meaning},
      {.path = "regions.*.permeability",
       .unit = "m^2",
       .range = "[0, inf)",
       .meaning = "In a region of the body; as outside it where left out."},
      {.path = "regions.*.permeability_tensor",
       .type = KeyType::numbers,
       .unit = "m^2",
       .meaning = "In a region of the body, in place of its permeability."},
  };
  for (Key& key : scatter_keys("permeability_scatter", "the permeability")) {
    keys.push_back(std::move(key));
  }
  return keys;
}

template std::vector<Tensor<2, 2>> read_mobilities<2>(const Section&, double);
template std::vector<Tensor<3, 3>> read_mobilities<3>(const Section&, double);
template double isotropic_part<2>(const Tensor<2, 2>&);
template double isotropic_part<3>(const Tensor<3, 3>&);

}  // namespace perifrac
