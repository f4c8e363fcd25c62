#include "app/run/frame_geometry.hpp"

#include <algorithm>

namespace perifrac {

namespace {

/// One for all where points are a lattice.
template <int D>
std::vector<double> volumes_of(const Points<D>& points) {
  const auto& volume = points.volume;
  if (volume.empty() || std::ranges::any_of(volume, [&](double v) { return v != volume[0]; })) {
    return {volume.begin(), volume.end()};
  }
  return {volume[0]};
}

/// Of every point the first that it lies in.
template <int D>
void find_regions(const Body<D>& body, FrameGeometry& geometry) {
  const auto& regions = body.regions();
  if (regions.empty()) return;
  for (const Region<D>& region : regions) geometry.regions.push_back(region.name);
  for (Index i = 0; i < body.points().size(); ++i) {
    const Vector<D> x = body.points().at(i);
    const auto in = std::ranges::find_if(regions, [&](const auto& r) { return r.contains(x); });
    const auto place = in == regions.end() ? 0 : in - regions.begin() + 1;
    geometry.region.push_back(static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(place, 255)));
  }
}

template <int D>
FrameGeometry geometry_of(const Body<D>& body, const std::string& set) {
  FrameGeometry geometry;
  if (set == body.point_set().name) {
    geometry.volume = volumes_of(body.points());
    find_regions(body, geometry);
  } else if (set == body.bond_state().facet_points().name) {
    geometry.corners_a_facet = std::tuple_size_v<CrackFacet<D>>;
    for (const CrackFacet<D>& facet : body.bond_state().facets()) {
      for (const Vector<D>& corner : facet) {
        for (int a = 0; a < 3; ++a) geometry.corners.push_back(a < D ? corner[a] : 0.0);
      }
    }
  }
  return geometry;
}

}  // namespace

FrameGeometry frame_geometry(const AnyBody& body, const PointSet& points) {
  return std::visit(
      [&](const auto& any) { return any ? geometry_of(*any, points.name) : FrameGeometry{}; },
      body);
}

}  // namespace perifrac
