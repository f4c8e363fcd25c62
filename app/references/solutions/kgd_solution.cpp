#include "app/references/solutions/kgd_solution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace perifrac {

namespace {

/// K_m and the factors of length, opening and pressure.
using Row = std::array<double, 4>;

/// tests/references/kgd.py, table_row(K_m).
constexpr Row by_toughness[] = {
    {0.15, 0.61540, 1.12565, 0.54486}, {0.3, 0.61504, 1.12595, 0.54506},
    {0.6, 0.61189, 1.12871, 0.54696},  {0.9, 0.60351, 1.13687, 0.55265},
    {1.16, 0.59104, 1.15068, 0.56261}, {1.5, 0.56779, 1.18123, 0.58582},
    {2, 0.52399, 1.25512, 0.64773},    {2.5, 0.47728, 1.35908, 0.74619},
    {3, 0.43427, 1.48172, 0.87677},    {3.5, 0.39723, 1.61277, 1.03177},
    {4, 0.36601, 1.74609, 1.20478},    {5, 0.31741, 2.00894, 1.58914},
    {6, 0.28175, 2.26136, 2.01082},
};

static_assert(by_toughness[0][0] == KgdSolution::least_toughness &&
              by_toughness[std::size(by_toughness) - 1][0] == KgdSolution::most_toughness);

/// A parabola through the three rows nearest to a toughness.
double interpolated(double toughness, std::size_t column) {
  const auto after =
      std::ranges::lower_bound(by_toughness, toughness, {}, [](const Row& r) { return r[0]; });
  const auto at = static_cast<std::size_t>(after - std::begin(by_toughness));
  const std::size_t first = std::clamp<std::size_t>(at, 2, std::size(by_toughness) - 1) - 2;
  double sum = 0.0;
  for (std::size_t i = first; i < first + 3; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + 3; ++j) {
      if (j != i)
        weight *= (toughness - by_toughness[j][0]) / (by_toughness[i][0] - by_toughness[j][0]);
    }
    sum += weight * by_toughness[i][column];
  }
  return sum;
}

}  // namespace

double KgdProblem::toughness() const {
  return std::sqrt(32.0 / M_PI * plane_strain_modulus * fracture_energy);
}

double KgdProblem::dimensionless_toughness() const {
  return toughness() / std::pow(12.0 * viscosity * rate * std::pow(plane_strain_modulus, 3), 0.25);
}

CrackSize toughness_corner(const KgdProblem& driven, double t) {
  const double modulus = driven.plane_strain_modulus;
  const double toughness = std::sqrt(modulus * driven.fracture_energy);
  const double length =
      std::pow(modulus * driven.rate * t / (2.0 * std::sqrt(M_PI) * toughness), 2.0 / 3.0);
  const double pressure = toughness / std::sqrt(M_PI * length);
  return {length, 4.0 * pressure * length / modulus, pressure};
}

KgdSolution::KgdSolution(const KgdProblem& problem)
    : problem_(problem), is_inviscid_(problem.viscosity == 0.0) {
  if (is_inviscid_) return;
  const double toughness = problem.dimensionless_toughness();
  if (!(toughness >= least_toughness && toughness <= most_toughness)) {
    throw std::domain_error(fmt::format("a dimensionless toughness of {:.3g}, outside {:g} to {:g}",
                                        toughness, least_toughness, most_toughness));
  }
  length_factor_ = interpolated(toughness, 1);
  opening_factor_ = interpolated(toughness, 2);
  pressure_factor_ = interpolated(toughness, 3);
}

double KgdSolution::length(double t) const {
  if (is_inviscid_) return toughness_corner(problem_, t).length;
  return length_factor_ * std::pow(problem_.plane_strain_modulus * std::pow(problem_.rate, 3) *
                                       std::pow(t, 4) / (12.0 * problem_.viscosity),
                                   1.0 / 6.0);
}

double KgdSolution::opening(double t) const {
  if (is_inviscid_) return toughness_corner(problem_, t).opening;
  const double small = 12.0 * problem_.viscosity / (problem_.plane_strain_modulus * t);
  return opening_factor_ / length_factor_ * std::cbrt(small) * length(t);
}

double KgdSolution::pressure(double t) const {
  if (is_inviscid_) return toughness_corner(problem_, t).pressure;
  const double small = 12.0 * problem_.viscosity / (problem_.plane_strain_modulus * t);
  return pressure_factor_ * problem_.plane_strain_modulus * std::cbrt(small);
}

}  // namespace perifrac
