#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/body/body.hpp"

namespace perifrac {

/// The same piece of space with points twice as far apart: one for the points of every cell of
/// 2^D lattice cells, at their centre and with their volume. Where a side holds an odd number of
/// points the last cell is half a cell. Of an irregular body cells are as wide, and the points
/// that stand for them lie in their middle, on a lattice.
template <int D>
struct CoarseBody {
  std::shared_ptr<const Body<D>> body;
  std::vector<Index> coarse_of;               ///< by point of the finer body
  std::vector<std::array<Index, D>> cell_of;  ///< by coarse point, counted from `corner`
  std::array<Index, D> cells;                 ///< along each axis
  Vector<D> corner;                           ///< [m]
  double size;                                ///< of a cell [m]

  /// The cell of a place.
  std::array<Index, D> cell_at(const Vector<D>& x) const;
};

/// Of a body whose low corner is `corner`: the finest body's. It sees as far, but for
/// no more than four of its spacings.
template <int D>
CoarseBody<D> coarsen(const Body<D>& fine, const Vector<D>& corner);

/// Where the lattice of a body begins, half a spacing before its first points; of an irregular one,
/// where its faces are.
template <int D>
Vector<D> low_corner(const Body<D>& body);

}  // namespace perifrac
