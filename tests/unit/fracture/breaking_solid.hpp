#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tests/unit/fracture/rock.hpp"
#include "tests/unit/solid/moving_solid.hpp"

namespace perifrac::test {

/// A material on a family of its own, whose bonds may break.
template <int D>
struct Breakable {
  std::shared_ptr<Family<D>> family;
  std::shared_ptr<BreakableElasticity<D>> elastic;

  Breakable(const Body<D>& body, const SolidBoundary<D>& boundary, IsotropicElasticity<D> law,
            Rock rock = Rock::linear_exact)
      : family(std::make_shared<Family<D>>(*body.family(boundary.mirrored()))),
        elastic(breakable<D>(rock, family, boundary.mirror_condition(*family), law)) {}
};

/// A dynamic solid whose bonds break at `limit`.
template <int D>
struct Breaking : Moving<D> {
  double limit = 1e-3;
  Rock rock = Rock::linear_exact;
  std::vector<CrackFacet<D>> seeds{};

  using Moving<D>::Moving;

  void start() {
    const Breakable<D> parts(*this->body, this->boundary, this->law, rock);
    this->module = std::make_unique<DynamicSolid<D>>(
        this->body, parts.elastic, this->boundary, density, this->damping, this->safety,
        std::make_unique<CriticalStretch<D>>(parts.family, parts.elastic,
                                             this->body->claim_bond_state(), seeds, limit));
    this->module->initialize(0.0);
  }
  std::size_t broken() const { return this->body->bond_state().broken().size(); }
  double energy_error() { return Moving<D>::energy_error() + this->value("fracture_energy"); }
};

}  // namespace perifrac::test
