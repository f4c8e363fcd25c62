#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/bonds/family.hpp"

namespace perifrac {

/// Which bonds are worth a look, where those are sought that are stretched beyond a limit: a block
/// of neighbouring points is left alone until its points, and those that they are bonded to, have
/// moved so far against each other that one of its bonds might have come to the limit. So a body
/// that is strained in a small part is looked at in that part, and nothing is missed.
///
/// The way is added up from call to call, whatever lies between: a restored state too.
template <int D>
class StretchBudget {
 public:
  static constexpr Index block_size = D == 2 ? 32 : 64;

  explicit StretchBudget(const Family<D>& family);

  /// Every block is to be looked at: bonds may be there that were not.
  void forget();
  /// Takes displacements, D blocks [m]; blocks to be looked at, ascending. Valid until the next
  /// call.
  std::span<const Index> due(std::span<const double> u);
  /// None of the block's bonds comes to the limit before points have moved against each other by
  /// `left` [m].
  void set_left(Index block, double left) { left_[block] = left - rounding_; }

  /// Of point i to real points, which come first.
  Index real_bonds(Index i) const { return real_bonds_[i]; }
  /// Of a block.
  std::span<const Index> points(Index block) const {
    const Index begin = block * block_size;
    return std::span(order_).subspan(begin, std::min(points_ - begin, block_size));
  }
  /// A length that sums of displacements are exact to [m].
  double rounding() const { return rounding_; }

 private:
  struct Box {
    std::array<double, D> low, high;
  };

  Index blocks() const { return static_cast<Index>(left_.size()); }
  Box motion_of(Index block, std::span<const double> u);
  double farthest_apart(Index block) const;
  void watch_rounding(std::span<const double> u);

  Index points_;
  double rounding_ = 0.0;
  std::vector<Index> real_bonds_;         ///< by point
  std::vector<Index> first_near_, near_;  ///< by block: those that its bonds lead to, itself too
  std::vector<Index> order_;              ///< points, block by block
  std::vector<double> last_;              ///< displacements of the last call, in that order [m]
  std::vector<Box> motion_;               ///< by block, since then [m]
  double largest_ = 0.0;                  ///< bound of any component of a displacement [m]
  std::vector<double> left_;              ///< by block [m]; negative: to be looked at
  std::vector<Index> due_;
};

}  // namespace perifrac
