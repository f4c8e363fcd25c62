#include "modules/solid/rigid_slits.hpp"

#include "core/geometry/crack_cut.hpp"

namespace perifrac {

RigidSlits::RigidSlits(std::shared_ptr<const Body<2>> body,
                       const std::vector<CrackFacet<2>>& facets, std::vector<double> opening)
    : body_(std::move(body)), bonds_(body_->claim_bond_state()), opening_(std::move(opening)) {
  Family<2> family = *body_->family(0);
  for (const CrackFacet<2>& facet : facets) {
    const auto cut = bonds_cut_by<2>(facet, family);
    for (const auto& [i, j] : cut) silence(family, i, j);
    bonds_.add_facet(facet, cut);
  }
}

}  // namespace perifrac
