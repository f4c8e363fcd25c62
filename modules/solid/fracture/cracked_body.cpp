#include "modules/solid/fracture/cracked_body.hpp"

#include "core/base/require.hpp"
#include "modules/solid/fracture/loose_piece.hpp"

namespace perifrac {

template <int D>
CrackedBody<D>::CrackedBody(std::shared_ptr<Family<D>> family, double spacing,
                            std::shared_ptr<BreakableElasticity<D>> elastic,
                            Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
                            std::optional<InitialStress<D>> initial_stress,
                            std::vector<CrackFacet<D>> seeds)
    : CutBody<D>(std::move(family), spacing, std::move(elastic), bonds, initial_stress,
                 std::move(seeds)),
      free_unknowns_(std::move(free_unknowns)) {}

template <int D>
const PartialCuts& CrackedBody<D>::partial() const {
  static const PartialCuts none;
  return none;
}

template <int D>
void CrackedBody<D>::add_jump(const FaceJump<D>& jump) {
  jumps_.push_back(jump);
  pressed_.push_back(this->pressed_by(static_cast<Index>(jumps_.size()) - 1));
}

template <int D>
Eigen::VectorXd CrackedBody<D>::areas() const {
  Eigen::VectorXd area(static_cast<Eigen::Index>(jumps_.size()));
  for (Eigen::Index f = 0; f < area.size(); ++f) area[f] = jumps_[f].area;
  return area;
}

template <int D>
Eigen::MatrixXd CrackedBody<D>::whole_compliance() {
  const auto count = std::ssize(jumps_);
  Eigen::MatrixXd whole(D * count, D * count);
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) whole.block(a * count, b * count, count, count) = compliance(a, b);
  }
  return whole;
}

template <int D>
std::vector<std::vector<Index>> CrackedBody<D>::loose_pieces() {
  return find_loose_pieces<D>(*elastic_, *family_, free_unknowns_);
}

/// Throws PieceCutFree where the cut leaves a piece that nothing holds.
template <int D>
void CrackedBody<D>::check_pieces(std::span<const std::pair<Index, Index>> cut) {
  if (are_joined<D>(*family_, cut)) return;
  const auto loose = loose_pieces();
  if (loose.empty()) return;
  throw PieceCutFree(describe_piece<D>(*family_, loose.front()), loose.front().size());
}

template <int D>
void CrackedBody<D>::follow_bonds() {
  if (bonds_.version() == followed_) return;
  const std::vector<CrackFacet<D>> facets(bonds_.facets().begin(), bonds_.facets().end());
  bonds_ = BondState<D>(bonds_.version());
  this->mend();
  this->cut_seeds();
  rebuild();
  for (const CrackFacet<D>& facet : std::span(facets).subspan(seeds_.size())) cut(facet);
}

/// What facet f's faces carry along its normal and tangents [Pa].
template <int D>
Vector<D> CrackedBody<D>::face_load(std::size_t f, double pressure, std::span<const double> shear,
                                    bool relief) const {
  Vector<D> load = relief ? this->relief(static_cast<Index>(f)) : Vector<D>{};
  load[0] += pressure;
  if (!shear.empty()) load[1] += shear[f];
  return load;
}

/// Adds what a load of facet f's faces, along its normal and tangents [Pa], does to all unknowns.
template <int D>
void CrackedBody<D>::add_force(std::size_t f, const Vector<D>& load, Eigen::VectorXd& force) const {
  for (const auto& [point, coefficient] : jumps_[f].terms) {
    for (int a = 0; a < D; ++a) {
      double along = load[0] * jumps_[f].normal[a];
      for (int k = 1; k < D; ++k) along += load[k] * jumps_[f].tangents[k - 1][a];
      force[a * family_->point_count + point] += jumps_[f].area * coefficient * along;
    }
  }
}

template <int D>
Eigen::VectorXd CrackedBody<D>::face_force(const Eigen::VectorXd& pressure, bool relief,
                                           std::span<const double> shear) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(free_unknowns_.rows());
  require(pressure.size() == std::ssize(jumps_), "pressure of other facets than the body has");
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    add_force(f, face_load(f, pressure[f], shear, relief), force);
  }
  return force;
}

template <int D>
Eigen::VectorXd CrackedBody<D>::traction_force(std::span<const Index> faces,
                                               const Vector<D>& traction) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(free_unknowns_.rows());
  for (const Index f : faces) add_force(f, traction, force);
  return force;
}

template <int D>
typename CrackedBody<D>::Energies CrackedBody<D>::pressed_energies(
    const Eigen::VectorXd& pressure) const {
  Energies energies{};
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    const double load = face_load(f, pressure[f], {})[0];
    const double apart = jumps_[f].area * pressed_[f] * load;
    energies.elastic += 0.5 * apart * load;
    energies.relief += apart * this->relief(static_cast<Index>(f))[0];
  }
  return energies;
}

template class CrackedBody<2>;
template class CrackedBody<3>;

}  // namespace perifrac
