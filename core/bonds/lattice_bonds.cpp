#include "core/bonds/lattice_bonds.hpp"

#include <algorithm>
#include <cmath>

#include "core/bonds/bond_lengths.hpp"

namespace perifrac {

namespace {

constexpr double rounding = 1e-9;      // of a place on the lattice, in spacings
constexpr std::size_t most_bits = 63;  // of a signed word

/// Where nodes lie on a lattice: counted from a corner one horizon outside.
template <int D>
struct Grid {
  std::array<Index, D> counts;
  std::vector<std::array<Index, D>> place;  ///< by node

  /// Rows along the first axis.
  Index cell(const std::array<Index, D>& at) const {
    Index index = 0;
    for (int a = D - 1; a >= 0; --a) index = index * counts[a] + at[a];
    return index;
  }
};

template <int D>
std::optional<Grid<D>> find_grid(const Family<D>& family, double spacing) {
  Grid<D> grid;
  grid.place.resize(family.node_count());
  for (int a = 0; a < D; ++a) {
    const std::vector<double>& x = family.position[a];
    const double origin = x[0];
    Index least = 0, most = 0;
    for (Index i = 0; i < family.node_count(); ++i) {
      const double at = (x[i] - origin) / spacing;
      if (!(std::abs(at - std::round(at)) < rounding)) return {};
      grid.place[i][a] = static_cast<Index>(std::lround(at));
      least = std::min(least, grid.place[i][a]);
      most = std::max(most, grid.place[i][a]);
    }
    for (auto& place : grid.place) place[a] -= least;
    grid.counts[a] = most - least + 1;
  }
  return grid;
}

/// Of a bond of point i, in spacings.
template <int D>
std::array<Index, D> step_of(const Family<D>& family, const Grid<D>& grid, Index i, Index bond) {
  std::array<Index, D> step;
  for (int a = 0; a < D; ++a) step[a] = grid.place[family.other[bond]][a] - grid.place[i][a];
  return step;
}

/// Along any axis.
template <int D>
Index farthest_step(const Family<D>& family, const Grid<D>& grid) {
  Index reach = 0;
  for (Index i = 0; i < family.point_count; ++i) {
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      for (const Index step : step_of(family, grid, i, bond)) {
        reach = std::max(reach, std::abs(step));
      }
    }
  }
  return reach;
}

}  // namespace

template <int D>
std::optional<LatticeBonds<D>> LatticeBonds<D>::find(const Family<D>& family) {
  const double spacing = bond_lengths(family).shortest;
  if (family.curved || !std::isfinite(spacing)) return {};
  std::optional<Grid<D>> grid = find_grid(family, spacing);
  if (!grid) return {};

  // Rows are as far apart as bonds reach, so that a neighbour that is not there lies in no point's
  // cell; the cells before the first and after the last are there to be read.
  const Index reach = farthest_step(family, *grid);
  grid->counts[0] += reach;
  std::int64_t row = 1, before = packet_size, cells = 1;
  for (int a = 0; a < D; ++a) {
    before += reach * row;
    row *= grid->counts[a];
    cells *= grid->counts[a];
  }
  // A body that fills its box badly is better off without.
  if (cells > 2 * static_cast<std::int64_t>(family.node_count()) + 1000) return {};

  LatticeBonds result;
  if (!result.take_cells(family, *grid, cells, before)) return {};
  for (Index i = 0; i < family.point_count; ++i) {
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      if (family.weight[bond] == 0.0) continue;
      const auto step = step_of(family, *grid, i, bond);
      Vector<D> xi;
      for (int a = 0; a < D; ++a) xi[a] = static_cast<double>(step[a]);
      if (!result.take_bond(family, i, bond, xi, spacing)) return {};
    }
  }
  return result;
}

/// A cell for every node, `before` cells before the first; false where two share one.
template <int D>
template <class Grid>
bool LatticeBonds<D>::take_cells(const Family<D>& family, const Grid& grid, std::int64_t cells,
                                 std::int64_t before) {
  cell_count_ = static_cast<Index>(cells + 2 * before);
  present_.assign(cell_count_, 0);
  point_.assign(cell_count_, -1);
  std::vector<bool> taken(cell_count_, false);
  for (Index i = 0; i < family.node_count(); ++i) {
    const Index cell = static_cast<Index>(before) + grid.cell(grid.place[i]);
    if (taken[cell]) return false;
    taken[cell] = true;
    cell_of_.push_back(cell);
    if (i < family.point_count) point_[cell] = i;
  }
  const auto [first, last] = std::ranges::minmax(std::span(cell_of_).first(family.point_count));
  first_ = first;
  last_ = last;
  return true;
}

/// Notes that the bond is there; false where it is not as all others of its direction are, or there
/// are too many directions. `xi` is in spacings.
template <int D>
bool LatticeBonds<D>::take_bond(const Family<D>& family, Index i, Index bond, const Vector<D>& xi,
                                double spacing) {
  const double weight = family.weight[bond];
  const Index offset = cell_of_[family.other[bond]] - cell_of_[i];
  auto found = std::ranges::find(neighbours_, offset, &Neighbour::offset);
  if (found == neighbours_.end()) {
    Vector<D> weighted;
    for (int a = 0; a < D; ++a) weighted[a] = weight * xi[a] * spacing;
    neighbours_.push_back({offset, weight, weighted});
    found = std::prev(neighbours_.end());
    if (neighbours_.size() > most_bits) return false;
  }
  if (std::abs(weight - found->weight) > rounding * found->weight) return false;
  present_[cell_of_[i]] |= std::int64_t{1} << (found - neighbours_.begin());
  return true;
}

template <int D>
void LatticeBonds<D>::update(const Family<D>& family, std::span<const Index> points) {
  for (const Index i : points) {
    std::int64_t& present = present_[cell_of_[i]];
    present = 0;
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      if (family.weight[bond] == 0.0) continue;
      const Index offset = cell_of_[family.other[bond]] - cell_of_[i];
      const auto found = std::ranges::find(neighbours_, offset, &Neighbour::offset);
      present |= std::int64_t{1} << (found - neighbours_.begin());
    }
  }
}

template class LatticeBonds<2>;
template class LatticeBonds<3>;

}  // namespace perifrac
