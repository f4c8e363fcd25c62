#include "modules/fluid/walls/body_wall.hpp"

#include <cmath>

#include "core/base/small_vector.hpp"
#include "core/geometry/cell_grid.hpp"
#include "modules/fluid/walls/wall_surface.hpp"

namespace perifrac {

namespace {

/// A point of the body and a face that it lies near.
template <int D>
struct NearFace {
  Index point;
  WallSurface<D> surface;
};

/// The wall of a cut-out that a point lies behind, if not deeper than `reach` [m]: of the axis
/// along which the point is farthest outside.
template <int D>
void append_walls_near(const Region<D>& box, const Body<D>& body, Index point, double reach,
                       std::vector<NearFace<D>>& result) {
  const Vector<D> x = body.points().at(point);
  DeepestSurface<D> deepest(depth_rounding * body.spacing());
  for (int a = 0; a < D; ++a) {
    const double below = box.from[a] - x[a], above = x[a] - box.to[a];
    if (below > 0.0) deepest.offer({unit_vector<D>(a, +1), below});
    if (above > 0.0) deepest.offer({unit_vector<D>(a, -1), above});
  }
  if (deepest.surface().depth <= reach) result.push_back({point, deepest.surface()});
}

/// All pairs not farther apart than `reach` [m], but for faces where space goes on by its period.
template <int D>
std::vector<NearFace<D>> faces_near_points(const Body<D>& body, const Period<D>& period,
                                           double reach) {
  std::vector<NearFace<D>> result;
  for (Index i = 0; i < body.points().size(); ++i) {
    const Vector<D> x = body.points().at(i);
    for (const Face& face : body.faces()) {
      if (!face.curved() && period.ends[face.axis]) continue;
      const WallSurface<D> near{.normal = face.normal(x), .depth = face.depth(x)};
      if (near.depth <= reach) result.push_back({i, near});
    }
    for (const Region<D>& box : body.cutouts()) append_walls_near(box, body, i, reach, result);
  }
  return result;
}

}  // namespace

template <int D>
void leave_room_for_body(const Body<D>& body, double spacing, WallCloud<D>& cloud) {
  CellGrid<D> grid;
  grid.build(positions_of(body.points().position), body.spacing() + spacing);
  Neighbours near;
  const double reach = 0.5 * (body.spacing() + spacing) * (1.0 - 1e-9);
  grid.find(positions_of(cloud.position), reach, near);
  cloud.remove_if([&](Index w) { return near.offset[w] < near.offset[w + 1]; });
}

template <int D>
void add_body(const Body<D>& body, bool slips, double spacing, double horizon,
              const Period<D>& period, WallCloud<D>& cloud) {
  const std::vector<NearFace<D>> faces = faces_near_points(body, period, horizon);
  std::array<std::vector<double>, D> beyond;
  for (const NearFace<D>& face : faces) {
    append(beyond, body.points().at(face.point) +
                       (face.surface.depth + 0.5 * spacing) * face.surface.normal);
  }
  CellGrid<D> grid;
  grid.build(positions_of(cloud.position), spacing);
  Neighbours rigid;
  grid.find(positions_of(beyond), 0.75 * spacing, rigid);
  const auto covered = [&](std::size_t k) { return rigid.offset[k] < rigid.offset[k + 1]; };
  for (std::size_t k = 0; k < faces.size();) {
    NearestSurface<D> bare(depth_rounding * spacing), nearest(depth_rounding * spacing);
    const Index point = faces[k].point;
    for (; k < faces.size() && faces[k].point == point; ++k) {
      (covered(k) ? nearest : bare).offer(faces[k].surface);
    }
    const auto [normal, depth] = (bare.found() ? bare : nearest).surface();
    cloud.add(body.points().at(point), normal, depth, body.points().volume[point], slips, point);
  }
}

template void leave_room_for_body<2>(const Body<2>&, double, WallCloud<2>&);
template void leave_room_for_body<3>(const Body<3>&, double, WallCloud<3>&);
template void add_body<2>(const Body<2>&, bool, double, double, const Period<2>&, WallCloud<2>&);
template void add_body<3>(const Body<3>&, bool, double, double, const Period<3>&, WallCloud<3>&);

}  // namespace perifrac
