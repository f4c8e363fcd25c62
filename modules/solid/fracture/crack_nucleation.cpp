#include "modules/solid/fracture/crack_nucleation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/random_bits.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

namespace {

/// From a crack, where J at its tips looks [spacings].
constexpr double reach_of_tips = 4.5;

/// Points so far from a line say what stress it is under; where there is none for longer than
/// `gap` along it, the body ends [spacings].
constexpr double beside = 0.75, gap = 1.6;

/// Readiness that differs by less than this part of the largest is the same: in uniform stress
/// rounding must not say where a crack begins. Lengths likewise [spacings].
constexpr double tie = 1e-7;

double distance(const Vector<2>& x, const CrackFacet<2>& facet) {
  const double t = std::clamp(place_within<2>(facet, x)[0], 0.0, 1.0);
  const Vector<2> off = x - facet[0] - t * (facet[1] - facet[0]);
  return std::hypot(off[0], off[1]);
}

/// The symmetric stress at a point of blocks of components.
struct PlaneStress {
  double xx, yy, xy;

  PlaneStress(std::span<const double> stress, Index i) {
    const std::size_t points = stress.size() / 4;
    xx = stress[i];
    yy = stress[3 * points + i];
    xy = 0.5 * (stress[points + i] + stress[2 * points + i]);
  }
  double largest() const { return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy); }
  /// Its larger component is positive.
  Vector<2> largest_direction() const {
    const bool is_even = std::hypot(xx - yy, 2.0 * xy) < tie * std::abs(xx + yy);
    const double angle = is_even ? 0.0 : 0.5 * std::atan2(2.0 * xy, xx - yy);
    const double c = std::cos(angle), s = std::sin(angle);
    const double sign = std::copysign(1.0, std::abs(c) > (1.0 + tie) * std::abs(s) ? c : s);
    return {sign * c, sign * s};
  }
  double across(const Vector<2>& n) const {
    return n[0] * n[0] * xx + n[1] * n[1] * yy + 2.0 * n[0] * n[1] * xy;
  }
};

}  // namespace

CrackNucleation::CrackNucleation(const Body<2>& body, CutBody<2>& cracked,
                                 FractureEnergy<2> fracture_energy,
                                 const TensileStrength<2>& strength)
    : body_(body),
      cracked_(cracked),
      fracture_energy_(std::move(fracture_energy)),
      readiness_(body.points().size()),
      near_(body.points().size(), 0) {
  for (Index i = 0; i < body.points().size(); ++i) {
    strength_.push_back(strength.at(body.points().at(i)));
  }
}

void CrackNucleation::find_near_cracks() {
  if (looked_at_ == cracked_.version()) return;
  looked_at_ = cracked_.version();
  for_each_point(static_cast<Index>(near_.size()), [&](Index i) {
    near_[i] = std::ranges::any_of(cracked_.facets(), [&](const CrackFacet<2>& facet) {
      return distance(body_.points().at(i), facet) < reach_of_tips * body_.spacing();
    });
  });
}

double CrackNucleation::find_readiness(std::span<const double> stress) {
  find_near_cracks();
  const Index points = body_.points().size();
  for_each_point(points,
                 [&](Index i) { readiness_[i] = PlaneStress(stress, i).largest() / strength_[i]; });
  unit_ = tie * std::max(std::ranges::max(readiness_), 0.0);
  readiest_ = {};
  if (unit_ == 0.0) return 0.0;
  for_each_point(points,
                 [&](Index i) { readiness_[i] = unit_ * std::round(readiness_[i] / unit_); });
  for (Index i = 0; i < points; ++i) {
    // The mean over a line is no more than the largest along it.
    if (near_[i] != 0 || readiness_[i] < readiest_.readiness || !is_largest(i)) continue;
    const Nucleus nucleus = nucleus_at(i, stress);
    const bool is_as_ready = nucleus.readiness == readiest_.readiness;
    if (nucleus.readiness > readiest_.readiness ||
        (is_as_ready && nucleus.facets < readiest_.facets)) {
      readiest_ = nucleus;
    }
  }
  return readiest_.readiness;
}

/// Of its family; of equals the first in a random order, so that in even stress a few are left
/// everywhere, and not the one that is the first of all.
bool CrackNucleation::is_largest(Index i) const {
  const Family<2>& family = cracked_.family();
  for (const auto& bond : family.bonds(i)) {
    const Index j = bond.other;
    if (j >= family.point_count) continue;
    if (readiness_[j] > readiness_[i]) return false;
    if (readiness_[j] == readiness_[i] && random_bits(0, j) < random_bits(0, i)) return false;
  }
  return true;
}

