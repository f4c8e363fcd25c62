#include "core/time/spectral_radius.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/block_sum.hpp"
#include "core/base/errors.hpp"
#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {
namespace {

double norm(std::span<const double> v) {
  double sum = 0.0;
  for (const double value : v) sum += value * value;
  return std::sqrt(sum);
}

/// A fixed sequence: it must hold a part of the fastest mode, whichever it is.
void fill_without_structure(std::span<double> v) {
  std::uint32_t bits = 1;
  for (double& value : v) {
    bits = bits * 1664525u + 1013904223u;
    value = static_cast<double>(bits >> 8) / (1u << 23) - 1.0;
  }
}

}  // namespace

double spectral_radius(std::string_view field, double t, std::size_t size, std::size_t coupled,
                       const MatrixProduct& times) {
  constexpr int max_iterations = 500;
  constexpr int settled_iterations = 10;
  constexpr double tolerance = 1e-3;
  constexpr double margin = 1.02;
  std::vector<double> v(size, 0.0), product(size);
  fill_without_structure(std::span(v).first(coupled));
  double length = norm(v);
  double checked = 0.0, of_block = 0.0, largest = 0.0;
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    for (double& value : v) value /= length;
    times(v, product);
    const double radius = norm(std::span(product).first(coupled));
    if (radius == 0.0) return 0.0;
    if (!std::isfinite(radius)) break;
    of_block = std::max(of_block, radius);
    if (iteration % settled_iterations == 0) {
      if (std::abs(of_block - checked) <= tolerance * of_block) return margin * of_block;
      if (iteration > max_iterations / 2) largest = std::max(largest, of_block);
      checked = of_block;
      of_block = 0.0;
    }
    if (iteration == max_iterations) return margin * largest;
    std::copy_n(product.begin(), coupled, v.begin());
    length = radius;
  }
  throw NumericalError(std::string(field), "the explicit integrator", t,
                       "the stable time step could not be found");
}

double symmetric_spectral_radius(std::string_view field, double t, std::size_t size,
                                 const MatrixProduct& times, const MatrixProduct& divide) {
  constexpr int steps = 9;
  constexpr double settled = 1e-3;  // of the bound
  constexpr double margin = 1.02;
  std::vector<double> v(size), mv(size), last(size, 0.0), next(size);  // mv = M v
  std::vector<double> sums;
  const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
    return block_sum(static_cast<Index>(size), sums, [&](Index i) { return a[i] * b[i]; });
  };
  fill_without_structure(mv);
  divide(mv, v);
  double length = std::sqrt(dot(mv, v));
  if (length == 0.0) return 0.0;
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(steps, steps);
  double beside = 0.0;  // the part of the next vector in the last one's image
  for (int n = 0;; ++n) {
    for (std::size_t i = 0; i < size; ++i) {
      v[i] /= length;
      mv[i] /= length;
    }
    times(v, next);
    const double own = dot(v, next);
    for (std::size_t i = 0; i < size; ++i) next[i] -= own * mv[i] + beside * last[i];
    divide(next, v);
    projected(n, n) = own;
    beside = std::sqrt(dot(next, v));
    if (!std::isfinite(own) || !std::isfinite(beside)) break;
    const SymmetricSpectrum spectrum = symmetric_spectrum(projected.topLeftCorner(n + 1, n + 1));
    const double largest = spectrum.values[n];
    const double rest = beside * std::abs(spectrum.vectors(n, n));
    if (largest + rest <= 0.0) return 0.0;
    if (n + 1 == steps || rest <= settled * largest) return margin * (largest + rest);
    projected(n, n + 1) = projected(n + 1, n) = beside;
    last.swap(mv);
    mv.swap(next);
    length = beside;
  }
  throw NumericalError(std::string(field), "the explicit integrator", t,
                       "the stable time step could not be found");
}

double symmetric_spectral_radius(std::string_view field, double t, std::span<const double> mass,
                                 const MatrixProduct& times) {
  return symmetric_spectral_radius(field, t, mass.size(), times,
                                   [&](std::span<const double> mv, std::span<double> v) {
                                     for (std::size_t i = 0; i < mass.size(); ++i)
                                       v[i] = mv[i] / mass[i];
                                   });
}

}  // namespace perifrac
