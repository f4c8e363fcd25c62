#include "core/geometry/region.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace perifrac {

KeyTable region_keys() {
  return {
      {.path = "regions.*.from",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Low corner of a box with a name, for a physics to refer to; left out: no end."},
      {.path = "regions.*.to",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "High corner of the box; left out: no end."},
  };
}

template <int D>
std::vector<Region<D>> read_regions(const Section& body) {
  std::vector<Region<D>> regions;
  if (!body.has("regions")) return regions;
  for (const std::string& name : body.names("regions")) {
    const std::string path = "regions." + name;
    Region<D> region;
    region.name = name;
    region.from.fill(-std::numeric_limits<double>::infinity());
    region.to.fill(std::numeric_limits<double>::infinity());
    if (body.has(path + ".from")) {
      std::ranges::copy(body.numbers(path + ".from"), region.from.begin());
    }
    if (body.has(path + ".to")) std::ranges::copy(body.numbers(path + ".to"), region.to.begin());
    regions.push_back(region);
  }
  return regions;
}

template <int D>
std::vector<std::uint8_t> region_of_points(const Section& physics,
                                           const std::vector<Region<D>>& regions,
                                           const Points<D>& points) {
  std::vector<std::uint8_t> number(points.size(), 0);
  if (!physics.has("regions")) return number;
  std::vector<std::string> known;
  for (const Region<D>& region : regions) known.push_back(region.name);
  const std::vector<std::string> named = physics.names("regions");
  for (std::size_t n = 0; n < named.size(); ++n) {
    const std::string path = "regions." + named[n];
    const auto found = std::ranges::find(known, named[n]);
    if (found == known.end() && known.empty()) {
      physics.fail(path, "the body has no regions", "one of that name under body.regions");
    }
    if (found == known.end()) physics.fail_unknown(path, named[n], known);
    if (n + 1 > std::numeric_limits<std::uint8_t>::max()) {
      physics.fail(path, "too many regions", "at most 255");
    }
    const Region<D>& region = regions[found - known.begin()];
    bool empty = true;
    for (Index i = 0; i < points.size(); ++i) {
      if (!region.contains(points.at(i))) continue;
      number[i] = static_cast<std::uint8_t>(n + 1);
      empty = false;
    }
    if (empty) physics.fail(path, "no point lies in this region", "a region that holds points");
  }
  return number;
}

template std::vector<Region<2>> read_regions<2>(const Section&);
template std::vector<Region<3>> read_regions<3>(const Section&);
template std::vector<std::uint8_t> region_of_points<2>(const Section&,
                                                       const std::vector<Region<2>>&,
                                                       const Points<2>&);
template std::vector<std::uint8_t> region_of_points<3>(const Section&,
                                                       const std::vector<Region<3>>&,
                                                       const Points<3>&);

}  // namespace perifrac
