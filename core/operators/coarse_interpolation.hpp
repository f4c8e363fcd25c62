#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/body/coarse_body.hpp"
#include "core/bonds/crack_facet.hpp"
#include "core/bonds/family.hpp"
#include "core/bonds/mirror_condition.hpp"

namespace perifrac {

/// Takes fields of a coarse body to the finer one, linear between its points and their ghosts,
/// constant beyond its free surfaces; and forces the other way, by the transpose. Face values are
/// the same on both.
template <int D>
class CoarseInterpolation {
 public:
  /// `family`: of the coarse body, which must stay; `mirror`: on it.
  CoarseInterpolation(const Points<D>& fine, const CoarseBody<D>& coarse, const Family<D>& family,
                      MirrorCondition<D, D> mirror);

  /// Adds to `fine` what the displacement `coarse` is there; both D blocks, then face values.
  void add(const Eigen::VectorXd& coarse, Eigen::VectorXd& fine) const;
  /// The transpose: coarse = P^T fine.
  void restrict(const Eigen::VectorXd& fine, Eigen::VectorXd& coarse) const;

  /// A crack opens along a facet: fine points hear no more of coarse ones behind it, where they
  /// hear of others. `fine` and `family` as of the constructor, in which no bond is longer than
  /// `reach` [m].
  void cut(const CrackFacet<D>& facet, const Points<D>& fine, const Family<D>& family,
           double reach);

  std::size_t bytes() const;

 private:
  /// A sparse matrix by rows.
  struct Rows {
    std::vector<Index> begin{0};
    std::vector<Index> column{};
    std::vector<float> weight{};  // quarters, or a preconditioner's own business
    void multiply(const double* from, double* to, bool adds) const;
    Index count() const { return static_cast<Index>(begin.size()) - 1; }
    float& at(Index row, Index wanted);  ///< which has a place
  };
  static Rows transpose(const Rows& rows, Index columns);

  Rows from_nodes_;  ///< by fine point, of coarse nodes
  Rows to_nodes_;    ///< its transpose
  MirrorCondition<D, D> mirror_;
  Index coarse_points_, fine_points_, nodes_;
  mutable std::vector<double> node_values_;
};

}  // namespace perifrac
