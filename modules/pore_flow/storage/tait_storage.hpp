#pragma once

#include <vector>

#include "modules/pore_flow/storage/pore_storage.hpp"

namespace perifrac {

/// Storage of a fluid whose density follows Tait's equation:
///   phi + zeta = rho(p)/rho_0 [phi + alpha theta + (alpha - phi) p / K_s].
/// Where the pores close or run dry, the pressure is not a number.
class TaitStorage final : public PoreStorage {
 public:
  TaitStorage(PoreMaterials materials, PoreFluid fluid);

  bool set_dilatation(const DilatationInput& input) override;
  void pressure(double t, std::span<const double> zeta, std::span<double> p) const override;
  std::span<const double> effective_storage(double t, std::span<const double> zeta) override;
  double content(Index i, double p) const override;
  double content(double t, Index i, double p) const override;
  double undrained_slope(Index i, double zeta, double p) const override;
  double energy(Index i, double zeta, double p) const override;

 private:
  /// (rho/rho_0)^gamma - 1 at which pores of a volume `pores` + `softness` [(rho/rho_0)^gamma - 1]
  /// hold as much fluid as `pores` + `excess` would at rho_0 (all per volume of rock): to rounding
  /// of itself, however small. `pores` may be negative, where only the answer to pressure opens
  /// them.
  double relative_pressure(double excess, double pores, double softness) const;

  PoreFluid fluid_;
  DilatationInput dilatation_;
  std::vector<double> pore_answer_;        ///< d(pore volume)/dp: grains and alpha^2 slope [1/Pa]
  std::vector<double> effective_storage_;  ///< workspace
};

}  // namespace perifrac
