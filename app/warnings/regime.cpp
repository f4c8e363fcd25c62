#include "app/warnings/regime.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "app/references/solutions/bisection.hpp"

namespace perifrac {

namespace {

double viscosity(const KgdProblem& driven) { return 12.0 * driven.viscosity; }  ///< mu'

/// int_0^1 (1 - s^(1/a))^(1/2) ds: leaked volume over 4 C' l t^(1/2) where l goes with t^a.
double leaked_share(double a) {
  return 0.5 * std::sqrt(M_PI) * std::tgamma(a + 1.0) / std::tgamma(a + 1.5);
}

/// Dry part of a crack without closing stress, by dimensionless toughness: tests/references/kgd.py
/// with --lag. Its logarithm goes straight.
double lag_without_stress(double toughness) {
  constexpr double table[][2] = {
      {0.35, 0.662}, {0.6, 0.4005}, {0.9, 0.1827}, {1.16, 0.0766}, {1.5, 0.01674}};
  const auto* after = std::find_if(std::begin(table) + 1, std::end(table) - 1,
                                   [&](const auto& row) { return row[0] > toughness; });
  const auto& [right, dry] = *after;
  const auto& [left, dry_left] = *(after - 1);
  const double share = (toughness - left) / (right - left);
  return std::min(dry_left * std::pow(dry / dry_left, share), 1.0);
}

}  // namespace

CrackSize viscosity_corner(const KgdProblem& driven, double t) {
  const double modulus = driven.plane_strain_modulus, mu = viscosity(driven);
  const double cube = std::pow(driven.rate, 3);
  return {.length = 0.6152 * std::pow(modulus * cube * std::pow(t, 4) / mu, 1.0 / 6.0),
          .opening = 1.1265 * std::pow(mu * cube * t * t / modulus, 1.0 / 6.0),
          .pressure = 0.5455 * std::cbrt(modulus * modulus * mu / t)};
}

CrackSize storage_solution(const KgdProblem& driven, double t) {
  const double toughness = driven.dimensionless_toughness();
  if (toughness < KgdSolution::least_toughness) return viscosity_corner(driven, t);
  if (toughness > KgdSolution::most_toughness) return toughness_corner(driven, t);
  const KgdSolution solution(driven);
  return {solution.length(t), solution.opening(t), solution.pressure(t)};
}

double leak_off_corner(const HydraulicFracture& fracture, double t) {
  return fracture.driven.rate * std::sqrt(t) / (2.0 * M_PI * fracture.leak_off_coefficient);
}

double leak_off_number(const HydraulicFracture& fracture, double t) {
  const KgdProblem& driven = fracture.driven;
  return 2.0 * fracture.leak_off_coefficient *
         std::pow(driven.plane_strain_modulus * t / (viscosity(driven) * std::pow(driven.rate, 3)),
                  1.0 / 6.0);
}

double efficiency(const HydraulicFracture& fracture, double t) {
  const KgdProblem& driven = fracture.driven;
  const double pumped = driven.rate * t;
  // Length goes with t^(1/2) where all leaks, with t^(2/3) where nothing does.
  const auto balance = [&](double kept) {
    const double length = storage_solution(driven, kept * t).length;
    const double leaked = 8.0 * fracture.leak_off_coefficient * length * std::sqrt(t) *
                          leaked_share(0.5 + kept / 6.0);
    return kept + leaked / pumped - 1.0;
  };
  return bisect(balance, 0.0, 1.0);
}

CrackSize expected_crack(const HydraulicFracture& fracture, double t) {
  return storage_solution(fracture.driven, efficiency(fracture, t) * t);
}

double lag_time(const HydraulicFracture& fracture) {
  if (fracture.closing_stress <= 0.0) return std::numeric_limits<double>::infinity();
  return viscosity(fracture.driven) * std::pow(fracture.driven.plane_strain_modulus, 2) /
         std::pow(fracture.closing_stress, 3);
}

double largest_lag(const HydraulicFracture& fracture, double t) {
  const double length = expected_crack(fracture, t).length;
  const double speed = 2.0 / 3.0 * length / t;
  return std::min(0.3574 * lag_time(fracture) * speed,
                  length * lag_without_stress(fracture.driven.dimensionless_toughness()));
}

double leak_off_over_toughness(const HydraulicFracture& fracture, double share, double t) {
  const double modulus = fracture.driven.plane_strain_modulus;
  const double leaking = std::pow(2.0 * fracture.leak_off_coefficient, 6);
  const double rate = share * fracture.driven.rate;
  return std::pow(modulus / fracture.driven.toughness(), 4) * leaking * t / (rate * rate);
}

std::string corner(double dimensionless_toughness, double efficiency) {
  constexpr double most = 0.75;
  std::string result = "viscosity and toughness; ";
  if (dimensionless_toughness < 0.7) result = "viscosity; ";
  if (dimensionless_toughness > 4.8) result = "toughness; ";
  if (efficiency > 0.98) return result + "storage";
  if (efficiency < 0.02) return result + "leak-off";
  if (efficiency >= most) return result + "mostly storage";
  return result + (efficiency <= 1.0 - most ? "mostly leak-off" : "storage and leak-off");
}

}  // namespace perifrac
