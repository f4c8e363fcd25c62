#pragma once

#include "modules/fluid/exchange/exchange.hpp"
#include "modules/fluid/walls/body_neighbours.hpp"

namespace perifrac {

/// The exchange of the paper's Eqs 25 to 31 as printed, for comparison: every point near the
/// interface finds a flux q from the potential p - rho_0 g.x of all its neighbours, fluid and body,
/// with its own shape tensor (Eqs 25, 28, 30), and then its density's rate from the q of those of
/// the other phase (Eq 26, second term of Eq 31),
///   rho V_i sum_j omega (q_j - q_i).(M_i^-1 Y) V_j  [kg/s] lost.
/// The two ends of a bond see one (q_j - q_i) Y: both lose, or both gain. Mass is not kept. Damaged
/// points of the body count whole here: Eq 23 alone knows of damage.
template <int D>
class PaperExchange final : public Exchange<D> {
 public:
  PaperExchange(const Body<D>& body, const WallCloud<D>& cloud, const Period<D>& period,
                double horizon, const PairInfluence& influence);

  bool keeps_mass() const override { return false; }
  void find(const FluidStep<D>& step, const PoreInput& pores, double t, double length,
            NearWalls<D>& walls, std::vector<double>& rate) override;

 private:
  void find_fluid_flux(const FluidStep<D>& step, const PoreInput& pores, double t,
                       const NearWalls<D>& walls);
  void find_body_flux(const FluidStep<D>& step, const PoreInput& pores, double t,
                      const NearWalls<D>& walls);

  BodyNeighbours<D> solid_;
  /// M (Eq 28) without the fluid's share, of every point of the cloud.
  std::array<std::vector<double>, symmetric_size<D>> solid_shape_;
  // In every step, with images: of fluid points near walls, and of near wall points.
  std::array<std::vector<double>, D> fluid_flux_;  ///< q [m/s]
  std::array<std::vector<double>, D> body_flux_;
  std::array<std::vector<double>, symmetric_size<D>> body_inverse_;  ///< M^-1
};

}  // namespace perifrac
