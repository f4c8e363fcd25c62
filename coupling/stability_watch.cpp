#include "coupling/stability_watch.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

bool StabilityWatch::finds_growth(const Link::Mismatch& mismatch, double length) {
  constexpr int windows_in_block = 10;
  const double square = length * length;
  block_.mismatch = std::max(block_.mismatch, mismatch.absolute);
  block_.growing = std::max(block_.growing, mismatch.absolute / (square * square));
  block_.exceeds_values = block_.exceeds_values && mismatch.absolute > mismatch.scale;
  largest_value_ = std::max(largest_value_, mismatch.scale);
  if (++block_.windows == windows_in_block) end_block();
  const bool grows = (growing_ >= 2 && exceeding_ >= 2) || growing_ >= 40 ||
                     (growing_ >= 10 && (was_predicted_ || steady_ >= 8));
  return grows && mismatch.absolute > values_before_;
}

void StabilityWatch::end_block() {
  constexpr double growth = 1.5, well_predicted = 0.01;
  growing_ = last_ > 0.0 && block_.growing > growth * last_ ? growing_ + 1 : 0;
  const double factor = growing_ > 0 ? std::log(block_.growing / last_) : 0.0;
  const bool is_same = std::abs(factor - last_factor_) <= 0.02 * last_factor_;
  steady_ = growing_ > 0 && is_same ? steady_ + 1 : 0;
  last_factor_ = factor;
  exceeding_ = block_.exceeds_values ? exceeding_ + 1 : 0;
  if (growing_ == 0) {
    values_before_ = largest_value_;
    was_predicted_ = block_.mismatch < well_predicted * largest_value_;
  }
  last_ = block_.growing;
  block_ = {};
}

}  // namespace perifrac
