#include "modules/solid/fracture/short_seeds.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_lengths.hpp"
#include "core/bonds/crack_cut.hpp"
#include "modules/solid/fracture/crack_plane.hpp"

namespace perifrac {

namespace {

/// Facets of a crack with one tip, or that fluid drives; of a dry one with two. With three the
/// domain of J takes 0.6 of the other tip's, with four 0.05.
constexpr int least_facets = 2, least_dry_facets = 4;

/// How far the deepest square has to lie behind the front [spacings], and what that is of a disc's
/// radius and of the shorter side of a rectangle. Discs of 2 spacings (0.64 in a quarter) stay for
/// ever, those of 2.5 (0.95) grow as finer ones do.
constexpr double least_depth = 0.93, least_radius = 2.5, least_side = 4.0;

[[noreturn]] void refuse(const Section& scene, std::size_t k, const std::string& problem,
                         double spacing) {
  scene.fail(fmt::format("cracks[{}]", k), problem + ", too short to know when to grow",
             fmt::format("body.spacing: {:.6g} m or less", spacing));
}

/// Facets of all cracks that hang together, and what is known of them.
struct Chain {
  std::size_t crack;  ///< the first that is part of it
  double length = 0.0;
  int facets = 0;
  int tips = 0;
};

bool is_tip(const CrackFacet<2>& facet, int end, const Family<2>& cut, double longest) {
  const CrackFacet<2> next = {facet[end], 2.0 * facet[end] - facet[1 - end]};
  return !bonds_cut_by<2>(next, cut, longest).empty();
}

std::vector<Chain> find_chains(const Family<2>& cut,
                               std::span<const std::vector<CrackFacet<2>>> seeds) {
  std::vector<std::pair<std::size_t, CrackFacet<2>>> left;
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    for (const auto& facet : seeds[k]) left.emplace_back(k, facet);
  }
  const auto all = left;
  const double longest = bond_lengths(cut).longest;
  const auto meets = [](const CrackFacet<2>& facet, const Vector<2>& end) {
    return facet[0] == end || facet[1] == end;
  };
  std::vector<Chain> chains;
  while (!left.empty()) {
    Chain& chain = chains.emplace_back(Chain{.crack = left.front().first});
    std::vector<CrackFacet<2>> met{left.front().second};
    left.erase(left.begin());
    for (std::size_t n = 0; n < met.size(); ++n) {
      const CrackFacet<2> facet = met[n];
      ++chain.facets;
      chain.length += area<2>(facet);
      for (const int end : {0, 1}) {
        std::erase_if(left, [&](const auto& other) {
          if (!meets(other.second, facet[end])) return false;
          met.push_back(other.second);
          return true;
        });
        const auto here = std::ranges::count_if(
            all, [&](const auto& other) { return meets(other.second, facet[end]); });
        if (here == 1 && is_tip(facet, end, cut, longest)) ++chain.tips;
      }
    }
  }
  return chains;
}

}  // namespace

template <>
void check_seeds_can_grow<2>(const Section& scene, const Body<2>&, const Family<2>& cut,
                             std::span<const std::vector<CrackFacet<2>>> seeds) {
  for (const Chain& chain : find_chains(cut, seeds)) {
    const bool is_dry = !scene.has("crack_fluid");
    const int least = chain.tips > 1 && is_dry ? least_dry_facets : least_facets;
    if (chain.tips == 0 || chain.facets >= least) continue;
    refuse(
        scene, chain.crack,
        fmt::format("a crack of {}",
                    chain.facets == 1 ? "one spacing" : fmt::format("{} spacings", chain.facets)),
        chain.length / least);
  }
}

template <>
void check_seeds_can_grow<3>(const Section& scene, const Body<3>& body, const Family<3>&,
                             std::span<const std::vector<CrackFacet<3>>> seeds) {
  Vector<3> low, high;
  for (int a = 0; a < 3; ++a) {
    const auto [least, largest] = std::ranges::minmax(body.points().position[a]);
    low[a] = least - 0.25 * body.spacing();
    high[a] = largest + 0.25 * body.spacing();
  }
  const auto is_in_body = [&](const CrackFacet<3>& facet) {
    const Vector<3> x = middle<3>(facet);
    for (int a = 0; a < 3; ++a) {
      if (x[a] < low[a] || x[a] > high[a]) return false;
    }
    return true;
  };
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    CrackPlane plane(seeds[k].front(), is_in_body);
    for (std::size_t f = 0; f < seeds[k].size(); ++f) plane.add(seeds[k][f], static_cast<Index>(f));
    if (plane.ahead().empty()) continue;
    double deepest = -INFINITY;
    for (const auto& [cell, number] : plane.facets()) {
      deepest = std::max(deepest, plane.behind_front(cell));
    }
    if (deepest >= least_depth) continue;
    const std::string crack = fmt::format("cracks[{}]", k);
    const bool is_disc = scene.has(crack + ".radius");
    const std::vector<double> sides = is_disc ? std::vector<double>{scene.number(crack + ".radius")}
                                              : scene.numbers(crack + ".sides");
    const double size = std::ranges::min(sides);
    refuse(scene, k,
           fmt::format("a crack of {:.3g} spacings {}", size / body.spacing(),
                       is_disc ? "in radius" : "across"),
           size / (is_disc ? least_radius : least_side));
  }
}

}  // namespace perifrac
