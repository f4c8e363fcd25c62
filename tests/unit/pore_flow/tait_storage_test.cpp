#include "modules/pore_flow/storage/tait_storage.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "modules/pore_flow/storage/linear_storage.hpp"

namespace perifrac {
namespace {

constexpr PoreFluid soft{
    .bulk_modulus = 22e6, .viscosity = 1e-3, .density = 1000.0, .tait_exponent = 7.5};
constexpr double alpha = 0.8, porosity = 0.3, grain_storage = 0.5 / 10e9;

PoreMaterials one_point(const PoreFluid& fluid) {
  return {{{alpha, porosity, grain_storage, porosity / fluid.bulk_modulus + grain_storage}}, {0}};
}

double density_ratio(double p) { return std::pow(1.0 + 7.5 * p / 22e6, 1.0 / 7.5); }

/// The definition of the fluid content, written down once more.
double content(double p, double dilatation) {
  return density_ratio(p) * (porosity + alpha * dilatation + grain_storage * p) - porosity;
}

TEST(PoreFluid, KnowsPotentialAndPressureOfTait) {
  for (const double p : {-2e6, -1.0, 0.0, 1e-3, 1e5, 5e6, 1e8}) {
    EXPECT_NEAR(soft.density_ratio(p), density_ratio(p), 1e-15 * density_ratio(p));
    EXPECT_NEAR(soft.pressure_of(soft.potential(p)), p, 1e-14 * std::abs(p));
    const double h = 1e-4 * (22e6 + p);
    const double slope = (soft.potential(p + h) - soft.potential(p - h)) / (2.0 * h);
    EXPECT_NEAR(slope, 1.0 / density_ratio(p), 1e-6) << "d(potential) = rho_0 / rho dp";
  }
  EXPECT_NEAR(soft.potential(1e-3), 1e-3, 1e-12) << "small pressures keep their digits";
  EXPECT_TRUE(std::isnan(soft.density_ratio(-4e6)));
}

TEST(TaitStorage, FindsThePressureToRounding) {
  for (const double slope : {0.0, 1e-9, 3e-8}) {
    TaitStorage storage(one_point(soft), soft);
    for (const double p : {-2e6, -10.0, 0.0, 1e3, 3e6, 2e7, 4e8}) {
      for (const double dilatation : {-0.02, 0.0, 0.05}) {
        const std::vector<double> value = {dilatation - slope * alpha * p - 0.01}, rate = {0.1};
        const std::vector<double> slopes = {slope}, zeta = {content(p, dilatation)};
        storage.set_dilatation({value, rate, slopes, 1.9});
        std::vector<double> found(1);
        storage.pressure(2.0, zeta, found);
        EXPECT_NEAR(found[0], p, 1e-7 + 1e-13 * std::abs(p)) << slope << " " << dilatation;
      }
    }
  }
}

/// Of pressures that are a part in 1e12 of the modulus: an implicit integrator takes noise for
/// something to resolve.
TEST(TaitStorage, KeepsTheDigitsOfSmallPressures) {
  for (const double slope : {0.0, 3e-8}) {
    TaitStorage storage(one_point(soft), soft);
    for (const double relative : {1e-12, -1e-12}) {
      const double p = relative * soft.bulk_modulus;
      const std::vector<double> value = {0.0}, rate = {0.0}, slopes = {slope};
      storage.set_dilatation({value, rate, slopes, 0.0});
      const double answer = porosity / soft.bulk_modulus + grain_storage + alpha * alpha * slope;
      std::vector<double> found(1);
      storage.pressure(0.0, std::vector<double>{answer * p}, found);
      EXPECT_NEAR(found[0] / p, 1.0, 1e-10) << slope;
    }
  }
}

TEST(TaitStorage, GivesItsDerivatives) {
  const std::vector<double> value = {0.01}, rate = {0.0}, slope = {2e-9};
  TaitStorage storage(one_point(soft), soft);
  storage.set_dilatation({value, rate, slope, 0.0});
  for (const double p : {-1e6, 0.0, 3e6, 2e7}) {
    const double h = 1e3;
    const auto fluid = [&](double at) { return content(at, value[0] + slope[0] * alpha * at); };
    const double by_pressure = (fluid(p + h) - fluid(p - h)) / (2.0 * h);
    const std::vector<double> zeta = {fluid(p)};
    const double by_potential = by_pressure * density_ratio(p);
    EXPECT_NEAR(storage.effective_storage(0.0, zeta)[0], by_potential, 1e-7 * by_potential);
  }
  const double at_rest = porosity / 22e6 + grain_storage + alpha * alpha * slope[0];
  EXPECT_NEAR(storage.effective_storage(0.0, {})[0], at_rest, 1e-12 * at_rest);
}

TEST(TaitStorage, AnswersDilatationUndrainedAndKeepsItsEnergy) {
  TaitStorage storage(one_point(soft), soft);
  for (const double p : {-1e6, 2e5, 3e6, 2e7}) {
    const double zeta = storage.content(0, p), h = 1e-6;
    EXPECT_NEAR(zeta, content(p, 0.0), 1e-15);
    const auto pressure_at = [&](double dilatation, double fluid) {
      const std::vector<double> value = {dilatation}, zero = {0.0}, content = {fluid};
      std::vector<double> found(1);
      TaitStorage moved(one_point(soft), soft);
      moved.set_dilatation({value, zero, {}, 0.0});
      moved.pressure(0.0, content, found);
      return found[0];
    };
    const double up = pressure_at(h, zeta), down = pressure_at(-h, zeta);
    const double slope = alpha * (up - down) / (2.0 * h);
    EXPECT_NEAR(storage.undrained_slope(0, zeta, p), slope, 1e-5 * std::abs(slope));
    const double by_dilatation =
        (storage.energy(0, zeta, up) - storage.energy(0, zeta, down)) / (2.0 * h);
    EXPECT_NEAR(by_dilatation, -alpha * p, 1e-5 * std::abs(p));
    const double by_fluid = (storage.energy(0, zeta + h, pressure_at(0.0, zeta + h)) -
                             storage.energy(0, zeta - h, pressure_at(0.0, zeta - h))) /
                            (2.0 * h);
    EXPECT_NEAR(by_fluid, soft.potential(p), 1e-5 * std::abs(p));
  }
}

/// zeta = S p + [(1 - gamma) phi / 2 + K_f grain_storage] (p / K_f)^2 + ...
TEST(TaitStorage, IsLinearToFirstOrderInPressure) {
  TaitStorage tait(one_point(soft), soft);
  LinearStorage linear(one_point(soft));
  const double second = (1.0 - 7.5) * porosity / 2.0 + 22e6 * grain_storage;
  for (const double relative : {1e-2, 1e-3, 1e-4}) {
    const double p = relative * 22e6;
    const double difference = tait.content(0, p) - linear.content(0, p);
    EXPECT_NEAR(difference / (relative * relative), second, 10.0 * relative);
  }
}

TEST(TaitStorage, HasNoPressureWhereThePoresRunDryOrClose) {
  TaitStorage storage(one_point(soft), soft);
  std::vector<double> found(1);
  storage.pressure(0.0, std::vector{-porosity}, found);
  EXPECT_TRUE(std::isnan(found[0]));
  PoreMaterials stiff_grains{{{alpha, porosity, 0.0, porosity / 22e6}}, {0}};
  TaitStorage closing(stiff_grains, soft);
  const std::vector<double> closed = {-0.5}, zero = {0.0};
  closing.set_dilatation({closed, zero, {}, 0.0});
  closing.pressure(0.0, zero, found);
  EXPECT_TRUE(std::isnan(found[0]));
}

}  // namespace
}  // namespace perifrac
