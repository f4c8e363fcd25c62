#include "core/bonds/family.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_list.hpp"
#include "core/geometry/cell_grid.hpp"

namespace perifrac {

namespace {

constexpr Index points_at_once = 1 << 14;  // whose bonds are found before they are packed

template <int D>
double squared_distance(const Family<D>& family, Index i, Index j) {
  return squared_norm(vector_at(family.position, j) - vector_at(family.position, i));
}

/// Of the image's distance from the centre of a curved face to that of what it is of.
template <int D>
double stretch(const Face& face, const Vector<D>& x) {
  return (2.0 * face.coordinate - face.place(x)) / face.place(x);
}

/// Behind the face as far as x is before it; at a curved one on the same ray.
template <int D>
Vector<D> image(const Face& face, Vector<D> x) {
  if (!face.curved()) {
    x[face.axis] = 2.0 * face.coordinate - x[face.axis];
    return x;
  }
  const Vector<D> ray = face.ray_to(x);
  const double factor = stretch<D>(face, x);
  for (int a = 0; a < D; ++a) {
    if (a != face.along) x[a] = face.centre[a] + ray[a] * factor;
  }
  return x;
}

/// Of the image's volume to that of what it is of.
template <int D>
double growth(const Face& face, const Vector<D>& x) {
  return face.curved() ? std::pow(stretch<D>(face, x), face.along < 0 ? D - 1 : D - 2) : 1.0;
}

/// Mirrors every node, ghosts of earlier faces included, that lies within the horizon of a face:
/// edges and corners come out right, each image once.
template <int D>
void add_ghosts(Family<D>& family, const Face& face, int number, double horizon,
                const std::vector<bool>& bondless) {
  const Index nodes = family.node_count();
  for (Index i = 0; i < nodes; ++i) {
    const Vector<D> x = vector_at(family.position, i);
    const double depth = face.depth(x);
    if (depth > horizon || depth < 0.0) continue;
    if (i < family.point_count && bondless[i]) continue;
    append(family.position, image<D>(face, x));
    family.volume.push_back(family.volume[i] * growth<D>(face, x));
    const bool real = i < family.point_count;
    const Index ghost = i - family.point_count;
    family.ghost_source.push_back(real ? i : family.ghost_source[ghost]);
    family.ghost_faces.push_back((real ? 0u : family.ghost_faces[ghost]) | face_bit(number));
    const unsigned axes = real ? 0u : family.ghost_axes[ghost];
    family.ghost_axes.push_back(
        static_cast<std::uint8_t>(axes ^ (face.curved() ? 0u : 1u << face.axis)));
    family.curved = family.curved || face.curved();
  }
}

}  // namespace

template <int D>
std::size_t Family<D>::bytes() const {
  return sizeof(double) * (D + 1) * volume.size() + sizeof(Index) * ghost_source.size() +
         (sizeof(FaceSet) + 1) * ghost_faces.size() + steps.bytes() + weight.bytes();
}

template <int D>
Family<D> build_family(const Points<D>& points, std::span<const Face> faces, FaceSet mirrored,
                       double horizon, InfluenceFunction influence_function,
                       std::vector<bool> bondless) {
  bondless.resize(points.size(), false);
  // A lattice distance that equals the horizon must not depend on rounding.
  const double reach = horizon * (1.0 + 1e-9);
  Family<D> family;
  family.point_count = points.size();
  family.position = points.position;
  family.volume = points.volume;
  for (int f = 0; f < std::ssize(faces); ++f) {
    if (contains(mirrored, f)) add_ghosts(family, faces[f], f, reach, bondless);
  }

  CellGrid<D> grid;
  grid.build(positions_of(family.position), reach);
  const auto is_bondless = [&](Index i) { return i < points.size() && bondless[i]; };
  Neighbours near;
  std::vector<double> weight;
  BondList<D> list;
  for (Index first = 0; first < points.size(); first += points_at_once) {
    const Index count = std::min(points_at_once, points.size() - first);
    grid.find_others(first, first + count, reach, near);
    weight.resize(near.other.size());
    for_each_point(count, [&](Index k) {
      for (Index n = near.offset[k]; n < near.offset[k + 1]; ++n) {
        const Index j = near.other[n];
        const double r = std::sqrt(squared_distance(family, first + k, j));
        weight[n] = influence(influence_function, r, horizon) * family.volume[j];
      }
    });
    for (Index k = 0; k < count; ++k) {
      list.begin_point(first + k);
      for (Index n = near.offset[k]; n < near.offset[k + 1] && !bondless[first + k]; ++n) {
        if (!is_bondless(near.other[n])) list.add(near.other[n], weight[n]);
      }
      list.end_point();
    }
  }
  list.give_to(family);
  return family;
}

template <int D>
Family<D> without_other_ghosts(const Family<D>& family, FaceSet mirrored) {
  Family<D> part;
  part.point_count = family.point_count;
  std::vector<Index> number(family.node_count(), -1);  // of a node in the part, -1 if it goes
  for (Index node = 0; node < family.node_count(); ++node) {
    const Index ghost = node - family.point_count;
    if (ghost >= 0 && (family.ghost_faces[ghost] & ~mirrored) != 0) continue;
    number[node] = static_cast<Index>(part.volume.size());
    append(part.position, vector_at(family.position, node));
    part.volume.push_back(family.volume[node]);
    if (ghost < 0) continue;
    part.ghost_source.push_back(family.ghost_source[ghost]);
    part.ghost_faces.push_back(family.ghost_faces[ghost]);
    part.ghost_axes.push_back(family.ghost_axes[ghost]);
  }
  part.curved = family.curved;
  BondList<D> list;
  for (Index i = 0; i < family.point_count; ++i) {
    list.begin_point(i);
    for (const auto& [j, weight] : family.bonds(i)) {
      if (number[j] >= 0) list.add(number[j], weight);
    }
    list.end_point();
  }
  list.give_to(part);
  return part;
}

template struct Family<2>;
template struct Family<3>;
template Family<2> build_family<2>(const Points<2>&, std::span<const Face>, FaceSet, double,
                                   InfluenceFunction, std::vector<bool>);
template Family<3> build_family<3>(const Points<3>&, std::span<const Face>, FaceSet, double,
                                   InfluenceFunction, std::vector<bool>);
template Family<2> without_other_ghosts<2>(const Family<2>&, FaceSet);
template Family<3> without_other_ghosts<3>(const Family<3>&, FaceSet);

}  // namespace perifrac
