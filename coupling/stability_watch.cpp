#include "coupling/stability_watch.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

void StabilityWatch::look(const Link::Mismatch& mismatch, double length) {
  constexpr int windows_in_block = 10;
  const double square = length * length;
  block_.mismatch = std::max(block_.mismatch, mismatch.absolute);
  block_.growing = std::max(block_.growing, mismatch.absolute / (square * square));
  if (mismatch.absolute <= mismatch.scale) block_.exceeds_values = 0;
  largest_value_ = std::max(largest_value_, mismatch.scale);
  if (++block_.windows == windows_in_block) end_block();
  const bool grows = (growing_ >= 2 && exceeding_ >= 2) || growing_ >= 40 ||
                     (growing_ >= 10 && (was_predicted_ != 0 || steady_ >= 8));
  if (grows && mismatch.absolute > values_before_) has_found_growth_ = 1;
}

void StabilityWatch::visit_state(StateVisitor& visitor) {
  visitor.enter("stability");
  visitor.visit("windows", block_.windows);
  visitor.visit("mismatch", block_.mismatch);
  visitor.visit("growing_mismatch", block_.growing);
  visitor.visit("exceeds_values", block_.exceeds_values);
  visitor.visit("last_block", last_);
  visitor.visit("largest_value", largest_value_);
  visitor.visit("values_before", values_before_);
  visitor.visit("was_predicted", was_predicted_);
  visitor.visit("growing_blocks", growing_);
  visitor.visit("last_factor", last_factor_);
  visitor.visit("steady_blocks", steady_);
  visitor.visit("exceeding_blocks", exceeding_);
  visitor.visit("has_found_growth", has_found_growth_);
  visitor.leave();
}

void StabilityWatch::end_block() {
  constexpr double growth = 1.5, well_predicted = 0.01;
  growing_ = last_ > 0.0 && block_.growing > growth * last_ ? growing_ + 1 : 0;
  const double factor = growing_ > 0 ? std::log(block_.growing / last_) : 0.0;
  const bool is_same = std::abs(factor - last_factor_) <= 0.02 * last_factor_;
  steady_ = growing_ > 0 && is_same ? steady_ + 1 : 0;
  last_factor_ = factor;
  exceeding_ = block_.exceeds_values != 0 ? exceeding_ + 1 : 0;
  if (growing_ == 0) {
    values_before_ = largest_value_;
    was_predicted_ = block_.mismatch < well_predicted * largest_value_ ? 1 : 0;
  }
  last_ = block_.growing;
  block_ = {};
}

}  // namespace perifrac
