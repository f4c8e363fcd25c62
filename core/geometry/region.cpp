#include "core/geometry/region.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

namespace {

/// A point of the body that lies within both, and not where they touch; -1: none.
template <int D>
Index point_in_both(const Region<D>& one, const Region<D>& other, const Points<D>& points) {
  for (int a = 0; a < D; ++a) {
    if (std::max(one.from[a], other.from[a]) >= std::min(one.to[a], other.to[a])) return -1;
  }
  for (Index i = 0; i < points.size(); ++i) {
    if (one.contains(points.at(i)) && other.contains(points.at(i))) return i;
  }
  return -1;
}

/// A point has one rock: which of two it would be nobody should have to know.
template <int D>
void refuse_overlaps(const Section& physics, const std::vector<Region<D>>& regions,
                     const std::vector<std::string>& named, const Points<D>& points) {
  std::vector<const Region<D>*> used;
  for (const std::string& name : named) {
    const auto found = std::ranges::find(regions, name, &Region<D>::name);
    if (found == regions.end()) continue;
    for (const Region<D>* other : used) {
      const Index point = point_in_both<D>(*other, *found, points);
      if (point < 0) continue;
      physics.fail("regions." + name,
                   fmt::format("overlaps region '{}', as at ({:.6g}) m", other->name,
                               fmt::join(points.at(point), ", ")),
                   "regions that have no point in common");
    }
    used.push_back(&*found);
  }
}

}  // namespace

template <int D>
std::vector<std::uint8_t> region_of_points(const Section& physics,
                                           const std::vector<Region<D>>& regions,
                                           const Points<D>& points) {
  std::vector<std::uint8_t> number(points.size(), 0);
  if (!physics.has("regions")) return number;
  std::vector<std::string> known;
  for (const Region<D>& region : regions) known.push_back(region.name);
  const std::vector<std::string> named = physics.names("regions");
  refuse_overlaps<D>(physics, regions, named, points);
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
