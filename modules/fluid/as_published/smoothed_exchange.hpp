#pragma once

#include <memory>
#include <vector>

#include "modules/fluid/exchange/exchange.hpp"

namespace perifrac {

/// Another exchange and, beside it, what is left of smoothing the density of the pore fluid across
/// the interface (paper Eq 32) when nothing may be created: between each fluid point i and point j
/// of the body,
///   J_ij = C c_0 / spacing rho_0 / K (p_i - p_j - rho_0 g.(x_i - x_j)) omega V_i V_j / sum omega
///   V,
/// the sum that of an endless lattice. Whatever the permeability: a leak, the larger the smaller
/// the spacing.
template <int D>
class SmoothedExchange final : public Exchange<D> {
 public:
  /// `coefficient`: C.
  SmoothedExchange(std::unique_ptr<Exchange<D>> exchange, double coefficient, double spacing,
                   double horizon, const PairInfluence& influence);

  bool keeps_mass() const override { return exchange_->keeps_mass(); }
  void find(const FluidStep<D>& step, const PoreInput& pores, double t, NearWalls<D>& walls,
            std::vector<double>& rate) override;

 private:
  std::unique_ptr<Exchange<D>> exchange_;
  double coefficient_;  ///< C / (spacing sum omega V)
};

}  // namespace perifrac
