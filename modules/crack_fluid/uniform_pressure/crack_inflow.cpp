#include "modules/crack_fluid/uniform_pressure/crack_inflow.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

void CrackInflow::add(const FacetInflow& inflow) {
  if (inflow.stiffness > 0.0) {
    smooth_ones_.push_back(inflow);
    return;
  }
  auto level = std::ranges::find(levels_, inflow.target, &Level::target);
  if (level == levels_.end()) level = levels_.insert(level, {inflow.target, 0.0, 0.0, {}});
  level->least += inflow.least;
  level->most += inflow.most;
  level->inflows.push_back(inflow);
}

bool CrackInflow::order() {
  std::ranges::sort(levels_, std::greater{}, &Level::target);
  for (std::size_t k = 0; k <= levels_.size(); ++k) {
    if (std::isnan(total_below(k))) return false;
  }
  return true;
}

/// Between the targets of the level before and this one.
double CrackInflow::total_below(std::size_t level) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    sum += k < level ? levels_[k].most : levels_[k].least;
  }
  return sum;
}

double CrackInflow::balance(double v, double without, double weight) {
  v_ = v;
  smooth_ = 0.0;
  for (const FacetInflow& inflow : smooth_ones_) smooth_ += (inflow.target - v) / inflow.stiffness;
  without -= smooth_;
  held_ = -1;
  reached_ = 0;
  total_ = total_below(0);
  double left = without - total_;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const double held = weight * (v - levels_[k].target);
    const double next = total_below(k + 1), beyond = without - next;
    if (left <= std::max(held, beyond)) continue;
    reached_ = k + 1;
    held_ = held >= beyond ? static_cast<int>(k) : -1;
    total_ = held_ >= 0 ? without : next;
    left = std::max(held, beyond);
  }
  return left;
}

double CrackInflow::slope() const {
  double sum = 0.0;
  for (const FacetInflow& inflow : smooth_ones_) sum += 1.0 / inflow.stiffness;
  return sum;
}

std::vector<std::pair<Index, double>> CrackInflow::by_facet() const {
  std::vector<std::pair<Index, double>> all;
  for (const FacetInflow& inflow : smooth_ones_) {
    all.emplace_back(inflow.facet, (inflow.target - v_) / inflow.stiffness);
  }
  double rest = total_;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    if (static_cast<int>(k) == held_) continue;
    for (const FacetInflow& inflow : levels_[k].inflows) {
      const double amount = k < reached_ ? inflow.most : inflow.least;
      all.emplace_back(inflow.facet, amount);
      rest -= amount;
    }
  }
  if (held_ < 0) return all;
  const auto& held = levels_[held_].inflows;
  for (const FacetInflow& inflow : held) {
    all.emplace_back(inflow.facet, rest / static_cast<double>(held.size()));
  }
  return all;
}

}  // namespace perifrac
