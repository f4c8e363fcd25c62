#include "modules/solid/rigid_slits.hpp"

#include "core/bonds/bond_lengths.hpp"
#include "core/bonds/crack_cut.hpp"

namespace perifrac {

template <int D>
RigidSlits<D>::RigidSlits(std::shared_ptr<const Body<D>> body,
                          const std::vector<CrackFacet<D>>& facets, std::vector<double> opening)
    : body_(std::move(body)), bonds_(body_->claim_bond_state()), opening_(std::move(opening)) {
  Family<D> family = *body_->family(0);
  const double longest = bond_lengths(family).longest;
  for (const CrackFacet<D>& facet : facets) {
    const auto cut = bonds_cut_by<D>(facet, family, longest);
    for (const auto& [i, j] : cut) silence(family, i, j);
    bonds_.add_facet(facet, cut);
  }
}

template class RigidSlits<2>;
template class RigidSlits<3>;

}  // namespace perifrac
