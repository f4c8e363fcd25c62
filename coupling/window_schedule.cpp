#include "coupling/window_schedule.hpp"

#include <algorithm>

namespace perifrac {

WindowSchedule::WindowSchedule(WindowType type, double first, double growth, double largest)
    : type_(type), first_(first), growth_(growth), largest_(largest), length_(first) {}

double WindowSchedule::end(double t, double stop) const {
  // Rounding in t must not make a sliver of what was meant as one whole window.
  constexpr double slack = 1.0 + 1e-9;
  const double rest = stop - t;
  if (rest <= length_ * slack) return stop;
  return t + (rest < 2.0 * length_ ? 0.5 * rest : length_);
}

void WindowSchedule::grow(double stable) {
  length_ = std::min(type_ == WindowType::one_step ? stable : length_ * growth_, largest_);
}

void WindowSchedule::start_over(double stable) {
  length_ = type_ == WindowType::one_step ? std::min(stable, largest_) : first_;
}

}  // namespace perifrac
