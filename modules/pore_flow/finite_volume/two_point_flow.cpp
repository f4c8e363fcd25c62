#include "modules/pore_flow/finite_volume/two_point_flow.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/for_each_point.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

/// Of two halves in a row.
double in_series(double one, double other) {
  return one > 0.0 && other > 0.0 ? one * other / (one + other) : 0.0;
}

}  // namespace

template <int D>
TwoPointFlow<D>::TwoPointFlow(std::shared_ptr<const Body<D>> body, const CellFaces<D>& walls,
                              const OuterWalls<D>& outer, Law law)
    : body_(std::move(body)),
      law_(std::move(law)),
      face_values_(outer.pressures.face_value_count()) {
  add_walls(walls, outer.held);
  add_outlets(walls, outer);
  find_transmissibility();
}

template <int D>
double TwoPointFlow<D>::half_conductance(Index cell, const Vector<D>& normal, double area,
                                         double length) const {
  return area * dot(normal, law_.at(cell).stress(normal)) / length;
}

template <int D>
void TwoPointFlow<D>::add_walls(const CellFaces<D>& walls, const std::vector<HeldPoint>& held) {
  enum Kind : std::uint8_t { free, holds_pressure, dry };
  std::vector<Kind> kind(point_count(), free);
  for (const auto& [point, face_value] : held) kind[point] = face_value < 0 ? dry : holds_pressure;
  const auto conducts = [&](const auto& wall) {
    const Kind one = kind[wall.i], other = kind[wall.j];
    return one != dry && other != dry && (one == free || other == free);
  };
  offset_.assign(point_count() + 1, 0);
  for (const auto& wall : walls.inner) {
    if (!conducts(wall)) continue;
    ++offset_[wall.i + 1];
    ++offset_[wall.j + 1];
  }
  for (Index i = 0; i < point_count(); ++i) offset_[i + 1] += offset_[i];
  const std::size_t sides = offset_.back();
  for (auto* values : {&area_, &own_, &beyond_, &transmissibility_}) values->resize(sides);
  other_.resize(sides);
  open_.assign(sides, 1);
  std::vector<Index> next(offset_.begin(), offset_.end() - 1);
  for (const auto& wall : walls.inner) {
    if (!conducts(wall)) continue;
    const Vector<D> normal = (1.0 / wall.distance) * (place(wall.j) - place(wall.i));
    const double of_i = half_conductance(wall.i, normal, wall.area, 0.5 * wall.distance);
    const double of_j = half_conductance(wall.j, normal, wall.area, 0.5 * wall.distance);
    const auto add = [&](Index from, Index to, double own, double beyond) {
      const Index side = next[from]++;
      other_[side] = to;
      area_[side] = wall.area;
      own_[side] = own;
      beyond_[side] = beyond;
    };
    add(wall.i, wall.j, of_i, of_j);
    add(wall.j, wall.i, of_j, of_i);
    if (wall.distance > body_->horizon() * (1.0 - 1e-6)) far_.emplace_back(wall.i, wall.j);
  }
}

template <int D>
void TwoPointFlow<D>::add_outlets(const CellFaces<D>& walls, const OuterWalls<D>& outer) {
  for (const auto& [cell, face, area, distance] : walls.outer) {
    const int face_value = outer.pressures.face_value(face, 0);
    if (face_value < 0 && !contains(outer.sealed, face)) continue;
    Vector<D> normal{};
    normal[body_->faces()[face].axis] = body_->faces()[face].direction;
    const double conductance =
        face_value < 0 ? 0.0 : half_conductance(cell, normal, area, distance);
    outlets_.push_back({cell, face, face_value, area, conductance, conductance});
  }
}

template <int D>
void TwoPointFlow<D>::scale_mobility(std::span<const double> factor) {
  factor_.assign(factor.begin(), factor.end());
  find_transmissibility();
}

template <int D>
void TwoPointFlow<D>::follow(const BondState<D>& bonds) {
  std::ranges::fill(open_, std::uint8_t{1});
  for (const BrokenBond& bond : bonds.broken()) cut(bond.i, bond.j);
  for (const auto& pair : far_) {
    const Index i = pair.first, j = pair.second;
    const bool through = std::ranges::any_of(bonds.facets(), [&](const CrackFacet<D>& facet) {
      return is_cut<D>(facet, place(i), place(j));
    });
    if (through) cut(i, j);
  }
  find_transmissibility();
}

template <int D>
void TwoPointFlow<D>::cut(Index i, Index j) {
  for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
    for (Index side = offset_[from]; side < offset_[from + 1]; ++side) {
      if (other_[side] == to) open_[side] = 0;
    }
  }
}

