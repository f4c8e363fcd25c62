#include "modules/solid/fracture/crack_nucleation.hpp"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

/// A plate of 40 x 40 spacings with E' = 1, whose rock bears 1e-3 and has a length
/// E' Gc / strength^2 of so many spacings, under a stress that a test gives.
struct StressedPlate {
  CrackedPlate plate;
  CrackNucleation nucleation;

  explicit StressedPlate(double length, std::vector<CrackFacet<2>> seeds = {},
                         const TensileStrength<2>& strength = {{1e-3}})
      : plate(40, std::move(seeds)),
        nucleation(*plate.body, *plate.cracked, {{length * 1e-6}}, strength) {}

  /// xx, yy, xy at a place.
  double readiness(const std::function<std::array<double, 3>(const Vector<2>&)>& at) {
    const Points<2>& points = plate.body->points();
    std::vector<double> stress(4 * points.size());
    for (Index i = 0; i < points.size(); ++i) {
      const auto [xx, yy, xy] = at(points.at(i));
      const std::array components = {xx, xy, xy, yy};
      for (int k = 0; k < 4; ++k) stress[k * points.size() + i] = components[k];
    }
    return nucleation.find_readiness(stress);
  }
};

double length_of(std::span<const CrackFacet<2>> facets) {
  double sum = 0.0;
  for (const CrackFacet<2>& facet : facets) sum += area<2>(facet);
  return sum;
}

/// Bending: s (1 - 2 y / h) along x has a mean of s (1 - l / h) over the edge nucleus of length l,
/// which goes straight up from the face, half-way between columns.
TEST(CrackNucleation, BeginsAtAFaceByTheMeanOverTheNucleus) {
  const auto bending = [](double s) {
    return [s](const Vector<2>& x) {
      // Largest at one column, so that no column is as good as another.
      return std::array{s * (1.0 - x[1] / 20.0) * (1.0 - 1e-6 * std::abs(x[0] - 14.5)), 0.0, 0.0};
    };
  };
  // 0.5062 of them is 4.02, and 6.99.
  for (const auto& [length, count] : {std::pair{7.95, 5}, {13.8, 7}}) {
    StressedPlate body(length);
    EXPECT_NEAR(body.readiness(bending(1e-3)), 1.0 - count / 40.0, 7e-7);
    EXPECT_NEAR(body.readiness(bending(2e-3)), 2.0 * (1.0 - count / 40.0), 1.4e-6);
    EXPECT_NEAR(body.nucleation.cut(), count * length * 1e-6, 1e-12);
    const auto facets = body.plate.cracked->facets();
    ASSERT_EQ(std::ssize(facets), count);
    EXPECT_NEAR(facets.front()[0][1], 0.0, 1e-9);
    EXPECT_NEAR(facets.back()[1][1], count, 1e-9);
    for (const auto& facet : facets) {
      EXPECT_NEAR(std::abs(facet[0][0] - 14.5), 0.5, 1e-6);
      EXPECT_NEAR(facet[1][0], facet[0][0], 1e-6);
    }
  }
}

/// Of places that are as ready but for rounding one is chosen, whatever the rounding, and the
/// nucleus that opens to a face, which is shorter.
TEST(CrackNucleation, DoesNotHangOnRounding) {
  std::vector<CrackFacet<2>> chosen;
  for (const int seed : {1, 2, 3}) {
    StressedPlate body(8.0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-1e-12, 1e-12);
    const auto uniform = [&](const Vector<2>&) {
      return std::array{1e-3 * (1.0 + noise(random)), 1e-3 * noise(random), 1e-3 * noise(random)};
    };
    EXPECT_NEAR(body.readiness(uniform), 1.0, 1e-6);
    EXPECT_NEAR(body.nucleation.cut(), 5.0 * 8e-6, 1e-12);
    const auto facets = body.plate.cracked->facets();
    if (chosen.empty()) chosen.assign(facets.begin(), facets.end());
    ASSERT_EQ(facets.size(), chosen.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      EXPECT_NEAR(facets[f][1][0], chosen[f][1][0], 1e-9) << seed;
      EXPECT_NEAR(facets[f][1][1], chosen[f][1][1], 1e-9) << seed;
    }
  }
}

/// Inside, normal to the largest principal stress, wherever that points; as long as it pays for.
TEST(CrackNucleation, LiesNormalToTheLargestStress) {
  for (const double angle : {0.0, 0.3, -1.0}) {
    StressedPlate body(8.0);  // 1.2732 * 8 = 10.2: 11 facets
    const double c = std::cos(angle), s = std::sin(angle);
    const auto there = [&](const Vector<2>& x) {
      const double away = std::hypot(x[0] - 20.5, x[1] - 20.5);
      const double t = 1e-3 * (1.0 - 1e-6 * away);
      return std::array{c * c * t, s * s * t, s * c * t};
    };
    EXPECT_NEAR(body.readiness(there), 1.0, 4.5e-6);
    body.nucleation.cut();
    const auto facets = body.plate.cracked->facets();
    EXPECT_NEAR(length_of(facets), 11.0, 1e-9);
    for (const CrackFacet<2>& facet : facets) {
      EXPECT_NEAR(frame<2>(facet)[0][0] * s - frame<2>(facet)[0][1] * c, 0.0, 1e-6) << angle;
      EXPECT_LE(std::hypot(middle<2>(facet)[0] - 20.5, middle<2>(facet)[1] - 20.5), 6.0);
    }
  }
}

/// Where tips decide nothing begins: the whole rest of the plate does.
TEST(CrackNucleation, KeepsAwayFromCracks) {
  const auto seeds = straight_crack({20.0, 20.0}, 0.0, 10);
  const auto beside = [](const Vector<2>& x) {
    const bool is_near = std::abs(x[1] - 20.0) < 3.0 && std::abs(x[0] - 20.0) < 8.0;
    return std::array{0.0, is_near ? 1e-2 : 1e-4, 0.0};
  };
  EXPECT_NEAR(StressedPlate(4.0, seeds).readiness(beside), 0.1, 0.01);
  EXPECT_GT(StressedPlate(4.0).readiness(beside), 5.0);
}

/// Nothing in a body under pressure, and in a weak part by that part's strength.
TEST(CrackNucleation, FollowsTheRock) {
  const auto uniform = [](double stress) {
    return [stress](const Vector<2>&) { return std::array{stress, stress, 0.0}; };
  };
  StressedPlate body(6.0);
  EXPECT_EQ(body.readiness(uniform(-1e-3)), 0.0);
  EXPECT_EQ(body.nucleation.cut(), 0.0);
  TensileStrength<2> strength{{1e-3}};
  strength.by_region.inside.emplace_back(Region<2>{.name = "weak", .from = {0, 10}, .to = {40, 20}},
                                         0.8e-3);
  StressedPlate weak(6.0, {}, strength);
  const auto tension = [](const Vector<2>&) { return std::array{0.0, 0.8e-3, 0.0}; };
  EXPECT_NEAR(weak.readiness(tension), 1.0, 1e-12);
  weak.nucleation.cut();
  for (const auto& facet : weak.plate.cracked->facets()) {
    EXPECT_GT(facet[0][1], 10.0);
    EXPECT_LT(facet[0][1], 20.0);
  }
}

}  // namespace
}  // namespace perifrac::test
