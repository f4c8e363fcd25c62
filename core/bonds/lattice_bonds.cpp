#include "core/bonds/lattice_bonds.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/require.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_lengths.hpp"

namespace perifrac {

namespace {

constexpr double lattice_rounding = 1e-9;  // of a place on the lattice, in spacings; of a weight

/// Where nodes lie on a lattice: counted from a corner one horizon outside.
template <int D>
struct Grid {
  std::array<Index, D> counts;
  std::vector<std::array<Index, D>> place;  ///< by node
  Index reach = 0;                          ///< of bonds, along any axis

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
      if (!(std::abs(at - std::round(at)) < lattice_rounding)) return {};
      grid.place[i][a] = static_cast<Index>(std::lround(at));
      least = std::min(least, grid.place[i][a]);
      most = std::max(most, grid.place[i][a]);
    }
    for (auto& place : grid.place) place[a] -= least;
    grid.counts[a] = most - least + 1;
  }
  return grid;
}

/// Of a bond from i to j, in spacings.
template <int D>
std::array<Index, D> step_of(const Grid<D>& grid, Index i, Index j) {
  std::array<Index, D> step;
  for (int a = 0; a < D; ++a) step[a] = grid.place[j][a] - grid.place[i][a];
  return step;
}

/// Along any axis.
template <int D>
Index farthest_step(const Family<D>& family, const Grid<D>& grid) {
  Index reach = 0;
  for (Index i = 0; i < family.point_count; ++i) {
    for (const auto& bond : family.bonds(i)) {
      for (const Index step : step_of(grid, i, bond.other)) {
        reach = std::max(reach, std::abs(step));
      }
    }
  }
  return reach;
}

/// Steps of at most a reach along every axis, numbered row by row.
template <int D>
struct Steps {
  Index reach;

  std::size_t count() const { return number(filled(reach)) + 1; }
  std::size_t number(const std::array<Index, D>& step) const {
    std::size_t index = 0;
    for (int a = D - 1; a >= 0; --a) index = index * (2 * reach + 1) + (step[a] + reach);
    return index;
  }
  std::array<Index, D> step(std::size_t number) const {
    std::array<Index, D> step;
    for (int a = 0; a < D; ++a, number /= 2 * reach + 1) {
      step[a] = static_cast<Index>(number % (2 * reach + 1)) - reach;
    }
    return step;
  }

 private:
  static std::array<Index, D> filled(Index value) {
    std::array<Index, D> all;
    all.fill(value);
    return all;
  }
};

bool differ(double a, double b) { return std::abs(a - b) > lattice_rounding * b; }

/// The weight of the bonds of each step; 0: there are none. Nothing where some differ.
template <int D>
std::optional<std::vector<double>> find_weights(const Family<D>& family, const Grid<D>& grid) {
  const Steps<D> steps{grid.reach};
  std::vector<double> weights(steps.count(), 0.0);
  for (Index i = 0; i < family.point_count; ++i) {
    for (const auto& bond : family.bonds(i)) {
      if (bond.weight == 0.0) continue;
      double& weight = weights[steps.number(step_of(grid, i, bond.other))];
      if (weight == 0.0) weight = bond.weight;
      if (differ(bond.weight, weight)) return {};
    }
  }
  // Opposite directions lie in opposite places. A direction that bonds have to ghosts alone has no
  // opposite: then there is one that all points lack.
  for (std::size_t k = 0, last = weights.size() - 1; k < last - k; ++k) {
    double &a = weights[k], &b = weights[last - k];
    if (a == 0.0) a = b;
    if (b == 0.0) b = a;
    if (differ(a, b)) return {};
  }
  return weights;
}

}  // namespace

template <int D>
std::optional<LatticeBonds<D>> LatticeBonds<D>::find(const Family<D>& family, std::string* why) {
  const auto none = [&](const char* reason) -> std::optional<LatticeBonds> {
    if (why != nullptr) *why = reason;
    return {};
  };
  if (family.curved) return none("there are images at a curved face");
  const double spacing = bond_lengths(family).shortest;
  if (!std::isfinite(spacing)) return none("there are no bonds");
  std::optional<Grid<D>> grid = find_grid(family, spacing);
  if (!grid) return none("the points do not lie on a lattice");

  // Rows are as far apart as bonds reach, so that a neighbour that is not there lies in no point's
  // cell; the cells before the first and after the last are there to be read.
  grid->reach = farthest_step(family, *grid);
  grid->counts[0] += grid->reach;
  std::int64_t row = 1, before = packet_size, cells = 1;
  for (int a = 0; a < D; ++a) {
    before += grid->reach * row;
    row *= grid->counts[a];
    cells *= grid->counts[a];
  }
  if (cells > 4 * static_cast<std::int64_t>(family.node_count()) + 1000) {
    return none("the points fill less than a quarter of a box");
  }

  LatticeBonds result;
  if (!result.take_cells(family, *grid, cells, before)) return none("two points share a place");
  if (!result.take_neighbours(family, *grid, spacing)) {
    return none("bonds along one direction differ in weight");
  }
  result.find_packets();
  return result;
}

