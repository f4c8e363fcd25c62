#include "app/references/solutions/slab_inflow.hpp"

#include <cmath>
#include <numbers>

namespace perifrac::slab_inflow {

namespace {

// From here on the series needs fewer terms than the images; both give all digits with 12.
constexpr double long_time = 0.2;
constexpr int terms = 12;

/// The complementary error function, integrated k times from x to infinity; k = -1: its derivative.
double repeated_erfc(int k, double x) {
  if (k == -1) return 2.0 / std::sqrt(std::numbers::pi) * std::exp(-x * x);
  if (k == 0) return std::erfc(x);
  return (repeated_erfc(k - 2, x) - 2.0 * x * repeated_erfc(k - 1, x)) / (2.0 * k);
}

/// At a distance a from the face of a half space: the function of T with the Laplace transform
/// exp(-a sqrt(s)) / s^(1 + k/2).
double half_space(int k, double a, double T) {
  return std::pow(4.0 * T, 0.5 * k) * repeated_erfc(k, 0.5 * a / std::sqrt(T));
}

double images(int k, double xi, double T) {
  double sum = 0.0;
  for (int n = 0; n < terms; ++n) {
    sum += half_space(k, 2 * n + 1 - xi, T) - half_space(k, 2 * n + 1 + xi, T);
  }
  return sum;
}

double inflow_images(int k, double T) {
  double sum = half_space(k, 0.0, T);
  for (int n = 1; n < terms; ++n) sum += 2.0 * half_space(k, 2 * n, T);
  return sum;
}

/// What decays: the sum over m = n pi of 2 (-1)^n sin(m xi) / m^power exp(-m^2 T).
double modes(int power, double xi, double T) {
  double sum = 0.0;
  for (int n = 1; n <= terms; ++n) {
    const double m = n * std::numbers::pi;
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    sum += 2.0 * sign * std::sin(m * xi) / std::pow(m, power) * std::exp(-m * m * T);
  }
  return sum;
}

/// The same of 2 / m^power exp(-m^2 T).
double inflow_modes(int power, double T) {
  double sum = 0.0;
  for (int n = 1; n <= terms; ++n) {
    const double m = n * std::numbers::pi;
    sum += 2.0 / std::pow(m, power) * std::exp(-m * m * T);
  }
  return sum;
}

}  // namespace

double value(double xi, double T) {
  if (T <= 0.0) return 0.0;
  return T > long_time ? xi + modes(1, xi, T) : images(0, xi, T);
}

double value_integral(double xi, double T) {
  if (T <= 0.0) return 0.0;
  if (T <= long_time) return images(2, xi, T);
  return xi * T + (xi * xi * xi - xi) / 6.0 - modes(3, xi, T);
}

double inflow(double T) {
  if (T <= 0.0) return 0.0;
  return T > long_time ? T + 1.0 / 3.0 - inflow_modes(2, T) : inflow_images(1, T);
}

double inflow_integral(double T) {
  if (T <= 0.0) return 0.0;
  if (T <= long_time) return inflow_images(3, T);
  return 0.5 * T * T + T / 3.0 - 1.0 / 45.0 + inflow_modes(4, T);
}

}  // namespace perifrac::slab_inflow
