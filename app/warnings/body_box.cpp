#include "app/warnings/body_box.hpp"

namespace perifrac {

std::array<std::vector<double>, 2> body_box(const Section& scene) {
  const std::vector<double> size = scene.numbers("body.size");
  std::vector<double> low(size.size(), 0.0);
  if (scene.has("body.from")) low = scene.numbers("body.from");
  std::vector<double> high = low;
  for (std::size_t a = 0; a < size.size(); ++a) high[a] += size[a];
  return {low, high};
}

}  // namespace perifrac
