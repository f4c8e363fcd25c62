#pragma once

#include <memory>

#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/lps_elasticity.hpp"

namespace perifrac::test {

/// A uniform linear-exact material on the families that the boundary asks for.
template <int D>
std::shared_ptr<ElasticOperator<D>> elastic(const Body<D>& body, const SolidBoundary<D>& boundary,
                                            IsotropicElasticity<D> law,
                                            std::optional<Vector<D>> initial_stress = {}) {
  using Law = IsotropicElasticity<D>;
  const auto family = body.family(boundary.mirrored());
  return std::make_shared<LinearExactElasticity<D, Law>>(
      LinearExactOperator<D, Law>(family, boundary.mirror_condition(*family), law), initial_stress);
}

/// A uniform linear peridynamic solid on the same.
template <int D>
std::shared_ptr<ElasticOperator<D>> lps(const Body<D>& body, const SolidBoundary<D>& boundary,
                                        IsotropicElasticity<D> law,
                                        std::optional<Vector<D>> initial_stress = {}) {
  const auto family = body.family(boundary.mirrored());
  return std::make_shared<LpsElasticity<D>>(
      family, boundary.mirror_condition(*family),
      LawByRegion<IsotropicElasticity<D>>{{law}, std::vector<std::uint8_t>(family->point_count, 0)},
      initial_stress);
}

}  // namespace perifrac::test
