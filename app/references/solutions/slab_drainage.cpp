#include "app/references/solutions/slab_drainage.hpp"

#include <cmath>
#include <numbers>

namespace perifrac::slab_drainage {

namespace {

// From here on the series needs fewer terms than the images; both give all digits with 12.
constexpr double long_time = 0.2;
constexpr int terms = 12;

double sign(int n) { return n % 2 == 0 ? 1.0 : -1.0; }

/// Integral of erfc from x to infinity.
double ierfc(double x) { return std::exp(-x * x) / std::sqrt(std::numbers::pi) - x * std::erfc(x); }

}  // namespace

double value(double xi, double T) {
  if (T <= 0.0) return 1.0;
  double sum = 0.0;
  for (int n = 0; n < terms; ++n) {
    const double m = (n + 0.5) * std::numbers::pi;
    const double width = 2.0 * std::sqrt(T);
    sum += sign(n) * (T > long_time ? 2.0 / m * std::cos(m * xi) * std::exp(-m * m * T)
                                    : std::erfc((2 * n + 1 - xi) / width) +
                                          std::erfc((2 * n + 1 + xi) / width));
  }
  return T > long_time ? sum : 1.0 - sum;
}

double integral(double xi, double T) {
  if (T <= 0.0) return xi;
  double sum = 0.0;
  for (int n = 0; n < terms; ++n) {
    const double m = (n + 0.5) * std::numbers::pi;
    const double width = 2.0 * std::sqrt(T);
    sum += sign(n) * (T > long_time ? 2.0 / (m * m) * std::sin(m * xi) * std::exp(-m * m * T)
                                    : width * (ierfc((2 * n + 1 - xi) / width) -
                                               ierfc((2 * n + 1 + xi) / width)));
  }
  return T > long_time ? sum : xi - sum;
}

}  // namespace perifrac::slab_drainage