std::vector<CrackNucleation::LinePoint> CrackNucleation::points_along(
    const Vector<2>& x, const Vector<2>& normal, std::span<const double> stress) const {
  std::vector<LinePoint> line;
  for (Index i = 0; i < body_.points().size(); ++i) {
    const Vector<2> from = body_.points().at(i) - x;
    const double above = dot(from, normal);
    if (std::abs(above) > beside * body_.spacing()) continue;
    line.push_back({cross(normal, from), PlaneStress(stress, i).across(normal) / strength_[i],
                    above > 0.0, near_[i] != 0});
  }
  std::ranges::stable_sort(line, {}, &LinePoint::along);
  return line;
}

/// The body goes on from the middle as far as points follow one another.
std::span<const CrackNucleation::LinePoint> CrackNucleation::part_in_body(
    std::span<const LinePoint> line) const {
  const double most = gap * body_.spacing();
  const auto middle = std::ranges::lower_bound(line, 0.0, {}, &LinePoint::along);
  auto last = middle, first = middle;
  while (last != line.end() &&
         (last == line.begin() || last->along - std::prev(last)->along <= most)) {
    ++last;
  }
  while (first != line.begin() &&
         (first == line.end() || first->along - std::prev(first)->along <= most)) {
    --first;
  }
  return {first, last};
}

/// Where a nucleus would lie on such a part, along the line: around its middle, or at a face that
/// is near.
std::pair<double, double> CrackNucleation::piece_of(std::span<const LinePoint> part,
                                                    double length) const {
  const double dx = body_.spacing(), same = tie * dx;
  const auto facets = [](double count, int least) {
    return std::max(least, static_cast<int>(std::min(std::ceil(count - 1e-6), 1e6)));
  };
  const double inner = dx * facets(inner_nucleus * length, least_inner_facets);
  const double edge = dx * facets(edge_nucleus * length, least_edge_facets);
  const double clear = dx * least_edge_facets;
  const double low = part.front().along - 0.5 * dx, high = part.back().along + 0.5 * dx;
  double begin = -0.5 * inner, end = 0.5 * inner;
  if (-low <= high + same && -low <= edge + same) {
    begin = low;
    end = low + edge;
  } else if (high <= edge + same) {
    begin = high - edge;
    end = high;
  } else if (high - low >= inner + 2.0 * clear - same) {
    // What remains between it and a face is not to be too thin for J.
    begin = std::clamp(begin, low + clear, high - clear - inner);
    end = begin + inner;
  }
  return {std::max(begin, low), std::min(end, high)};
}

/// The mean over a piece, in whole units; 0 where a crack is near, or the rock lies on one side.
double CrackNucleation::readiness_over(std::span<const LinePoint> part, double begin,
                                       double end) const {
  const double same = tie * body_.spacing();
  double sum = 0.0;
  int count = 0, above = 0;
  for (const LinePoint& point : part) {
    if (point.along < begin - same || point.along > end + same) continue;
    if (point.near_crack) return 0.0;
    sum += point.readiness;
    ++count;
    above += point.is_above ? 1 : 0;
  }
  const bool is_inside = 4 * above > count && 4 * above < 3 * count;
  return is_inside ? unit_ * std::round(sum / count / unit_) : 0.0;
}

/// Half a spacing beside point i, where a crack cuts least unevenly through the points around it;
/// on the side that is under more tension.
CrackNucleation::Nucleus CrackNucleation::nucleus_at(Index i,
                                                     std::span<const double> stress) const {
  const double dx = body_.spacing();
  const Vector<2> at = body_.points().at(i);
  const Vector<2> normal = PlaneStress(stress, i).largest_direction();
  const double length = cracked_.elastic().law(i).plane_strain_modulus() * fracture_energy_.at(at) /
                        (strength_[i] * strength_[i]) / dx;
  Nucleus best{};
  for (const double side : {0.5 * dx, -0.5 * dx}) {
    const Vector<2> x = at + side * normal;
    const std::vector<LinePoint> line = points_along(x, normal, stress);
    const std::span<const LinePoint> part = part_in_body(line);
    if (part.empty()) continue;
    const auto [begin, end] = piece_of(part, length);
    const double readiness = readiness_over(part, begin, end);
    if (readiness <= best.readiness) continue;
    const auto place = [&](double s) { return x + s * perpendicular(normal); };
    best = {place(begin), place(end),
            std::max(1, static_cast<int>(std::lround((end - begin) / dx))), readiness};
  }
  return best;
}

double CrackNucleation::cut() {
  double energy = 0.0;
  Vector<2> from = readiest_.begin;
  for (int k = 1; k <= readiest_.facets; ++k) {
    const double share = static_cast<double>(k) / readiest_.facets;
    const Vector<2> to = readiest_.begin + share * (readiest_.end - readiest_.begin);
    const CrackFacet<2> facet = {from, to};
    if (cracked_.cut(facet)) energy += area<2>(facet) * fracture_energy_.at(middle<2>(facet));
    from = to;
  }
  return energy;
}

}  // namespace perifrac
