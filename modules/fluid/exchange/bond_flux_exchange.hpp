#pragma once

#include <span>
#include <vector>

#include "core/body/body.hpp"
#include "core/geometry/pair_influence.hpp"
#include "modules/fluid/exchange/exchange.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/walls/rigid_wall.hpp"

namespace perifrac {

/// One flux for each bond between a fluid point i and a point j of the body's outermost layer,
///   J_ij = rho_0 kappa_j omega 4d / (tr M_i + tr M_j) (p_i - p_j - rho_0 g.(x_i - x_j))
///          (1 + h_i / d_j) V_i V_j,
/// which i loses and j gets. The shape tensors M count the neighbours of both phases and the walls
/// that rest. Along the part of a bond that lies in the fluid pressure does not fall, hence the
/// height h of i above the surface over the depth d of j below it. Points farther below get their
/// fluid from the layer: fed across the interface, they would move it by a tenth of a spacing.
template <int D>
class BondFluxExchange final : public Exchange<D> {
 public:
  BondFluxExchange(const Body<D>& body, const WallCloud<D>& cloud,
                   std::span<const RigidWall<D>> rigid, const Period<D>& period, double horizon,
                   const PairInfluence& influence);

  void find(const FluidStep<D>& step, const PoreInput& pores, double t, double length,
            NearWalls<D>& walls, std::vector<double>& rate) override;

 private:
  /// The share that body and walls at rest have in tr M, of every point of the cloud.
  std::vector<double> solid_moment_;
  /// 1 / d of the cloud's points in the outermost layer, 0 of the others [1/m].
  std::vector<double> inverse_depth_;
};

}  // namespace perifrac
