#include "app/warnings/inlet_places.hpp"

#include <string>

#include <fmt/format.h>

namespace perifrac {

std::vector<std::vector<double>> inlet_places(const Section& scene) {
  std::vector<std::vector<double>> places;
  const auto add = [&](const std::string& list) {
    for (std::size_t k = 0; k < scene.count(list); ++k) {
      places.push_back(scene.numbers(fmt::format("{}[{}].at", list, k)));
    }
  };
  add("crack_fluid.inlets");
  for (std::size_t k = 0; k < scene.count("crack_fluid.wells"); ++k) {
    add(fmt::format("crack_fluid.wells[{}].clusters", k));
  }
  return places;
}

}  // namespace perifrac
