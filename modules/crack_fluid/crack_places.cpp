#include "modules/crack_fluid/crack_places.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/small_vector.hpp"
#include "core/body/crack_list.hpp"
#include "core/config/mistakes.hpp"
#include "modules/crack_fluid/crack_inlet_keys.hpp"

namespace perifrac {

namespace {

template <int D>
Vector<D> read_place(const Section& section, const std::string& path) {
  Vector<D> x;
  std::ranges::copy(section.numbers(path), x.begin());
  return x;
}

/// What an inlet at x feeds: the facets whose middles are nearest.
template <int D>
std::vector<std::size_t> fed_from(const Vector<D>& x, const std::vector<CrackFacet<D>>& facets,
                                  double spacing) {
  const auto off = [&](const CrackFacet<D>& facet) { return norm(middle<D>(facet) - x); };
  double nearest = std::numeric_limits<double>::infinity();
  for (const CrackFacet<D>& facet : facets) nearest = std::min(nearest, off(facet));
  std::vector<std::size_t> fed;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (off(facets[f]) <= nearest + 1e-6 * spacing) fed.push_back(f);
  }
  return fed;
}

template <int D>
void check_inlets(const Section& section, const std::vector<CrackFacet<D>>& facets, double spacing,
                  Mistakes& mistakes) {
  std::vector<std::vector<std::size_t>> fed;
  const std::vector<std::string> inlets = crack_inlet_paths(section);
  for (std::size_t k = 0; k < inlets.size(); ++k) {
    const std::string path = inlets[k] + ".at";
    const auto x = read_place<D>(section, path);
    double nearest = std::numeric_limits<double>::infinity();
    for (const CrackFacet<D>& facet : facets) nearest = std::min(nearest, distance<D>(x, facet));
    fed.push_back(fed_from<D>(x, facets, spacing));
    mistakes.note([&] {
      if (nearest > spacing * (1.0 + 1e-6)) {
        section.fail(path, fmt::format("lies {:.3g} m from the nearest crack", nearest),
                     fmt::format("a place on a crack, or within a spacing, {:g} m", spacing));
      }
      for (std::size_t other = 0; other < k; ++other) {
        if (std::ranges::find_first_of(fed[k], fed[other]) == fed[k].end()) continue;
        section.fail(path,
                     fmt::format("feeds the piece of crack that '{}' feeds",
                                 section.text(inlets[other] + ".name")),
                     fmt::format("inlets a spacing, {:g} m, or more apart", spacing));
      }
    });
  }
}

/// A crack that is not there yet may come to walls that are sealed, but not where there is no rock.
template <int D>
void check_boxes(const Section& section, const std::string& list,
                 const std::vector<CrackFacet<D>>& facets, const Points<D>* rock,
                 Mistakes& mistakes) {
  for (std::size_t k = 0; k < section.count(list); ++k) {
    const std::string path = fmt::format("{}[{}]", list, k);
    const Region<D> box{"", read_place<D>(section, path + ".from"),
                        read_place<D>(section, path + ".to")};
    bool holds = std::ranges::any_of(
        facets, [&](const CrackFacet<D>& facet) { return box.contains(middle<D>(facet)); });
    for (Index i = 0; rock != nullptr && !holds && i < rock->size(); ++i) {
      holds = box.contains(rock->at(i));
    }
    if (holds) continue;
    mistakes.note([&] {
      section.fail(path,
                   fmt::format("the box from ({:.6g}) to ({:.6g}) m holds no piece of a crack",
                               fmt::join(box.from, ", "), fmt::join(box.to, ", ")),
                   rock != nullptr ? "a box around a crack, or rock that one may grow through"
                                   : "a box around a crack");
    });
  }
}

}  // namespace

template <int D>
void check_crack_places(const Section& section, const Body<D>& body) {
  const Section scene = section.scene();
  const std::vector<CrackFacet<D>> facets = all_facets<D>(read_cracks<D>(scene, body));
  if (facets.empty()) return;  // which the solid says, or cracks that begin by themselves
  Mistakes mistakes;
  check_inlets<D>(section, facets, body.spacing(), mistakes);
  check_boxes<D>(section, "filled", facets, nullptr, mistakes);
  check_boxes<D>(section, "sealed", facets, scene.has("damage") ? &body.points() : nullptr,
                 mistakes);
  mistakes.throw_if_any();
}

template void check_crack_places<2>(const Section&, const Body<2>&);
template void check_crack_places<3>(const Section&, const Body<3>&);

}  // namespace perifrac
