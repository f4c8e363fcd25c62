#include "core/geometry/family.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

template <int D>
double squared_distance(const Family<D>& family, Index i, Index j) {
  double r2 = 0.0;
  for (int a = 0; a < D; ++a) {
    const double d = family.position[a][j] - family.position[a][i];
    r2 += d * d;
  }
  return r2;
}

template <int D>
double radius(const Family<D>& family, Index i) {
  double r2 = 0.0;
  for (int a = 0; a < D; ++a) r2 += family.position[a][i] * family.position[a][i];
  return std::sqrt(r2);
}

/// Mirrors every node, ghosts of earlier faces included, that lies within the horizon of a face:
/// edges and corners come out right, each image once.
template <int D>
void add_ghosts(Family<D>& family, const Face& face, int number, double horizon,
                const std::vector<bool>& bondless) {
  const Index nodes = family.node_count();
  for (Index i = 0; i < nodes; ++i) {
    const double place = face.curved() ? radius(family, i) : family.position[face.axis][i];
    const double depth = face.direction * (face.coordinate - place);
    if (depth > horizon || depth < 0.0) continue;
    if (i < family.point_count && bondless[i]) continue;
    const double image = 2.0 * face.coordinate - place;
    const double stretch = face.curved() ? image / place : 1.0;
    for (int a = 0; a < D; ++a) {
      const double x = family.position[a][i];
      family.position[a].push_back(a == face.axis ? image : x * stretch);
    }
    family.volume.push_back(family.volume[i] * std::pow(stretch, D - 1));
    const bool real = i < family.point_count;
    const Index ghost = i - family.point_count;
    family.ghost_source.push_back(real ? i : family.ghost_source[ghost]);
    family.ghost_faces.push_back((real ? 0u : family.ghost_faces[ghost]) | face_bit(number));
    family.ghost_axes.push_back((real ? 0u : family.ghost_axes[ghost]) ^
                                (face.curved() ? 0u : 1u << face.axis));
    family.curved = family.curved || face.curved();
  }
}

/// Uniform cells as wide as the horizon; nodes of a cell are consecutive in `node`.
template <int D>
struct CellGrid {
  Vector<D> low;
  std::array<Index, D> cells;
  double width;
  std::vector<Index> first;
  std::vector<Index> node;

  CellGrid(const Family<D>& family, double horizon) : width(horizon) {
    std::size_t total = 1;
    for (int a = 0; a < D; ++a) {
      const auto [min, max] = std::ranges::minmax_element(family.position[a]);
      low[a] = *min;
      cells[a] = static_cast<Index>((*max - *min) / width) + 1;
      total *= cells[a];
    }
    first.assign(total + 1, 0);
    for (Index i = 0; i < family.node_count(); ++i) ++first[cell_of(family, i) + 1];
    for (std::size_t c = 0; c < total; ++c) first[c + 1] += first[c];
    node.resize(family.node_count());
    std::vector<Index> next(first.begin(), first.end() - 1);
    for (Index i = 0; i < family.node_count(); ++i) node[next[cell_of(family, i)]++] = i;
  }

  std::array<Index, D> place(const Family<D>& family, Index i) const {
    std::array<Index, D> c;
    for (int a = 0; a < D; ++a) {
      c[a] = static_cast<Index>((family.position[a][i] - low[a]) / width);
    }
    return c;
  }

  std::size_t cell_of(const Family<D>& family, Index i) const { return flat(place(family, i)); }

  std::size_t flat(const std::array<Index, D>& c) const {
    std::size_t index = c[D - 1];
    for (int a = D - 2; a >= 0; --a) index = index * cells[a] + c[a];
    return index;
  }

  template <class Use>
  void for_nodes_near(const Family<D>& family, Index i, Use&& use) const {
    const std::array<Index, D> centre = place(family, i);
    const int boxes = D == 2 ? 9 : 27;
    for (int box = 0; box < boxes; ++box) {
      std::array<Index, D> c = centre;
      bool inside = true;
      for (int a = 0, rest = box; a < D; ++a, rest /= 3) {
        c[a] += rest % 3 - 1;
        inside = inside && c[a] >= 0 && c[a] < cells[a];
      }
      if (!inside) continue;
      const std::size_t cell = flat(c);
      for (Index k = first[cell]; k < first[cell + 1]; ++k) use(node[k]);
    }
  }
};

}  // namespace

template <int D>
std::size_t Family<D>::bytes() const {
  return sizeof(double) * (D + 1) * volume.size() + sizeof(Index) * ghost_source.size() +
         (sizeof(FaceSet) + 1) * ghost_faces.size() +
         sizeof(Index) * (offset.size() + other.size()) + sizeof(double) * weight.size();
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
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (contains(mirrored, f)) add_ghosts(family, faces[f], static_cast<int>(f), reach, bondless);
  }

  const CellGrid<D> grid(family, reach);
  const auto bonds_of = [&](Index i, std::vector<Index>& found) {
    found.clear();
    if (bondless[i]) return;
    grid.for_nodes_near(family, i, [&](Index j) {
      if (j < family.point_count && bondless[j]) return;
      if (j != i && squared_distance(family, i, j) <= reach * reach) found.push_back(j);
    });
    std::ranges::sort(found);
  };
  family.offset.assign(points.size() + 1, 0);
#pragma omp parallel
  {
    std::vector<Index> found;
#pragma omp for schedule(static)
    for (Index i = 0; i < points.size(); ++i) {
      bonds_of(i, found);
      family.offset[i + 1] = static_cast<Index>(found.size());
    }
  }
  for (Index i = 0; i < points.size(); ++i) family.offset[i + 1] += family.offset[i];
  family.other.resize(family.offset.back());
  family.weight.resize(family.offset.back());
#pragma omp parallel
  {
    std::vector<Index> found;
#pragma omp for schedule(static)
    for (Index i = 0; i < points.size(); ++i) {
      bonds_of(i, found);
      for (std::size_t k = 0; k < found.size(); ++k) {
        const Index bond = family.offset[i] + static_cast<Index>(k);
        const double r = std::sqrt(squared_distance(family, i, found[k]));
        family.other[bond] = found[k];
        family.weight[bond] = influence(influence_function, r, horizon) * family.volume[found[k]];
      }
    }
  }
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
    for (int a = 0; a < D; ++a) part.position[a].push_back(family.position[a][node]);
    part.volume.push_back(family.volume[node]);
    if (ghost < 0) continue;
    part.ghost_source.push_back(family.ghost_source[ghost]);
    part.ghost_faces.push_back(family.ghost_faces[ghost]);
    part.ghost_axes.push_back(family.ghost_axes[ghost]);
  }
  part.curved = family.curved;
  part.offset.push_back(0);
  for (Index i = 0; i < family.point_count; ++i) {
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      if (number[family.other[bond]] < 0) continue;
      part.other.push_back(number[family.other[bond]]);
      part.weight.push_back(family.weight[bond]);
    }
    part.offset.push_back(static_cast<Index>(part.other.size()));
  }
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
