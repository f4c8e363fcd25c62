#include "app/study/orders.hpp"

#include <cmath>

namespace perifrac {

namespace {

bool usable(double value) { return value > 0.0 && std::isfinite(value); }

}  // namespace

std::optional<double> power(std::span<const double> x, std::span<const double> y) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!usable(x[i]) || !usable(y[i])) continue;
    const double u = std::log(x[i]), v = std::log(y[i]);
    n += 1.0;
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  const double spread = n * sxx - sx * sx;
  if (n < 2.0 || spread <= 1e-12 * n * sxx) return {};
  return (n * sxy - sx * sy) / spread;
}

std::vector<double> crossings(std::span<const double> x, std::span<const double> a,
                              std::span<const double> b, double blur) {
  std::vector<double> places;
  double last_x = 0.0, last_gap = 0.0;
  bool begun = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!usable(x[i]) || !usable(a[i]) || !usable(b[i])) continue;
    const double at = std::log(x[i]), gap = std::log(a[i] / b[i]);
    if (std::abs(gap) <= std::log(blur)) continue;  // the next one says whether it crosses
    if (begun && (gap > 0.0) != (last_gap > 0.0)) {
      places.push_back(std::exp(last_x + (at - last_x) * last_gap / (last_gap - gap)));
    }
    last_x = at;
    last_gap = gap;
    begun = true;
  }
  return places;
}

std::optional<Extrapolation> extrapolate(double coarse, double fine, double ratio) {
  if (!usable(coarse) || !usable(fine) || !(ratio > 1.0) || fine >= coarse) return {};
  const double order = std::log(coarse / fine) / std::log(ratio);
  return Extrapolation{order, 1.0 / (std::pow(ratio, order) - 1.0)};
}

}  // namespace perifrac
