#include "coupling/window_schedule.hpp"

#include <algorithm>

namespace perifrac {

WindowSchedule::WindowSchedule(WindowType type, double first, double growth, double largest)
    : type_(type), first_(first), growth_(growth), largest_(largest), length_(first) {}

double WindowSchedule::end(double t, double stop) const {
  // Rounding in t must not make a sliver of what was meant as one whole window.
  constexpr double slack = 1.0 + 1e-9;
  const double rest = stop - t;
  const double length = share_ * length_;
  if (rest <= length * slack) return stop;
  return t + (rest < 2.0 * length ? 0.5 * rest : length);
}

void WindowSchedule::grow(double stable, bool easy) {
  constexpr double recovery = 1.2;  // four windows from one cut to the next, where it must be
  const bool was_cut = share_ < 1.0;
  if (was_cut && easy) share_ = std::min(recovery * share_, 1.0);
  if (type_ == WindowType::one_step) {
    length_ = std::min(stable, largest_);
  } else if (!was_cut) {
    length_ = std::min(length_ * growth_, largest_);
  }
}

void WindowSchedule::cut(double length) { share_ = 0.5 * length / length_; }

void WindowSchedule::shorten(double factor, double least) {
  share_ = std::max(std::min(share_, least), factor * share_);
}

void WindowSchedule::start_over(double stable) {
  length_ = type_ == WindowType::one_step ? std::min(stable, largest_) : first_;
  share_ = 1.0;
}

}  // namespace perifrac
