#pragma once

#include <memory>
#include <utility>

#include "modules/pore_flow/as_published/nested_flow.hpp"
#include "modules/pore_flow/flux/bond_flow.hpp"
#include "modules/pore_flow/flux/conservative_flow.hpp"
#include "modules/pore_flow/material/darcy_law.hpp"

namespace perifrac {

enum class FlowScheme { conservative, bond, nested };

/// The flow operator that a scheme makes of the same families, images and law.
template <int D, class Law>
std::unique_ptr<FlowOperator<D>> make_flow(FlowScheme scheme, LinearExactOperator<D, Law> op) {
  switch (scheme) {
    case FlowScheme::bond:
      return std::make_unique<BondFlow<D, Law>>(std::move(op));
    case FlowScheme::nested:
      return std::make_unique<NestedFlow<D, Law>>(std::move(op));
    default:
      return std::make_unique<ConservativeFlow<D, Law>>(std::move(op));
  }
}

// Compiled once, in make_flow.cpp.
extern template class LinearExactOperator<2, DarcyLaw<2>>;
extern template class LinearExactOperator<3, DarcyLaw<3>>;
extern template std::unique_ptr<FlowOperator<2>> make_flow(FlowScheme,
                                                           LinearExactOperator<2, DarcyLaw<2>>);
extern template std::unique_ptr<FlowOperator<3>> make_flow(FlowScheme,
                                                           LinearExactOperator<3, DarcyLaw<3>>);

}  // namespace perifrac
