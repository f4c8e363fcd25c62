#include "modules/fluid/openings/outlets.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "modules/fluid/openings/named_box.hpp"

namespace perifrac {

template <int D>
Index Outlets<D>::remove(FluidPoints<D>& points) {
  return points.remove_if([&](Index i) {
    const Vector<D> x = period_.wrapped(points.at(i));
    if (std::ranges::none_of(boxes_, [&](const auto& box) { return box.contains(x); })) {
      return false;
    }
    removed_.add(points.mass[i]);
    return true;
  });
}

KeyTable outlet_keys() { return named_box_keys("outlets", "a box that takes in fluid for good"); }

template <int D>
std::vector<Region<D>> read_outlets(const Section& section) {
  std::vector<Region<D>> boxes;
  for (std::size_t k = 0; k < section.count("outlets"); ++k) {
    boxes.push_back(read_named_box<D>(section, fmt::format("outlets[{}]", k)));
  }
  return boxes;
}

template class Outlets<2>;
template class Outlets<3>;
template std::vector<Region<2>> read_outlets<2>(const Section&);
template std::vector<Region<3>> read_outlets<3>(const Section&);

}  // namespace perifrac
