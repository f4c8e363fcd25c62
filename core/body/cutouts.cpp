#include "core/body/cutouts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_list.hpp"

namespace perifrac {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Of a place on the lattice, in spacings; of a bond's length.
constexpr double place_rounding = 1e-9;

/// The cut-outs, and their images behind mirrored faces in the order in which ghosts are made.
template <int D>
std::vector<Region<D>> with_images(std::span<const Region<D>> cutouts, std::span<const Face> faces,
                                   FaceSet mirrored) {
  std::vector<Region<D>> all(cutouts.begin(), cutouts.end());
  for (int f = 0; f < std::ssize(faces); ++f) {
    if (!contains(mirrored, f) || faces[f].curved()) continue;
    const std::size_t count = all.size();
    for (std::size_t k = 0; k < count; ++k) {
      Region<D> image = all[k];
      const int a = faces[f].axis;
      image.from[a] = 2.0 * faces[f].coordinate - all[k].to[a];
      image.to[a] = 2.0 * faces[f].coordinate - all[k].from[a];
      all.push_back(image);
    }
  }
  return all;
}

}  // namespace

KeyTable cutout_keys() {
  return {
      {.path = "cutouts.*.from",
       .type = KeyType::vector,
       .unit = "m",
       .meaning =
           "Low corner of a box that is no part of a body of shape box, such as a notch or a "
           "borehole, half-way between points; left out: no end. No bond passes through."},
      {.path = "cutouts.*.to",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Its high corner; left out: no end."},
  };
}

template <int D>
std::vector<Region<D>> read_cutouts(const Section& body, const Vector<D>& origin, double spacing) {
  std::vector<Region<D>> cutouts;
  if (!body.has("cutouts")) return cutouts;
  for (const std::string& name : body.names("cutouts")) {
    const std::string path = "cutouts." + name;
    Region<D> box;
    box.name = name;
    box.from.fill(-infinity);
    box.to.fill(infinity);
    if (body.has(path + ".from")) std::ranges::copy(body.numbers(path + ".from"), box.from.begin());
    if (body.has(path + ".to")) std::ranges::copy(body.numbers(path + ".to"), box.to.begin());
    for (int a = 0; a < D; ++a) {
      for (const auto& [corner, x] : {std::pair{".from", box.from[a]}, {".to", box.to[a]}}) {
        const double cells = (x - origin[a]) / spacing;
        if (!std::isfinite(cells) || std::abs(cells - std::round(cells)) < 1e-6) continue;
        body.fail(path + corner, fmt::format("{:g} m is not a whole number of spacings", x),
                  fmt::format("multiples of body.spacing, {:g} m", spacing));
      }
    }
    cutouts.push_back(box);
  }
  return cutouts;
}

template <int D>
void cut_out(const Section& body, const std::vector<Region<D>>& cutouts, Points<D>& points) {
  std::vector<bool> holds_any(cutouts.size(), false);
  Points<D> kept;
  for (Index i = 0; i < points.size(); ++i) {
    bool gone = false;
    for (std::size_t k = 0; k < cutouts.size(); ++k) {
      if (!cutouts[k].contains(points.at(i))) continue;
      gone = true;
      holds_any[k] = true;
    }
    if (!gone) kept.add(points.at(i), points.volume[i]);
  }
  for (std::size_t k = 0; k < cutouts.size(); ++k) {
    if (holds_any[k]) continue;
    body.fail("cutouts." + cutouts[k].name, "takes no point out of the body",
              "a box of a spacing or more that reaches into the body");
  }
  if (kept.size() == 0) body.fail("cutouts", "nothing is left of the body", "smaller boxes");
  points = std::move(kept);
}

template <int D>
bool passes_through(const Region<D>& box, const Vector<D>& x, const Vector<D>& y) {
  double enters = 0.0, leaves = 1.0;  // along the segment
  for (int a = 0; a < D; ++a) {
    const double along = y[a] - x[a];
    const double low = box.from[a] - x[a], high = box.to[a] - x[a];
    const double margin = place_rounding * (high - low < infinity ? high - low : 0.0);
    if (along == 0.0) {
      if (low >= -margin || high <= margin) return false;
      continue;
    }
    enters = std::max(enters, (along > 0.0 ? low : high) / along);
    leaves = std::min(leaves, (along > 0.0 ? high : low) / along);
  }
  return leaves - enters > place_rounding;
}

template <int D>
void remove_bonds_through(std::span<const Region<D>> cutouts, std::span<const Face> faces,
                          FaceSet mirrored, Family<D>& family) {
  if (cutouts.empty()) return;
  const std::vector<Region<D>> boxes = with_images<D>(cutouts, faces, mirrored);
  BondList<D> list;
  for (Index i = 0; i < family.point_count; ++i) {
    const Vector<D> x = vector_at(family.position, i);
    list.begin_point(i);
    for (const auto& [j, weight] : family.bonds(i)) {
      const Vector<D> y = vector_at(family.position, j);
      if (std::ranges::any_of(boxes, [&](const auto& box) { return passes_through<D>(box, x, y); }))
        continue;
      list.add(j, weight);
    }
    list.end_point();
  }
  list.give_to(family);
}

template std::vector<Region<2>> read_cutouts<2>(const Section&, const Vector<2>&, double);
template std::vector<Region<3>> read_cutouts<3>(const Section&, const Vector<3>&, double);
template void cut_out<2>(const Section&, const std::vector<Region<2>>&, Points<2>&);
template void cut_out<3>(const Section&, const std::vector<Region<3>>&, Points<3>&);
template bool passes_through<2>(const Region<2>&, const Vector<2>&, const Vector<2>&);
template bool passes_through<3>(const Region<3>&, const Vector<3>&, const Vector<3>&);
template void remove_bonds_through<2>(std::span<const Region<2>>, std::span<const Face>, FaceSet,
                                      Family<2>&);
template void remove_bonds_through<3>(std::span<const Region<3>>, std::span<const Face>, FaceSet,
                                      Family<3>&);

}  // namespace perifrac
