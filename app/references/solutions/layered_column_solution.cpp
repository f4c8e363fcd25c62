#include "app/references/solutions/layered_column_solution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/references/solutions/bisection.hpp"

namespace perifrac {

namespace {

// Enough for times from 1e-6 of the slowest mode's on.
constexpr int column_modes = 1000;

}  // namespace

LayeredColumnSolution::LayeredColumnSolution(const ColumnLayer& lower, const ColumnLayer& upper,
                                             double load)
    : layer_{lower, upper}, load_(load) {
  for (int l = 0; l < 2; ++l) {
    const double alpha = layer_[l].biot_coefficient;
    capacity_[l] = layer_[l].storage + alpha * alpha / layer_[l].uniaxial_modulus;
    root_diffusivity_[l] = std::sqrt(layer_[l].mobility / capacity_[l]);
    initial_pressure_[l] = alpha * load / (layer_[l].uniaxial_modulus * capacity_[l]);
  }
  // The condition changes sign once between multiples of this.
  const double apart = std::numbers::pi / (layer_[0].thickness / root_diffusivity_[0] +
                                           layer_[1].thickness / root_diffusivity_[1]);
  for (int n = 0; n < column_modes; ++n) {
    add_mode(
        bisect([this](double s) { return frequency_condition(s); }, n * apart, (n + 1) * apart));
  }
}

/// A mode is A cos(q z) in the lower layer and B sin(q (H - z)) in the upper, q = s / sqrt(c): zero
/// where pressure and flux, mobility times slope, can both be continuous.
double LayeredColumnSolution::frequency_condition(double rate) const {
  const double below = rate * layer_[0].thickness / root_diffusivity_[0];
  const double above = rate * layer_[1].thickness / root_diffusivity_[1];
  return layer_[0].mobility / root_diffusivity_[0] * std::sin(below) * std::sin(above) -
         layer_[1].mobility / root_diffusivity_[1] * std::cos(below) * std::cos(above);
}

void LayeredColumnSolution::add_mode(double rate) {
  const std::array<double, 2> q{rate / root_diffusivity_[0], rate / root_diffusivity_[1]};
  const double below = q[0] * layer_[0].thickness;
  const double above = q[1] * layer_[1].thickness;
  // Either continuity fixes A : B, unless it is empty there: then the other does.
  const std::array<double, 2> by_pressure{std::sin(above), std::cos(below)};
  const std::array<double, 2> by_flux{layer_[1].mobility * q[1] * std::cos(above),
                                      layer_[0].mobility * q[0] * std::sin(below)};
  const double scale = std::max(layer_[0].mobility * q[0], layer_[1].mobility * q[1]);
  const bool flux =
      std::hypot(by_flux[0], by_flux[1]) > scale * std::hypot(by_pressure[0], by_pressure[1]);
  const std::array<double, 2> shape = flux ? by_flux : by_pressure;
  // The initial pressures projected on the mode, with the capacity as weight.
  const double start =
      capacity_[0] * initial_pressure_[0] * shape[0] * std::sin(below) / q[0] +
      capacity_[1] * initial_pressure_[1] * shape[1] * (1.0 - std::cos(above)) / q[1];
  const double norm =
      capacity_[0] * shape[0] * shape[0] * (0.5 * below + 0.25 * std::sin(2.0 * below)) / q[0] +
      capacity_[1] * shape[1] * shape[1] * (0.5 * above - 0.25 * std::sin(2.0 * above)) / q[1];
  rate_.push_back(rate);
  amplitude_.push_back({shape[0] * start / norm, shape[1] * start / norm});
}

double LayeredColumnSolution::pressure(double z, double t) const {
  const bool lower = z < layer_[0].thickness;
  if (t <= 0.0) return initial_pressure_[lower ? 0 : 1];
  double sum = 0.0;
  for (std::size_t n = 0; n < rate_.size(); ++n) {
    const double decay = std::exp(-rate_[n] * rate_[n] * t);
    if (decay == 0.0) break;
    sum += decay *
           (lower ? amplitude_[n][0] * std::cos(rate_[n] / root_diffusivity_[0] * z)
                  : amplitude_[n][1] * std::sin(rate_[n] / root_diffusivity_[1] * (height() - z)));
  }
  return sum;
}

double LayeredColumnSolution::drained_displacement(double z) const {
  const double below = std::min(z, layer_[0].thickness);
  return -load_ * (below / layer_[0].uniaxial_modulus + (z - below) / layer_[1].uniaxial_modulus);
}

double LayeredColumnSolution::displacement(double z, double t) const {
  const double below = std::min(z, layer_[0].thickness);
  const double compliance_0 = layer_[0].biot_coefficient / layer_[0].uniaxial_modulus;
  const double compliance_1 = layer_[1].biot_coefficient / layer_[1].uniaxial_modulus;
  if (t <= 0.0) {
    return drained_displacement(z) + compliance_0 * initial_pressure_[0] * below +
           compliance_1 * initial_pressure_[1] * (z - below);
  }
  double swelling = 0.0;  // what pore pressure makes, layer by layer
  for (std::size_t n = 0; n < rate_.size(); ++n) {
    const double decay = std::exp(-rate_[n] * rate_[n] * t);
    if (decay == 0.0) break;
    const double q_0 = rate_[n] / root_diffusivity_[0];
    const double q_1 = rate_[n] / root_diffusivity_[1];
    swelling += decay * compliance_0 * amplitude_[n][0] * std::sin(q_0 * below) / q_0;
    if (z > below) {
      swelling += decay * compliance_1 * amplitude_[n][1] *
                  (std::cos(q_1 * (height() - z)) - std::cos(q_1 * layer_[1].thickness)) / q_1;
    }
  }
  return drained_displacement(z) + swelling;
}

}  // namespace perifrac
