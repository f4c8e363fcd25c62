#include "core/body/crack_list.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/body/outside.hpp"
#include "core/body/plane_crack_seeds.hpp"
#include "core/config/mistakes.hpp"

namespace perifrac {

namespace {

/// Cosine of the angle, 20 degrees, below which facets run beside each other.
constexpr double parallel = 0.94;

std::string name_of(const Section& scene, std::size_t k) {
  return scene.text(fmt::format("cracks[{}].name", k));
}

/// Corners of a path are within the body or on its faces.
void require_inside(const Section& scene, std::size_t k, const Body<2>& body) {
  const std::vector<Vector<2>> corners = read_crack_corners(scene, k);
  const bool from_file = scene.has(fmt::format("cracks[{}].file", k));
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const int face = face_before<2>(body, corners[n]);
    if (face < 0) continue;
    scene.fail(fmt::format("cracks[{}].{}", k, from_file ? "file" : "path"),
               fmt::format("corner {} at ({:.6g}) m lies outside the body, beyond face '{}'", n + 1,
                           fmt::join(corners[n], ", "), body.faces()[face].name),
               "corners in the body or on its faces");
  }
}

template <int D>
void refuse_in_cutouts(const Section& scene, std::size_t k, const Body<D>& body,
                       const std::vector<CrackFacet<D>>& facets) {
  for (const CrackFacet<D>& facet : facets) {
    const Vector<D> x = middle<D>(facet);
    const auto refuse = [&](const std::string& cutout) {
      scene.fail(fmt::format("cracks[{}]", k),
                 fmt::format("runs through cut-out '{}' at ({:.6g}) m", cutout, fmt::join(x, ", ")),
                 "a crack in the rock, which may begin at the walls of a cut-out");
    };
    for (const Region<D>& box : body.cutouts()) {
      if (box.contains(x)) refuse(box.name);
    }
    const int face = face_before<D>(body, x);
    if (face >= 0 && body.faces()[face].is_hole()) refuse(body.faces()[face].name);
  }
}

std::vector<CrackFacet<2>> read_one(const Section& scene, std::size_t k, const Body<2>& body) {
  std::vector<CrackFacet<2>> facets = read_crack(scene, k, body.spacing());
  require_inside(scene, k, body);
  refuse_in_cutouts<2>(scene, k, body, facets);
  return facets;
}

std::vector<CrackFacet<3>> read_one(const Section& scene, std::size_t k, const Body<3>& body) {
  std::vector<CrackFacet<3>> facets = read_plane_crack(scene, k, body);
  refuse_in_cutouts<3>(scene, k, body, facets);
  return facets;
}

/// A facet with what its neighbours are asked for.
template <int D>
struct Placed {
  const CrackFacet<D>* facet;
  std::size_t crack, number;
  Vector<D> at, normal;
};

/// The middle of one lies beside the other, less than `least` off.
template <int D>
bool lies_along(const Placed<D>& one, const CrackFacet<D>& other, const Vector<D>& normal,
                double least) {
  if (std::abs(dot(one.at - other[0], normal)) >= least) return false;
  return std::ranges::all_of(place_within<D>(other, one.at),
                             [](double share) { return share > 0.0 && share < 1.0; });
}

template <int D>
bool coincide(const Placed<D>& one, const Placed<D>& other, double least) {
  const double cosine = dot(one.normal, other.normal);
  if (std::abs(cosine) < parallel) return false;
  if (one.crack == other.crack) {
    // A plane crack is one by itself, and a path only where it turns back.
    if (D == 3) return false;
    const std::size_t apart =
        std::max(one.number, other.number) - std::min(one.number, other.number);
    if (apart < 2) return apart == 1 && cosine < 0.0;
  }
  return lies_along<D>(one, *other.facet, other.normal, least) ||
         lies_along<D>(other, *one.facet, one.normal, least);
}

/// All facets, in the order of an axis along which they are spread.
template <int D>
std::vector<Placed<D>> in_order(const std::vector<std::vector<CrackFacet<D>>>& cracks, int& axis) {
  std::vector<Placed<D>> all;
  Vector<D> low, high;
  low.fill(INFINITY);
  high.fill(-INFINITY);
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    for (std::size_t f = 0; f < cracks[k].size(); ++f) {
      const CrackFacet<D>& facet = cracks[k][f];
      all.push_back({&facet, k, f, middle<D>(facet), frame<D>(facet)[0]});
      for (int a = 0; a < D; ++a) {
        low[a] = std::min(low[a], all.back().at[a]);
        high[a] = std::max(high[a], all.back().at[a]);
      }
    }
  }
  axis = 0;
  for (int a = 1; a < D; ++a) {
    if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
  }
  std::ranges::stable_sort(all, {}, [&](const Placed<D>& placed) { return placed.at[axis]; });
  return all;
}

