#include "app/references/solutions/oscillation.hpp"

namespace perifrac {

namespace {

/// Integral over time of the straight lines between samples.
class Trapezoids {
 public:
  void add(double t, double value) {
    sum_ += 0.5 * (t - t_) * (value + value_);
    t_ = t;
    value_ = value;
  }
  void start(double t, double value) {
    sum_ = 0.0;
    t_ = t;
    value_ = value;
  }
  double sum() const { return sum_; }

 private:
  double sum_ = 0.0;
  double t_ = 0.0;
  double value_ = 0.0;
};

}  // namespace

std::optional<Oscillation> oscillation(std::span<const double> times,
                                       std::span<const double> values, double level,
                                       double hysteresis) {
  int crossings = 0;
  double first = 0.0, last = 0.0, sum_to_last = 0.0;
  bool below = false;
  Trapezoids sum;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (values[n] < level - hysteresis) below = true;
    if (n > 0 && below && values[n] >= level && values[n - 1] < level) {
      below = false;
      const double part = (level - values[n - 1]) / (values[n] - values[n - 1]);
      last = times[n - 1] + part * (times[n] - times[n - 1]);
      if (crossings++ == 0) {
        first = last;
        sum.start(last, level);
      } else {
        sum.add(last, level);
        sum_to_last = sum.sum();
      }
    }
    if (crossings > 0) sum.add(times[n], values[n]);
  }
  if (crossings < 2) return {};
  return Oscillation{(last - first) / (crossings - 1), sum_to_last / (last - first)};
}

}  // namespace perifrac
