#include "modules/solid/fracture/crack_tips.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

/// A plate whose cracks are under a pressure of 1, and their tips.
struct PressedPlate {
  CrackedPlate plate;
  CrackTips tips;
  Eigen::VectorXd u, opening;
  std::vector<double> viscosity;

  /// As if the plate went on for ever around a straight crack of this length.
  PressedPlate(int n, std::vector<CrackFacet<2>> seeds, double fracture_energy, double length)
      : plate(n, std::move(seeds)), tips(*plate.body, *plate.cracked, {{fracture_energy}}) {
    tips.start(plate.cracked->facets(), 0.0);
    u = plate.solve(ExactCrack{plate.middle(), 0.0, 0.5 * length, 0.0, 0.0, 0.0, 1.0,
                               plate.shear_modulus(), plate.poisson_ratio});
    opening = plate.cracked->faces(plate.pressure).opening;
  }

  /// A moment after the tips came to where they are.
  CrackState<2> state() {
    return {.t = 1e-9,
            .opening = opening,
            .pressure = plate.pressure,
            .viscosity = viscosity,
            .leak_off = {},
            .pore_stress = {},
            .unknowns = [this](auto) { return std::span<const double>(u.data(), u.size()); },
            // Straight on.
            .jumps =
                [this] {
                  return std::vector<Vector<2>>(opening.size(), {1.0, 0.0});
                }};
  }
};

/// Pressure that ends a facet short of both tips makes K_I = p sqrt(pi a) 2 / pi asin(1 - d / a).
TEST(CrackTips, LeaveTheirFluidBehindWhereAnEmptyLastFacetWouldLetThemGoOn) {
  const int count = 20;
  const double fracture_energy = 10.0, a = 0.5 * count;
  PressedPlate rock(60, straight_crack({30.0, 30.0}, 0.0, count), fracture_energy, count);
  rock.viscosity.assign(count, 1.0);
  const double lagging = rock.tips.find_readiness(rock.state()) * std::sqrt(fracture_energy);
  const double exact = std::sqrt(M_PI * a) * 2.0 / M_PI * std::asin(1.0 - 1.0 / a);
  EXPECT_NEAR(lagging, exact, 0.009 * exact);
}

/// A crack ahead ends this far beside where the next facet would.
Vector<2> goes_to(double beside) {
  std::vector<CrackFacet<2>> seeds = straight_crack({16.0, 20.0}, 0.0, 8);
  for (const auto& facet : straight_crack({21.0, 23.0 + beside}, M_PI / 2.0, 6)) {
    seeds.push_back(facet);
  }
  PressedPlate rock(40, seeds, 1e-9, 8.0);
  EXPECT_GE(rock.tips.find_readiness(rock.state()), ready);
  rock.tips.grow(rock.state());
  for (const CrackFacet<2>& facet : rock.plate.cracked->facets().subspan(seeds.size())) {
    if (std::hypot(facet[0][0] - 20.0, facet[0][1] - 20.0) < 1e-9) return facet[1];
  }
  return {};
}

TEST(CrackTips, EndWhereAnotherCrackDoesWithinThreeQuartersOfASpacing) {
  EXPECT_NEAR(goes_to(0.74)[1], 20.74, 1e-9);
  EXPECT_NEAR(goes_to(0.76)[1], 20.0, 1e-9);
}

}  // namespace
}  // namespace perifrac::test
