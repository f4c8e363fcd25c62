#pragma once

#include <memory>

#include "modules/solid/isotropic_elasticity.hpp"
#include "modules/solid/linear_exact_elasticity.hpp"
#include "modules/solid/solid_boundary.hpp"

namespace perifrac::test {

/// A uniform linear-exact material on the families that the boundary asks for.
template <int D>
std::shared_ptr<ElasticOperator<D>> elastic(const Body<D>& body, const SolidBoundary<D>& boundary,
                                            IsotropicElasticity<D> law) {
  using Law = IsotropicElasticity<D>;
  const auto family = body.family(boundary.mirrored());
  return std::make_shared<LinearExactElasticity<D, Law>>(
      LinearExactOperator<D, Law>(family, boundary.mirror_condition(*family), law));
}

}  // namespace perifrac::test
