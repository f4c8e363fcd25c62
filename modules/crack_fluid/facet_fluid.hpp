#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/crack_fluid/crack_liquid.hpp"

namespace perifrac {

/// What every facet holds.
struct FacetFluid {
  std::vector<double> mass;      ///< [kg], in 2D per metre
  std::vector<double> unknown;   ///< v of crack_liquid.hpp [Pa]
  std::vector<double> settled;   ///< v after the last window of some length: where Newton begins
  std::vector<double> aperture;  ///< [m]

  std::size_t count() const { return mass.size(); }

  /// How much of each is full.
  std::vector<double> fill(const CrackLiquid& liquid) const {
    std::vector<double> share(count());
    std::ranges::transform(unknown, share.begin(), [&](double v) { return liquid.fill(v); });
    return share;
  }

  /// Facets are only added; what is new is dry.
  void match(std::size_t count, const CrackLiquid& liquid) {
    mass.resize(count, 0.0);
    unknown.resize(count, liquid.empty());
    settled.resize(count, liquid.empty());
    aperture.resize(count, liquid.residual_aperture);
  }

  void clear(const CrackLiquid& liquid) {
    std::ranges::fill(mass, 0.0);
    std::ranges::fill(unknown, liquid.empty());
    std::ranges::fill(settled, liquid.empty());
    std::ranges::fill(aperture, liquid.residual_aperture);
  }

  void visit_state(StateVisitor& visitor) {
    visitor.visit("crack_fluid_mass", mass);
    visitor.visit("crack_pressure", unknown);
    visitor.visit("crack_pressure_settled", settled);
    visitor.visit("crack_aperture", aperture);
  }
};

}  // namespace perifrac
