#include "modules/solid/fracture/tip_law.hpp"

#include <cmath>

namespace perifrac {

namespace {

/// int_1^w x^3 / (x + b) dx by Simpson's rule: in closed form the digits cancel where b is large.
double integral(double w, double b) {
  constexpr int pairs = 32;
  const double h = 0.5 * (w - 1.0) / pairs;
  const auto at = [&](int k) {
    const double x = 1.0 + k * h;
    return x * x * x / (x + b);
  };
  double sum = 0.0;
  for (int k = 0; k < 2 * pairs; k += 2) sum += at(k) + 4.0 * at(k + 1) + at(k + 2);
  return h / 3.0 * sum;
}

/// The w above 1 where that integral is a / 3. It is convex in w, so that Newton's method gets
/// there.
double joined(double a, double b) {
  double w = std::cbrt(1.0 + a);
  if (b == 0.0 || !std::isfinite(w)) return w;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double change = (integral(w, b) - a / 3.0) * (w + b) / (w * w * w);
    w -= change;
    if (std::abs(change) <= 1e-12 * w) break;
  }
  return w;
}

}  // namespace

double TipLaw::toughness() const { return std::sqrt(plane_strain_modulus * fracture_energy); }

double TipLaw::opening(double s, double viscous_s, const TipFluid& fluid, double speed) const {
  const double stiffness = plane_strain_modulus / (std::sqrt(32.0 / M_PI) * toughness());  // E'/K'
  const double dry = std::sqrt(s) / stiffness;
  const double wet = 2.0 * std::pow(3.0, 2.5) * 12.0 * fluid.viscosity * speed /
                     plane_strain_modulus * viscous_s * viscous_s;
  // (16 / 3.75) tan(3 pi / 8) / (6 sqrt(3)), of the two asymptotes of viscosity; C' = 2 C_L.
  const double leaks = 0.99117 * 4.0 * fluid.leak_off_coefficient * stiffness / std::sqrt(speed);
  return dry * joined(wet / (dry * dry * dry), leaks);
}

}  // namespace perifrac
