#include "modules/pore_flow/flux/cut_bonds.hpp"

namespace perifrac {

template <int D>
bool CutBonds<D>::follow(const BondState<D>& bonds, const Family<D>& intact) {
  if (version_ == bonds.version()) return false;
  version_ = bonds.version();
  if (!family_) {
    family_ = std::make_shared<Family<D>>(intact);
    intact_weight_ = family_->weight;
  }
  family_->weight = intact_weight_;
  for (const BrokenBond& bond : bonds.broken()) {
    silence(*family_, bond.i, bond.j);
    points_.insert(points_.end(), {bond.i, bond.j});
  }
  keep_each_once(points_);
  return true;
}

template class CutBonds<2>;
template class CutBonds<3>;

}  // namespace perifrac
