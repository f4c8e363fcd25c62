#include "core/body/coarse_body.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

/// Of a coarse body, in its spacings: what wider horizons add is smooth, and of no use to a
/// correction that is worth their cost.
constexpr double most_horizon_ratio = 4.0;

/// The low and the high corner of the box that the faces span.
template <int D>
std::pair<Vector<D>, Vector<D>> extent(const Body<D>& body) {
  std::pair<Vector<D>, Vector<D>> corners{};
  for (const Face& face : body.faces()) {
    if (face.is_hole()) continue;
    if (face.curved()) {
      corners.second.fill(face.coordinate);
      if (body.faces().size() == 1) corners.first.fill(-face.coordinate);
    } else {
      (face.direction < 0 ? corners.first : corners.second)[face.axis] = face.coordinate;
    }
  }
  return corners;
}

/// Coarse points of an irregular body make a lattice, each in the middle of its cell's part of the
/// body: cells lose points to their neighbours, and with them their centre.
template <int D>
void put_on_lattice(CoarseBody<D>& coarse, Points<D>& points, const Vector<D>& high) {
  for (Index i = 0; i < points.size(); ++i) {
    for (int a = 0; a < D; ++a) {
      const double from = coarse.corner[a] + coarse.cell_of[i][a] * coarse.size;
      points.position[a][i] = 0.5 * (from + std::min(from + coarse.size, high[a]));
    }
  }
}

}  // namespace

template <int D>
Vector<D> low_corner(const Body<D>& body) {
  if (body.irregular()) return extent(body).first;
  Vector<D> corner;
  for (int a = 0; a < D; ++a) {
    corner[a] = std::ranges::min(body.points().position[a]) - 0.5 * body.spacing();
  }
  return corner;
}

template <int D>
std::array<Index, D> CoarseBody<D>::cell_at(const Vector<D>& x) const {
  std::array<Index, D> cell;
  for (int a = 0; a < D; ++a) {
    cell[a] = static_cast<Index>(std::floor((x[a] - corner[a]) / size));
  }
  return cell;
}

template <int D>
CoarseBody<D> coarsen(const Body<D>& fine, const Vector<D>& corner) {
  const Points<D>& from = fine.points();
  CoarseBody<D> coarse{.body = {},
                       .coarse_of = std::vector<Index>(from.size()),
                       .cell_of = {},
                       .cells = {},
                       .corner = corner,
                       .size = 2.0 * fine.spacing()};
  for (int a = 0; a < D; ++a) {
    const double high = std::ranges::max(from.position[a]);
    coarse.cells[a] = 1 + static_cast<Index>(std::floor((high - corner[a]) / coarse.size));
  }
  std::size_t count = 1;
  for (int a = 0; a < D; ++a) count *= coarse.cells[a];
  std::vector<Index> point_in(count, -1);

  Points<D> points;
  for (Index i = 0; i < from.size(); ++i) {
    const Vector<D> x = from.at(i);
    const std::array<Index, D> cell = coarse.cell_at(x);
    std::size_t place = 0;
    for (int a = D - 1; a >= 0; --a) place = place * coarse.cells[a] + cell[a];
    Index& point = point_in[place];
    if (point < 0) {
      point = points.size();
      points.add({}, 0.0);
      coarse.cell_of.push_back(cell);
    }
    coarse.coarse_of[i] = point;
    points.volume[point] += from.volume[i];
    for (int a = 0; a < D; ++a) points.position[a][point] += from.volume[i] * x[a];
  }
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < points.size(); ++i) points.position[a][i] /= points.volume[i];
  }
  if (fine.irregular()) put_on_lattice<D>(coarse, points, extent(fine).second);
  const double horizon = std::min(2.0 * fine.horizon(), most_horizon_ratio * coarse.size);
  auto body = std::make_shared<Body<D>>(std::move(points), fine.faces(), coarse.size, horizon,
                                        fine.influence());
  body->set_cutouts(fine.cutouts());
  coarse.body = std::move(body);
  return coarse;
}

template struct CoarseBody<2>;
template struct CoarseBody<3>;
template CoarseBody<2> coarsen<2>(const Body<2>&, const Vector<2>&);
template CoarseBody<3> coarsen<3>(const Body<3>&, const Vector<3>&);
template Vector<2> low_corner<2>(const Body<2>&);
template Vector<3> low_corner<3>(const Body<3>&);

}  // namespace perifrac
