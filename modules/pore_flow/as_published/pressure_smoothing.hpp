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
/// the nested operator, and makes and loses fluid but where neighbours make up for it.
template <int D>
class PressureSmoothing {
 public:
  /// `points`: ascending; `held`: those of held pressure, which are not smoothed and give nothing;
  /// `compensated`: what a point gains its neighbours give.
  PressureSmoothing(std::shared_ptr<const Family<D>> family, MirrorCondition<D, 1> mirror,
                    std::vector<Index> points, std::span<const Index> held, bool compensated);

  /// The points that are smoothed.
  std::span<const Index> points() const { return points_; }

  /// No point is averaged with those beyond broken bonds, and the ends of these are smoothed too.
  void follow(const BondState<D>& bonds);

  /// The new pressures of points(); p holds point values, then face values. Valid until the next
  /// call.
  std::span<const double> apply(std::span<const double> p);

  bool is_compensated() const { return is_compensated_; }
  /// To be written: what the smoothed points gained by the last means [m^3], by points().
  std::span<double> gained() { return gained_; }
  /// What every point of the body gives its neighbours for it [m^3], in proportion to its weight in
  /// their means. Valid until the next call.
  std::span<const double> given();

 private:
  /// These points but those held.
  void smooth(std::vector<Index> points);

  std::shared_ptr<const Family<D>> family_;
  MirrorCondition<D, 1> mirror_;
  CutBonds<D> bonds_;
  std::vector<Index> points_;  ///< ascending
  std::vector<Index> intact_;  ///< those that are smoothed where nothing is broken
  std::vector<double> gives_;  ///< of nodes: 0 where held, else 1
  bool is_compensated_;
  std::vector<double> pressure_;  ///< workspace: on points and ghosts
  std::vector<double> smoothed_;  ///< by points_
  std::vector<double> gained_;    ///< by points_
  std::vector<double> share_;     ///< workspace: gain over weights, on points and ghosts
  std::vector<double> given_;     ///< by points of the body
};

/// The points within a horizon of a face, layers included, or of a cutout; ascending.
template <int D>
std::vector<Index> points_near_surfaces(const Body<D>& body);

}  // namespace perifrac
