#include "modules/solid/fracture/crack_plane.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

constexpr std::array<CrackPlane::Cell, 4> neighbours = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr std::array<CrackPlane::Cell, 4> corners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// Over how much the front is evened out, and how far that is followed.
constexpr double evened = 1.25;
constexpr int reach = 5;

CrackPlane::Cell sum(const CrackPlane::Cell& a, const CrackPlane::Cell& b) {
  return {a[0] + b[0], a[1] + b[1]};
}

}  // namespace

CrackPlane::CrackPlane(const CrackFacet<3>& first,
                       std::function<bool(const CrackFacet<3>&)> is_rock)
    : origin_(first[0]),
      side_{first[1] - first[0], first[3] - first[0]},
      asks_rock_(std::move(is_rock)) {}

std::optional<CrackPlane::Cell> CrackPlane::cell_of(const CrackFacet<3>& facet) const {
  Cell cell;
  const Vector<3> off = facet[0] - origin_;
  for (int k = 0; k < 2; ++k) {
    cell[k] = static_cast<int>(std::lround(dot(off, side_[k]) / squared_norm(side_[k])));
  }
  const CrackFacet<3> own = this->facet(cell);
  const double size = std::sqrt(area<3>(own));
  for (int c = 0; c < 4; ++c) {
    for (int a = 0; a < 3; ++a) {
      if (std::abs(own[c][a] - facet[c][a]) > 1e-6 * size) return {};
    }
  }
  return cell;
}

CrackFacet<3> CrackPlane::facet(const Cell& cell) const {
  CrackFacet<3> facet;
  for (int c = 0; c < 4; ++c) {
    const Cell number = sum(cell, corners[c]);
    const auto known = corner_.find(number);
    if (known != corner_.end()) {
      facet[c] = known->second;
      continue;
    }
    facet[c] = origin_ + number[0] * side_[0] + number[1] * side_[1];
  }
  return facet;
}

void CrackPlane::add(const CrackFacet<3>& facet, Index number) {
  const Cell cell = *cell_of(facet);
  facets_[cell] = number;
  behind_front_.clear();
  for (int c = 0; c < 4; ++c) corner_.emplace(sum(cell, corners[c]), facet[c]);
}

bool CrackPlane::is_rock(const Cell& cell) const {
  const auto known = is_rock_.find(cell);
  if (known != is_rock_.end()) return known->second;
  return is_rock_[cell] = asks_rock_(facet(cell));
}

std::vector<CrackPlane::Cell> CrackPlane::ahead() const {
  std::vector<Cell> cells;
  for (const auto& [cell, number] : facets_) {
    for (const Cell& step : neighbours) {
      const Cell beside = sum(cell, step);
      if (!facets_.contains(beside) && is_rock(beside)) cells.push_back(beside);
    }
  }
  std::ranges::sort(cells);
  const auto twice = std::ranges::unique(cells);
  cells.erase(twice.begin(), twice.end());
  return cells;
}

double CrackPlane::radius() const {
  double sides = 0.0;
  for (const auto& [cell, number] : facets_) {
    for (const Cell& step : neighbours) {
      const Cell beside = sum(cell, step);
      if (!facets_.contains(beside) && is_rock(beside)) ++sides;
    }
  }
  // Sides of squares along a circle are 4 / pi times as long as it is.
  const double front = std::max(sides, 1.0) * M_PI / 4.0;
  return 2.0 * static_cast<double>(facets_.size()) / front;
}

/// From the part of what lies around that is crack, by a Gaussian weight: of a straight front the
/// normal distribution of the distance; of a round one so much less. What lies beyond a face of the
/// body does not count, which is right where the front meets it at a right angle.
double CrackPlane::behind_front(const Cell& cell) const {
  const auto [known, is_new] = behind_front_.try_emplace(cell);
  if (!is_new) return known->second;
  double crack = 0.0, all = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const Cell other = sum(cell, {i, j});
      const double weight = std::exp(-0.5 * (i * i + j * j) / (evened * evened));
      const bool is_crack = facets_.contains(other);
      if (is_crack) crack += weight;
      if (is_crack || is_rock(other)) all += weight;
    }
  }
  const double share = std::clamp(crack / all, 1e-6, 1.0 - 1e-6);
  known->second = evened * Eigen::numext::ndtri(share) + 0.5 * evened * evened / radius();
  return known->second;
}

}  // namespace perifrac
