#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/index_blocks.hpp"
#include "core/geometry/neighbours.hpp"

namespace perifrac {

/// Coordinates of points [m], one span an axis.
template <int D>
using Positions = std::array<std::span<const double>, D>;

/// The first `count` of these points; all, if it is left out.
template <std::size_t D>
std::array<std::span<const double>, D> positions_of(
    const std::array<std::vector<double>, D>& position, std::size_t count = std::dynamic_extent) {
  std::array<std::span<const double>, D> result;
  for (std::size_t a = 0; a < D; ++a) result[a] = std::span(position[a]).subspan(0, count);
  return result;
}

/// Moving points sorted into cells, to find who is near whom.
///
/// The cells wrap around: their number follows from the number of points, and a point that flew
/// far away shares a cell with others instead of stretching the grid. A point whose position is
/// not finite is nobody's neighbour and has none. The result does not depend on the number of
/// threads; nothing is allocated when the sizes are those of the last time.
template <int D>
class CellGrid {
 public:
  /// Sorts the points into cells of the edge `cell` > 0 [m]. The positions are copied.
  void build(const Positions<D>& position, double cell);

  /// The points in the order of their cells, rows along the first axis: sorted so, points close in
  /// space are close in memory.
  std::span<const Index> order() const { return std::span(order_).first(place_.size()); }

  /// The grid's points nearer than `reach` <= cell [m] to each target.
  void find(const Positions<D>& targets, double reach, Neighbours& result);

  /// The same for the grid's own first `targets` points, themselves left out.
  void find_others(Index targets, double reach, Neighbours& result) {
    find_others(0, targets, reach, result);
  }
  /// The same for its points from `first` on, to before `last`; the first is target 0.
  void find_others(Index first, Index last, double reach, Neighbours& result);

 private:
  using Cell = std::array<std::int64_t, D>;

  Cell cell_of(const Vector<D>& x) const;
  std::int64_t wrapped(std::int64_t c, int axis) const;
  void choose_size(std::size_t points);
  void sort_into_cells(const Positions<D>& position);

  /// Runs of places in order(): first[r] .. last[r].
  struct Runs {
    static constexpr int most = D == 2 ? 9 : 27;
    int count = 0;
    std::array<Index, most> first, last;

    void add(Index from, Index to) {
      first[count] = from;
      last[count++] = to;
    }
  };

  /// All points nearer than a cell, and others.
  Runs runs_near(const Vector<D>& x) const;

  /// The points nearer than `reach`, the one at the place `self` left out; in blocks of `found`.
  std::span<Index> points_near(const Vector<D>& x, double reach, Index self,
                               IndexBlocks& found) const;

  /// `target(i)` gives the position of target i, `place_of_self(i)` the place of the point that is
  /// no neighbour of it.
  template <class Target, class Place>
  void search(Index targets, double reach, Target&& target, Place&& place_of_self,
              Neighbours& result);

  double inverse_width_ = 1.0;
  Cell low_{};                                 ///< of the cells with finite points
  Cell size_{};                                ///< cells along each axis before they wrap
  std::vector<Index> first_;                   ///< place in order() where each cell begins
  std::vector<Index> order_;                   ///< point at a place
  std::vector<Index> place_;                   ///< place of a point
  std::vector<Index> cell_;                    ///< cell of a point
  std::array<std::vector<double>, D> sorted_;  ///< [m], by place
  std::vector<IndexBlocks> found_;             ///< workspace of each thread
};

}  // namespace perifrac
