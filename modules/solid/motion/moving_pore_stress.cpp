#include "modules/solid/motion/moving_pore_stress.hpp"

#include <algorithm>

#include "core/base/block_sum.hpp"

namespace perifrac {

bool MovingPoreStress::set(const PoreStressInput& input) {
  input_ = input;
  // Going back to before the first window takes the reference away again.
  if (!reference_slope_.empty() && std::ranges::equal(input.slope, slope_)) return false;
  if (reference_slope_.empty()) {
    if (std::ranges::all_of(input.slope, [](double s) { return s == 0.0; })) return false;
    reference_slope_.assign(input.slope.begin(), input.slope.end());
  }
  slope_.assign(input.slope.begin(), input.slope.end());
  growth_ = 1.0;
  for (std::size_t i = 0; i < slope_.size(); ++i) {
    if (reference_slope_[i] != 0.0) growth_ = std::max(growth_, slope_[i] / reference_slope_[i]);
  }
  return true;
}

void MovingPoreStress::find(double t) {
  value_.resize(input_.value.size());
  const double since_end = t - input_.end;
  for_each_entry(static_cast<Index>(value_.size()),
                 [&](Index i) { value_[i] = input_.value[i] + since_end * input_.rate[i]; });
}

bool MovingPoreStress::note_reference() {
  if (reference_slope_ == noted_slope_) return false;
  noted_slope_ = reference_slope_;
  zeros_.assign(noted_slope_.size(), 0.0);
  return true;
}

std::span<const double> MovingPoreStress::acting(std::span<const double> dilatation) {
  acting_.resize(value_.size());
  with_pore_stress(now(), [&](auto&& at) {
    for (std::size_t i = 0; i < value_.size(); ++i) {
      acting_[i] = at(static_cast<Index>(i), dilatation[i]);
    }
  });
  return acting_;
}

}  // namespace perifrac
