#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/solvers/supernodes.hpp"

namespace perifrac {

/// Goes through all of a factor for one right-hand side. Branches of the elimination tree are gone
/// through side by side, each with sums of its own for the trunk that they lead up to; which these
/// are depends on the factor alone, and so do the bits of the result.
class SupernodalSweep {
 public:
  /// Refers to the arrays of `factor`.
  explicit SupernodalSweep(const Supernodes& factor);

  /// x = L^-1 x and x = L^-T x, x in the rows of P A P^T; `values` are those of L.
  void forward(const double* values, Eigen::Ref<Eigen::VectorXd> x);
  void backward(const double* values, Eigen::Ref<Eigen::VectorXd> x);

 private:
  /// A supernode and all that lead up to it: `first` to `root`.
  struct Branch {
    int first, root;
    std::int64_t values;     ///< of the factor
    Eigen::VectorXd beyond;  ///< what is to be taken from the rows below the root
  };
  struct ThreadRoom {
    Eigen::VectorXd gathered;
    std::vector<int> place;  ///< in `beyond`, of each row that is there
  };

  void find_branches();
  int make_room();
  void forward(const double* values, Branch& branch, ThreadRoom& room,
               Eigen::Ref<Eigen::VectorXd> x) const;
  void backward(const double* values, int s, ThreadRoom& room, Eigen::Ref<Eigen::VectorXd> x) const;

  Supernodes factor_;
  std::vector<Branch> branches_;  ///< the largest first
  std::vector<int> trunk_;        ///< all other supernodes, ascending
  std::vector<ThreadRoom> rooms_;
  bool is_worth_threads_ = false;
};

}  // namespace perifrac
