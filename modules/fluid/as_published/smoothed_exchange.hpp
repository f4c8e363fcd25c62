#pragma once

#include <memory>
#include <vector>

#include "modules/fluid/exchange/exchange.hpp"
#include "modules/fluid/walls/body_neighbours.hpp"

namespace perifrac {

/// Another exchange and, beside it, the fluid's part in the smoothing of the pore fluid's density
/// (paper Eq 32), in which pressure is linear. In every step point j of the body comes nearer to
/// the fluid points i near it by
///   C sum_i omega V_i (p_i - p_j - rho_0 g.(x_i - x_j)) / (sum_k omega V_k + C sum_i omega V_i),
/// k the body's points with j itself, as they lie at the start; what j gains by i the neighbour i
/// gives. The rest of the mean, over k, is the pore flow's to take. Whatever the permeability: a
/// leak, the larger the shorter the steps.
template <int D>
class SmoothedExchange final : public Exchange<D> {
 public:
  /// `coefficient`: C. Pores need a slope of their pressure with mass; where it is 0 none passes.
  SmoothedExchange(std::unique_ptr<Exchange<D>> exchange, double coefficient, const Body<D>& body,
                   const WallCloud<D>& cloud, const Period<D>& period, double horizon,
                   const PairInfluence& influence);

  bool keeps_mass() const override { return exchange_->keeps_mass(); }
  void find(const FluidStep<D>& step, const PoreInput& pores, double t, double length,
            NearWalls<D>& walls, std::vector<double>& rate) override;

 private:
  std::unique_ptr<Exchange<D>> exchange_;
  double coefficient_;
  std::vector<double> body_weight_;  ///< sum_k omega V_k of every point of the cloud
  std::vector<double> uptake_;       ///< by near wall point [kg/(Pa s)], over omega V_i
};

}  // namespace perifrac
