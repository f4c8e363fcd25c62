#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include "core/base/points.hpp"
#include "core/bonds/family.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"

namespace perifrac {

/// Cracks have cut a piece free that nothing holds; what() describes it.
class PieceCutFree : public std::runtime_error {
 public:
  PieceCutFree(const std::string& what, std::size_t points)
      : std::runtime_error(what), points_(points) {}
  std::size_t points() const { return points_; }

 private:
  std::size_t points_;
};

/// Do bonds still lead from each end of these broken bonds to all others? Looks no farther than it
/// must: around a tip a few points.
template <int D>
bool are_joined(const Family<D>& family, std::span<const std::pair<Index, Index>> broken);

/// The pieces of a body, which no bond joins, that can move without energy, each by its points in
/// ascending order. Their rigid motions are asked, together with those of the body's plates;
/// `free_unknowns` takes what is solved for to all.
template <int D>
std::vector<std::vector<Index>> find_loose_pieces(BreakableElasticity<D>& elastic,
                                                  const Family<D>& family,
                                                  const Eigen::SparseMatrix<double>& free_unknowns);

/// `a piece of 12 points, from (0, 1) to (2, 3) m`.
template <int D>
std::string describe_piece(const Family<D>& family, std::span<const Index> piece);

}  // namespace perifrac
