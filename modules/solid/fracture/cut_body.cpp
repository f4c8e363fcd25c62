#include "modules/solid/fracture/cut_body.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_lengths.hpp"
#include "core/bonds/crack_cut.hpp"

namespace perifrac {

namespace {

/// Undoes silence(), where the bond has its weight in `whole`.
template <int D>
void unsilence(Family<D>& family, const Family<D>& whole, Index i, Index j) {
  for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
    const PointBonds bonds = family.bonds(from);
    for (Index k = 0; k < bonds.count(); ++k) {
      const Index end = bonds.other(k);
      const Index source =
          end < family.point_count ? end : family.ghost_source[end - family.point_count];
      if (source == to) family.weight.set(from, k, whole.weight(from, k));
    }
  }
}

}  // namespace

template <int D>
CutBody<D>::CutBody(std::shared_ptr<Family<D>> family, double spacing,
                    std::shared_ptr<BreakableElasticity<D>> elastic, BondState<D>& bonds,
                    std::optional<InitialStress<D>> initial_stress,
                    std::vector<CrackFacet<D>> seeds)
    : family_(std::move(family)),
      intact_(*family_),
      spacing_(spacing),
      elastic_(std::move(elastic)),
      bonds_(bonds),
      seeds_(std::move(seeds)),
      initial_stress_(initial_stress) {
  for (int a = 0; a < D; ++a) {
    const auto [least, largest] =
        std::ranges::minmax(std::span(family_->position[a]).first(family_->point_count));
    box_[a] = {least, largest};
  }
  longest_ = bond_lengths(*family_).longest;
  cut_seeds();
}

template <int D>
void CutBody<D>::cut_seeds() {
  for (const CrackFacet<D>& seed : seeds_) {
    const auto cut = bonds_cut_by<D>(seed, *family_, longest_);
    break_bonds(cut);
    bonds_.add_facet(seed, cut);
  }
  followed_ = bonds_.version();
}

template <int D>
void CutBody<D>::break_bonds(std::span<const std::pair<Index, Index>> bonds) {
  for (const auto& [i, j] : bonds) silence(*family_, i, j);
  elastic_->update(ends_of(bonds));
}

template <int D>
void CutBody<D>::heal_bonds(std::span<const std::pair<Index, Index>> bonds) {
  for (const auto& [i, j] : bonds) unsilence(*family_, intact_, i, j);
  elastic_->update(ends_of(bonds));
}

template <int D>
void CutBody<D>::mend() {
  *family_ = intact_;
  std::vector<Index> all(family_->point_count);
  for (Index i = 0; i < family_->point_count; ++i) all[i] = i;
  elastic_->update(all);
}

template <int D>
bool CutBody<D>::is_intact_along(const CrackFacet<D>& facet) const {
  return !bonds_cut_by<D>(facet, *family_, longest_).empty();
}

template <int D>
Vector<D> CutBody<D>::relief(Index f) const {
  if (!initial_stress_) return {};
  const FaceJump<D>& face = jumps_[f];
  const Vector<D> there = initial_stress_->at(middle<D>(bonds_.facets()[f]));
  Vector<D> stress{};
  for (int a = 0; a < D; ++a) {
    stress[0] += face.normal[a] * there[a] * face.normal[a];
    for (int k = 1; k < D; ++k) {
      stress[k] += face.tangents[k - 1][a] * there[a] * face.normal[a];
    }
  }
  return stress;
}

template <int D>
double CutBody<D>::stress_along(Index f) const {
  if (!initial_stress_) return 0.0;
  const Vector<D> there = initial_stress_->at(middle<D>(bonds_.facets()[f]));
  const Vector<D>&normal = jumps_[f].normal, &tangent = jumps_[f].tangents[0];
  double sum = 0.0;
  for (int a = 0; a < D; ++a) {
    sum += there[a] * (tangent[a] * tangent[a] - normal[a] * normal[a]);
  }
  return sum;
}

template <int D>
double CutBody<D>::pressed_by(Index f) const {
  if constexpr (D == 3) return 0.0;
  double softness = 0.0;
  for (const auto& [point, coefficient] : jumps_[f].terms) {
    const IsotropicElasticity<D>& law = elastic_->law(point);
    softness += 0.25 * std::abs(coefficient) / (law.lame_lambda + law.shear_modulus);
  }
  return jumps_[f].reach * softness;
}

template <int D>
Eigen::VectorXd CutBody<D>::force_on_faces(const Eigen::VectorXd& stress) const {
  const Index points = family_->point_count;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(elastic_->size());
  for (const CrackFacet<D>& facet : facets()) {
    const FaceJump<D> face = face_jump<D>(facet, intact_, spacing_, longest_);
    Vector<D> traction{};  // the mean of both sides
    for (const auto& [point, coefficient] : face.terms) {
      const double share = 0.5 * std::abs(coefficient) / family_->volume[point];
      for (int a = 0; a < D; ++a) {
        for (int b = 0; b < D; ++b) {
          traction[a] += share * stress[(a * D + b) * points + point] * face.normal[b];
        }
      }
    }
    for (const auto& [point, coefficient] : face.terms) {
      for (int a = 0; a < D; ++a)
        force[a * points + point] -= face.area * coefficient * traction[a];
    }
  }
  return force;
}

template <int D>
Vector<D> CutBody<D>::jump(Index f, std::span<const double> unknowns) const {
  Vector<D> sum{};
  for (const auto& [point, coefficient] : jumps_[f].terms) {
    for (int a = 0; a < D; ++a) {
      const double u = unknowns[a * family_->point_count + point];
      sum[0] += coefficient * jumps_[f].normal[a] * u;
      for (int k = 1; k < D; ++k) sum[k] += coefficient * jumps_[f].tangents[k - 1][a] * u;
    }
  }
  return sum;
}

template <int D>
bool CutBody<D>::reaches(const Vector<D>& x, double distance) const {
  for (int a = 0; a < D; ++a) {
    const auto [least, largest] = box_[a];
    if (x[a] - distance < least || x[a] + distance > largest) return false;
  }
  return true;
}

template class CutBody<2>;
template class CutBody<3>;

}  // namespace perifrac
