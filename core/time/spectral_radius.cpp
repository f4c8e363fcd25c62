#include "core/time/spectral_radius.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

double norm(std::span<const double> v) {
  double sum = 0.0;
  for (const double value : v) sum += value * value;
  return std::sqrt(sum);
}

}  // namespace

double spectral_radius(std::string_view field, double t, std::size_t size, std::size_t coupled,
                       const MatrixProduct& times) {
  constexpr int max_iterations = 500;
  constexpr int settled_iterations = 10;
  constexpr double tolerance = 1e-3;
  constexpr double margin = 1.02;
  std::vector<double> v(size, 0.0), product(size);
  // A fixed sequence without structure: it must hold a part of the fastest mode, whichever it is.
  std::uint32_t bits = 1;
  for (std::size_t i = 0; i < coupled; ++i) {
    bits = bits * 1664525u + 1013904223u;
    v[i] = static_cast<double>(bits >> 8) / (1u << 23) - 1.0;
  }
  double length = norm(v);
  double checked = 0.0;
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    for (double& value : v) value /= length;
    times(v, product);
    const double radius = norm(std::span(product).first(coupled));
    if (radius == 0.0) return 0.0;
    if (!std::isfinite(radius)) break;
    if (iteration % settled_iterations == 0) {
      if (std::abs(radius - checked) <= tolerance * radius) return margin * radius;
      checked = radius;
    }
    std::copy_n(product.begin(), coupled, v.begin());
    length = radius;
  }
  throw NumericalError(std::string(field), "the explicit integrator", t,
                       "the stable time step could not be found");
}

}  // namespace perifrac