template <int D>
void TwoPointFlow<D>::find_transmissibility() {
  const auto factor = [&](Index i) { return factor_.empty() ? 1.0 : factor_[i]; };
  for_each_point(point_count(), [&](Index i) {
    for (Index side = offset_[i]; side < offset_[i + 1]; ++side) {
      const double open = open_[side];
      transmissibility_[side] =
          open * in_series(factor(i) * own_[side], factor(other_[side]) * beyond_[side]);
    }
  });
  for (Outlet& outlet : outlets_) {
    outlet.transmissibility = factor(outlet.cell) * outlet.conductance;
  }
}

template <int D>
void TwoPointFlow<D>::apply(std::span<const double> p, std::span<double> outflow) {
  const Index points = point_count();
  const Index* const other = other_.data();
  const double* const transmissibility = transmissibility_.data();
  for_each_point(points, [&](Index i) {
    double sum = 0.0;
    for (Index side = offset_[i]; side < offset_[i + 1]; ++side) {
      sum += transmissibility[side] * (p[i] - p[other[side]]);
    }
    outflow[i] = sum;
  });
  std::ranges::fill(outflow.subspan(points), 0.0);
  for (const Outlet& outlet : outlets_) {
    if (outlet.face_value < 0) continue;
    const double inflow =
        outlet.transmissibility * (p[points + outlet.face_value] - p[outlet.cell]);
    outflow[outlet.cell] -= inflow;
    outflow[points + outlet.face_value] += inflow;
  }
}

template <int D>
void TwoPointFlow<D>::velocity(std::span<const double> p, std::span<double> velocity) {
  using Matrix = Eigen::Matrix<double, D, D>;
  using Column = Eigen::Matrix<double, D, 1>;
  // Least squares of what passes every wall, weighed by area: sum A n n^T v = sum n J.
  struct Fit {
    Matrix normals = Matrix::Zero();
    Column fluxes = Column::Zero();
  };
  const Index points = point_count();
  std::vector<Fit> fits(points);
  for_each_point(points, [&](Index i) {
    for (Index side = offset_[i]; side < offset_[i + 1]; ++side) {
      if (open_[side] == 0) continue;
      const Vector<D> along = place(other_[side]) - place(i);
      const Vector<D> unit = (1.0 / norm(along)) * along;
      const Eigen::Map<const Column> normal(unit.data());
      fits[i].normals += area_[side] * normal * normal.transpose();
      fits[i].fluxes += transmissibility_[side] * (p[i] - p[other_[side]]) * normal;
    }
  });
  for (const Outlet& outlet : outlets_) {
    const Face& face = body_->faces()[outlet.face];
    fits[outlet.cell].normals(face.axis, face.axis) += outlet.area;
    if (outlet.face_value < 0) continue;
    fits[outlet.cell].fluxes[face.axis] +=
        face.direction * outlet.transmissibility * (p[outlet.cell] - p[points + outlet.face_value]);
  }
  for_each_point(points, [&](Index i) {
    // A cell that is cut off along some direction has no velocity there.
    const SpectrumOf<D> axes = symmetric_spectrum(fits[i].normals);
    Column v = Column::Zero();
    for (int k = 0; k < D; ++k) {
      const Column axis = axes.vectors.col(k);
      const double seen = axes.values[k];
      if (seen > 1e-9 * axes.values[D - 1]) v += axis.dot(fits[i].fluxes) / seen * axis;
    }
    for (int a = 0; a < D; ++a) velocity[a * points + i] = v[a];
  });
}

template <int D>
std::string TwoPointFlow<D>::path() const {
  return fmt::format("cell by cell: {} walls between them, {} on faces", other_.size() / 2,
                     outlets_.size());
}

template <int D>
Eigen::SparseMatrix<double> TwoPointFlow<D>::assemble() const {
  const Index points = point_count();
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < points; ++i) {
    entries.emplace_back(i, i, 0.0);  // a cell without walls, within a layer, stores all the same
    for (Index side = offset_[i]; side < offset_[i + 1]; ++side) {
      entries.emplace_back(i, i, transmissibility_[side]);
      entries.emplace_back(i, other_[side], -transmissibility_[side]);
    }
  }
  for (const Outlet& outlet : outlets_) {
    if (outlet.face_value < 0) continue;
    const Index row = points + outlet.face_value;
    const double through = outlet.transmissibility;
    entries.emplace_back(outlet.cell, outlet.cell, through);
    entries.emplace_back(row, row, through);
    entries.emplace_back(outlet.cell, row, -through);
    entries.emplace_back(row, outlet.cell, -through);
  }
  Eigen::SparseMatrix<double> matrix(size(), size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template class TwoPointFlow<2>;
template class TwoPointFlow<3>;

}  // namespace perifrac
