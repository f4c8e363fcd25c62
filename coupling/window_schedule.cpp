#include "coupling/window_schedule.hpp"

#include <algorithm>

namespace perifrac {

WindowSchedule::WindowSchedule(double first, double growth, double largest)
    : first_(first), growth_(growth), largest_(largest), length_(first) {}

double WindowSchedule::end(double t, double stop, double stable) const {
  // Rounding in t must not make a sliver of what was meant as one whole window.
  constexpr double slack = 1.0 + 1e-9;
  const double length = std::min(length_, stable);
  const double rest = stop - t;
  if (rest <= length * (length_ <= stable ? slack : 1.0)) return stop;
  return t + (rest < 2.0 * length ? 0.5 * rest : length);
}

void WindowSchedule::grow() { length_ = std::min(length_ * growth_, largest_); }

}  // namespace perifrac
