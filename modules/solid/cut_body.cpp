#include "modules/solid/cut_body.hpp"

#include <algorithm>

#include "core/geometry/crack_cut.hpp"

namespace perifrac {

CutBody::CutBody(std::shared_ptr<Family<2>> family, double spacing,
                 std::shared_ptr<BreakableElasticity<2>> elastic, BondState<2>& bonds,
                 std::optional<InitialStress<2>> initial_stress, std::vector<CrackFacet<2>> seeds)
    : family_(std::move(family)),
      intact_(*family_),
      spacing_(spacing),
      elastic_(std::move(elastic)),
      bonds_(bonds),
      seeds_(std::move(seeds)),
      initial_stress_(initial_stress) {
  for (int a = 0; a < 2; ++a) {
    const auto [least, largest] =
        std::ranges::minmax(std::span(family_->position[a]).first(family_->point_count));
    box_[a] = {least, largest};
  }
  cut_seeds();
}

void CutBody::cut_seeds() {
  for (const CrackFacet<2>& seed : seeds_) {
    const auto cut = bonds_cut_by<2>(seed, *family_);
    break_bonds(cut);
    bonds_.add_facet(seed, cut);
  }
  followed_ = bonds_.version();
}

void CutBody::break_bonds(std::span<const std::pair<Index, Index>> bonds) {
  std::vector<Index> points;
  for (const auto& [i, j] : bonds) {
    silence(*family_, i, j);
    points.insert(points.end(), {i, j});
  }
  std::ranges::sort(points);
  const auto twice = std::ranges::unique(points);
  points.erase(twice.begin(), twice.end());
  elastic_->update(points);
}

void CutBody::mend() {
  *family_ = intact_;
  std::vector<Index> all(family_->point_count);
  for (Index i = 0; i < family_->point_count; ++i) all[i] = i;
  elastic_->update(all);
}

bool CutBody::is_intact_along(const CrackFacet<2>& facet) const {
  return !bonds_cut_by<2>(facet, *family_).empty();
}

Vector<2> CutBody::relief(Index f) const {
  if (!initial_stress_) return {};
  const Vector<2>& n = jumps_[f].normal;
  const Vector<2>& t = jumps_[f].tangent;
  const CrackFacet<2>& facet = bonds_.facets()[f];
  const Vector<2> there =
      initial_stress_->at({0.5 * (facet[0][0] + facet[1][0]), 0.5 * (facet[0][1] + facet[1][1])});
  Vector<2> stress{};
  for (int a = 0; a < 2; ++a) {
    stress[0] += n[a] * there[a] * n[a];
    stress[1] += t[a] * there[a] * n[a];
  }
  return stress;
}

Vector<2> CutBody::jump(Index f, std::span<const double> unknowns) const {
  Vector<2> sum{};
  for (const auto& [point, coefficient] : jumps_[f].terms) {
    for (int a = 0; a < 2; ++a) {
      const double u = unknowns[a * family_->point_count + point];
      sum[0] += coefficient * jumps_[f].normal[a] * u;
      sum[1] += coefficient * jumps_[f].tangent[a] * u;
    }
  }
  return sum;
}

bool CutBody::reaches(const Vector<2>& x, double distance) const {
  for (int a = 0; a < 2; ++a) {
    const auto [least, largest] = box_[a];
    if (x[a] - distance < least || x[a] + distance > largest) return false;
  }
  return true;
}

}  // namespace perifrac
