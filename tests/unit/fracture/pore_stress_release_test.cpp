#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

constexpr int n = 60, half = 10;

/// J at the tip that grows, by domain integral.
double release(CrackedPlate& plate, const std::vector<double>& pore_stress, double angle,
               double half_length, const Eigen::VectorXd& u) {
  const ExactCrack crack{
      plate.middle(),     angle, half_length, 0.0, 0.0, 0.0, 0.0, plate.shear_modulus(),
      plate.poisson_ratio};
  return EnergyRelease(*plate.cracked, 1.0)
      .at(plate.tip(crack, 1), {u.data(), static_cast<std::size_t>(u.size())}, plate.pressure,
          pore_stress)
      .energy_release;
}

/// A pore stress that is least on the crack and grows along it.
std::vector<double> trough(const CrackedPlate& plate, double angle, double size, double rise) {
  std::vector<double> pore_stress;
  for (Index i = 0; i < plate.family->point_count; ++i) {
    const Vector<2> x = plate.body->points().at(i);
    const double dx = x[0] - 0.5 * n, dy = x[1] - 0.5 * n;
    const double s = std::cos(angle) * dx + std::sin(angle) * dy;
    const double t = -std::sin(angle) * dx + std::cos(angle) * dy;
    pore_stress.push_back(size * (1.0 - 0.8 * std::exp(-t * t / 32.0)) * (1.0 + rise * s));
  }
  return pore_stress;
}

/// J over ten spacings of growth, against what these take off the potential energy.
void expect_release_of_growth(double angle, double size, double rise, double face_pressure,
                              Rock rock) {
  constexpr int steps = 10;
  CrackedPlate plate(n, straight_crack({0.5 * n, 0.5 * n}, angle, 2 * half), 0.25, nullptr, {},
                     rock);
  const std::vector<double> pore_stress = trough(plate, angle, size, rise);
  double first_energy = 0.0, energy = 0.0, sum = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const auto longer = straight_crack({0.5 * n, 0.5 * n}, angle, 2 * (half + k));
    if (k > 0) {
      ASSERT_TRUE(plate.cracked->cut(longer.back()));
    }
    const Eigen::VectorXd u = plate.solve(pore_stress, face_pressure);
    energy = plate.potential_energy({u.data(), static_cast<std::size_t>(u.size())}, pore_stress);
    if (k == 0) first_energy = energy;
    sum += (k == 0 || k == steps ? 0.5 : 1.0) * release(plate, pore_stress, angle, half + k, u);
  }
  EXPECT_NEAR(sum, first_energy - energy, (rock == Rock::lps ? 0.04 : 0.03) * sum)
      << angle << " " << rise << " " << face_pressure << " " << name(rock);
}

TEST(PoreStressRelease, IsThePotentialEnergyThatGrowthTakes) {
  for (const Rock rock : rocks) {
    for (const double angle : {0.0, M_PI / 4.0}) {
      for (const double rise : {0.0, 0.08}) {
        expect_release_of_growth(angle, 1e-3, rise, 0.0, rock);
        expect_release_of_growth(angle, -1e-3, rise, 2e-3, rock);
      }
    }
  }
}

/// Growth through intact rock that nothing cuts sets nothing free: what grad a does there is the
/// other half of what the strains around it say.
TEST(PoreStressRelease, IsNoneWhereThereIsNoCrack) {
  CrackedPlate plate(n, {});
  const double rise = 0.03;
  std::vector<double> pore_stress;
  for (Index i = 0; i < plate.family->point_count; ++i) {
    const Vector<2> x = plate.body->points().at(i);
    pore_stress.push_back(1e-3 * (1.0 + rise * (x[0] - 0.5 * n)) *
                          std::exp(-0.005 * std::pow(x[1] - 0.5 * n, 2)));
  }
  const Eigen::VectorXd u = plate.solve(pore_stress, 0.0);
  const double j = release(plate, pore_stress, 0.0, 0.0, u);
  std::vector<double> force(u.size()), theta(plate.family->point_count);
  plate.elastic->apply({u.data(), static_cast<std::size_t>(u.size())}, {}, force, theta);
  const auto middle = static_cast<std::size_t>(n / 2 * n + n / 2);
  // q is 1 within a spacing and falls to 0 at 4.5.
  const double by_gradient = theta[middle] * 1e-3 * rise * M_PI * 2.75 * 2.75;
  ASSERT_GT(by_gradient, 0.0);
  EXPECT_NEAR(j / by_gradient, 0.0, 0.08);
}

}  // namespace
}  // namespace perifrac::test