/// A cell for every node, `before` cells before the first; false where two share one.
template <int D>
template <class Grid>
bool LatticeBonds<D>::take_cells(const Family<D>& family, const Grid& grid, std::int64_t cells,
                                 std::int64_t before) {
  cell_count_ = static_cast<Index>(cells + 2 * before);
  point_.assign(cell_count_, -1);
  std::vector<bool> taken(cell_count_, false);
  cell_of_.reserve(family.node_count());
  for (Index i = 0; i < family.node_count(); ++i) {
    const Index cell = static_cast<Index>(before) + grid.cell(grid.place[i]);
    if (taken[cell]) return false;
    taken[cell] = true;
    cell_of_.push_back(cell);
    if (i < family.point_count) point_[cell] = i;
  }
  return true;
}

/// All directions of bonds, and which bonds there are; false where those of one direction differ.
template <int D>
template <class Grid>
bool LatticeBonds<D>::take_neighbours(const Family<D>& family, const Grid& grid, double spacing) {
  const Steps<D> steps{grid.reach};
  const auto weights = find_weights<D>(family, grid);
  if (!weights) return false;
  reach_ = grid.reach;
  spacing_ = spacing;
  number_.assign(weights->size(), -1);
  for (std::size_t k = 0; k < weights->size(); ++k) {
    const double weight = (*weights)[k];
    if (weight == 0.0) continue;
    const auto step = steps.step(k);
    Vector<D> xi;
    for (int a = 0; a < D; ++a) xi[a] = step[a] * spacing;
    number_[k] = neighbour_count();
    neighbours_.push_back({grid.cell(step), weight, weight * xi, xi / squared_norm(xi)});
  }
  all_.assign((neighbours_.size() + word_bits - 1) / word_bits, 0);
  for (std::size_t k = 0; k < neighbours_.size(); ++k) all_[k / word_bits] |= bit(k);
  present_.assign(all_.size() * cell_count_, 0);
  for_each_point(family.point_count, [&](Index i) {
    for (const auto& [j, weight] : family.bonds(i)) {
      if (weight == 0.0) continue;
      const Index k = number_[steps.number(step_of<D>(grid, i, j))];
      word_of(k, cell_of_[i]) |= bit(k);
    }
  });
  return true;
}

template <int D>
void LatticeBonds<D>::find_packets() {
  for (Index cell = 0; cell < cell_count_; ++cell) {
    if (point_[cell] < 0) continue;
    packets_.push_back(cell);
    cell += packet_size - 1;
  }
  const auto packets = static_cast<Index>(packets_.size());
  own_ = ranks::share(packets, packets * packet_size);
  if (!ranks::divides(packets * packet_size)) return;
  for (const Index k : ranks::bounds(packets)) {
    first_cells_.push_back(k < packets ? packets_[k] : packets_.back() + packet_size);
  }
}

template <int D>
void LatticeBonds<D>::gather_points(std::span<double> values, Index point_count) {
  if (first_cells_.empty()) return;
  require(std::ssize(values) % point_count == 0, "whole blocks of points");
  gathered_.resize(cell_count_);
  for (std::size_t begin = 0; begin < values.size(); begin += point_count) {
    double* const block = values.data() + begin;
    for_each_packet([&](Index c) { store(&gathered_[c], value_at(block, points(c))); });
    gather_cells(gathered_);
    for_each_point(point_count, [&](Index i) { block[i] = gathered_[cell_of_[i]]; });
  }
}

template <int D>
void LatticeBonds<D>::update(const Family<D>& family, std::span<const Index> points) {
  for (const Index i : points) {
    const Index cell = cell_of_[i];
    for (std::size_t word = 0; word < all_.size(); ++word) word_of(word * word_bits, cell) = 0;
    for (const auto& [j, weight] : family.bonds(i)) {
      if (weight == 0.0) continue;
      std::array<Index, D> step;
      for (int a = 0; a < D; ++a) {
        const std::vector<double>& x = family.position[a];
        step[a] = static_cast<Index>(std::lround((x[j] - x[i]) / spacing_));
      }
      const Index k = number_[Steps<D>{reach_}.number(step)];
      word_of(k, cell) |= bit(k);
    }
  }
}

template <int D>
std::string LatticeBonds<D>::path() const {
  return fmt::format("packets of {} points: a lattice, {} neighbours", packet_size,
                     neighbours_.size());
}

template class LatticeBonds<2>;
template class LatticeBonds<3>;

}  // namespace perifrac
