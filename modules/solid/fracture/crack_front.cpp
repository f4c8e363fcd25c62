#include "modules/solid/fracture/crack_front.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

/// Where behind the front openings are looked at, and how far to both sides of that: nearer ones
/// are the lattice's, farther ones the whole crack's [spacings].
constexpr double depth = 1.5, either_side = 1.0;
/// So many facets as a crack has for each square that goes in one step: what it takes down the
/// energy release by is that part of the volume.
constexpr std::size_t facets_a_step = 50;
/// How far along the front [spacings].
constexpr double along_front = 1.0;

}  // namespace

CrackFront::CrackFront(const Body<3>& body, CutBody<3>& cracked, FractureEnergy<3> fracture_energy)
    : body_(body), cracked_(cracked), fracture_energy_(std::move(fracture_energy)) {}

void CrackFront::start(std::span<const CrackFacet<3>> seeds, double t) {
  since_.assign(seeds.size(), t);
  version_ = 0;
}

/// Planes and what may be next follow from the facets alone.
void CrackFront::follow_facets() {
  if (version_ == cracked_.version()) return;
  version_ = cracked_.version();
  planes_.clear();
  const auto is_in_body = [this](const CrackFacet<3>& facet) {
    return cracked_.reaches(middle<3>(facet), -0.25 * body_.spacing());
  };
  for (std::size_t f = 0; f < cracked_.facets().size(); ++f) {
    const CrackFacet<3>& facet = cracked_.facets()[f];
    auto plane = std::ranges::find_if(
        planes_, [&](const CrackPlane& known) { return known.cell_of(facet).has_value(); });
    if (plane == planes_.end()) plane = planes_.emplace(planes_.end(), facet, is_in_body);
    plane->add(facet, static_cast<Index>(f));
  }
  find_next();
}

void CrackFront::find_next() {
  next_.clear();
  for (const CrackPlane& plane : planes_) {
    const double radius = plane.radius() * body_.spacing();
    for (const CrackPlane::Cell& cell : plane.ahead()) {
      const CrackFacet<3> facet = plane.facet(cell);
      if (!cracked_.is_intact_along(facet)) continue;
      const Vector<3> at = middle<3>(facet);
      const TipLaw law{cracked_.elastic().law(body_.nearest_point(at)).plane_strain_modulus(),
                       fracture_energy_.at(at)};
      next_.push_back({facet, law, plane.behind_front(cell), radius, behind(plane, cell)});
    }
  }
}

std::vector<CrackFront::Behind> CrackFront::behind(const CrackPlane& plane,
                                                   const CrackPlane::Cell& cell) const {
  constexpr int reach = 5;
  const double own = plane.behind_front(cell);
  std::vector<Behind> facets;
  double deepest = 0.0;
  for (auto at = plane.facets().lower_bound({cell[0] - reach, cell[1] - reach});
       at != plane.facets().end() && at->first[0] <= cell[0] + reach; ++at) {
    const auto& [other, number] = *at;
    const double i = other[0] - cell[0], j = other[1] - cell[1];
    const double distance = plane.behind_front(other);
    const double sideways = i * i + j * j - (distance - own) * (distance - own);
    const double weight = std::exp(-0.5 * std::max(sideways, 0.0) / (along_front * along_front));
    if (weight < 1e-3) continue;
    facets.push_back({number, distance, weight});
    deepest = std::max(deepest, distance);
  }
  const double looked_at = std::min(depth, deepest);
  for (Behind& facet : facets) {
    facet.weight *= std::max(0.0, 1.0 - std::abs(facet.distance - looked_at) / either_side);
    facet.distance *= body_.spacing();
  }
  std::erase_if(facets, [](const Behind& facet) { return facet.weight <= 0.0; });
  return facets;
}

/// Openings beside those of the asymptote, both summed over the facets behind the front.
double CrackFront::readiness(const Next& next, const CrackState<3>& state) const {
  double weights = 0.0, distances = 0.0, ages = 0.0, viscosity = 0.0, leaks = 0.0;
  for (const auto& [f, distance, weight] : next.behind) {
    weights += weight;
    distances += weight * distance;
    ages += weight * (state.t - since_[f]);
    if (!state.viscosity.empty()) viscosity += weight * state.viscosity[f];
    if (!state.leak_off.empty()) leaks += weight * state.leak_off[f];
  }
  if (weights == 0.0) return 0.0;
  const TipFluid fluid{viscosity / weights, leaks / weights};
  TipLaw law = next.law;
  if (state.has_fluid()) {
    law.fracture_energy *= 2.0 / (1.0 + intensity_ratio_ * intensity_ratio_);
  }
  const double speed = distances / std::max(ages, 1e-300);
  double opening = 0.0, needed = 0.0;
  for (const auto& [f, distance, weight] : next.behind) {
    // As of a round crack under uniform pressure, sqrt(s (2R - s)).
    const double s = distance * (1.0 - 0.5 * std::min(distance / next.radius, 1.0));
    opening += weight * state.opening[f];
    needed += weight * law.opening(s, distance, fluid, speed);
  }
  return opening / needed;
}

double CrackFront::find_readiness(const CrackState<3>& state) {
  follow_facets();
  double most = 0.0;
  for (Next& next : next_) {
    next.readiness = readiness(next, state);
    most = std::max(most, next.readiness);
  }
  return most;
}

/// Of what is ready the squares nearest to their front, none beside another.
std::vector<CrackFront::Next> CrackFront::choose() const {
  std::vector<const Next*> due;
  for (const Next& next : next_) {
    if (next.readiness >= ready) due.push_back(&next);
  }
  std::ranges::stable_sort(due, std::greater{}, &Next::behind_front);
  const std::size_t most = std::max<std::size_t>(1, cracked_.facets().size() / facets_a_step);
  std::vector<Next> chosen;
  for (const Next* next : due) {
    if (chosen.size() == most) break;
    const Vector<3> at = middle<3>(next->facet);
    const bool is_beside = std::ranges::any_of(chosen, [&](const Next& other) {
      return norm(middle<3>(other.facet) - at) < 1.5 * body_.spacing();
    });
    if (!is_beside) chosen.push_back(*next);
  }
  return chosen;
}

double CrackFront::grow(const CrackState<3>& state) {
  const std::vector<Next> chosen = choose();
  if (chosen.empty()) return 0.0;
  double energy = 0.0, before = 0.0, after = 0.0;
  for (const Next& next : chosen) before += intensity_at_fixed_volume(next.behind);
  for (const Next& next : chosen) {
    cracked_.cut(next.facet);
    since_.push_back(state.t);
    energy += area<3>(next.facet) * next.law.fracture_energy;
  }
  follow_facets();
  for (const Next& next : chosen) {
    for (const CrackPlane& plane : planes_) {
      const auto cell = plane.cell_of(next.facet);
      if (cell) after += intensity_at_fixed_volume(behind(plane, *cell));
    }
  }
  intensity_ratio_ = std::min(1.0, after / before);
  return energy;
}

/// K_I beside a square under a uniform pressure, by the volume of the crack, up to a factor.
double CrackFront::intensity_at_fixed_volume(const std::vector<Behind>& behind) {
  double opening = 0.0, needed = 0.0;
  for (const auto& [f, distance, weight] : behind) {
    opening += weight * cracked_.intensity_at_fixed_volume(f);
    needed += weight * std::sqrt(distance);
  }
  return opening / needed;
}

void CrackFront::visit_state(StateVisitor& visitor) {
  visitor.visit("facet_since", since_);
  visitor.visit("intensity_ratio", intensity_ratio_);
}

}  // namespace perifrac
