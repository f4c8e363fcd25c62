#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/body/body.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "modules/pore_flow/flux/cut_bonds.hpp"

namespace perifrac {

/// Smoothing of the pore fluid's density (paper Eq 32), in which pressure is linear: a point takes
/// the mean over its neighbourhood, itself included with omega(0) = 1,
///   p_i <- (V_i p_i + sum_j w_ij p_j) / (V_i + sum_j w_ij).
/// Without the point itself, steps near the stable limit still grow. It hides the growing modes of
/// the nested operator, and makes and loses fluid.
template <int D>
class PressureSmoothing {
 public:
  PressureSmoothing(std::shared_ptr<const Family<D>> family, MirrorCondition<D, 1> mirror,
                    std::vector<Index> points);

  /// The points that are smoothed.
  std::span<const Index> points() const { return points_; }

  /// No point is averaged with those beyond broken bonds.
  void follow(const BondState<D>& bonds) {
    if (!bonds_.follow(bonds, *family_)) return;
    family_ = bonds_.family();
    mirror_.use(*family_);
  }

  /// The new pressures of points(); p holds point values, then face values. Valid until the next
  /// call.
  std::span<const double> apply(std::span<const double> p);

 private:
  std::shared_ptr<const Family<D>> family_;
  MirrorCondition<D, 1> mirror_;
  CutBonds<D> bonds_;
  std::vector<Index> points_;
  std::vector<double> pressure_;  ///< workspace: on points and ghosts
  std::vector<double> smoothed_;  ///< by points_
};

/// The points within a horizon of a face, layers included.
template <int D>
std::vector<Index> points_near_faces(const Body<D>& body);

}  // namespace perifrac