/// The first pair of every two cracks.
template <int D>
void refuse_coincident(const Section& scene, const std::vector<std::vector<CrackFacet<D>>>& cracks,
                       double spacing, Mistakes& mistakes) {
  int axis = 0;
  const std::vector<Placed<D>> all = in_order<D>(cracks, axis);
  const double least = (1.0 - 1e-6) * spacing, reach = 2.5 * spacing;
  std::vector<bool> said(cracks.size(), false);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size() && all[j].at[axis] - all[i].at[axis] < reach; ++j) {
      const bool in_turn = all[i].crack <= all[j].crack;
      const Placed<D>& first = in_turn ? all[i] : all[j];
      const Placed<D>& later = in_turn ? all[j] : all[i];
      if (said[later.crack] || !coincide<D>(all[i], all[j], least)) continue;
      said[later.crack] = true;
      mistakes.note([&] {
        scene.fail(fmt::format("cracks[{}]", later.crack),
                   fmt::format("'{}' lies upon {} at ({:.6g}) m", name_of(scene, later.crack),
                               first.crack == later.crack
                                   ? "itself"
                                   : fmt::format("crack '{}'", name_of(scene, first.crack)),
                               fmt::join(later.at, ", ")),
                   fmt::format("cracks a spacing, {:g} m, or more apart where they are parallel",
                               spacing));
      });
    }
  }
}

}  // namespace

template <int D>
std::vector<std::vector<CrackFacet<D>>> read_cracks(const Section& scene, const Body<D>& body) {
  std::vector<std::vector<CrackFacet<D>>> cracks(scene.count("cracks"));
  Mistakes mistakes;
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    mistakes.note([&] { cracks[k] = read_one(scene, k, body); });
  }
  refuse_coincident<D>(scene, cracks, body.spacing(), mistakes);
  mistakes.throw_if_any();
  return cracks;
}

template <int D>
std::vector<CrackFacet<D>> all_facets(const std::vector<std::vector<CrackFacet<D>>>& cracks) {
  std::vector<CrackFacet<D>> all;
  for (const auto& crack : cracks) all.insert(all.end(), crack.begin(), crack.end());
  return all;
}

template <int D>
double distance(const Vector<D>& x, const CrackFacet<D>& facet) {
  Vector<D> nearest = facet[0];
  const auto along = place_within<D>(facet, x);
  for (std::size_t k = 0; k < along.size(); ++k) {
    const Vector<D>& side = facet[k == 0 ? 1 : D];
    const double share = std::clamp(along[k], 0.0, 1.0);
    nearest += share * (side - facet[0]);
  }
  return norm(x - nearest);
}

template std::vector<std::vector<CrackFacet<2>>> read_cracks<2>(const Section&, const Body<2>&);
template std::vector<std::vector<CrackFacet<3>>> read_cracks<3>(const Section&, const Body<3>&);
template std::vector<CrackFacet<2>> all_facets<2>(const std::vector<std::vector<CrackFacet<2>>>&);
template std::vector<CrackFacet<3>> all_facets<3>(const std::vector<std::vector<CrackFacet<3>>>&);
template double distance<2>(const Vector<2>&, const CrackFacet<2>&);
template double distance<3>(const Vector<3>&, const CrackFacet<3>&);

}  // namespace perifrac
