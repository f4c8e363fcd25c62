#include "modules/solid/fracture/crack_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac {
namespace {

using test::CrackedPlate;

/// An arc of a circle under an even pressure of 1 (Cotterell & Rice 1980, without second order:
/// Muskhelishvili 1953).
struct Arc {
  double radius, half_angle;

  TipModes modes() const {
    const double half = std::sin(0.5 * half_angle);
    const double root = std::sqrt(M_PI * radius * std::sin(half_angle)) / (1.0 + half * half);
    return {root * std::cos(0.5 * half_angle), root * half};
  }
  /// From its left end to its right one, its middle in `top`.
  std::vector<CrackFacet<2>> facets(const Vector<2>& top, int count) const {
    std::vector<CrackFacet<2>> result;
    const auto at = [&](int k) {
      const double angle = half_angle * (2.0 * k / count - 1.0);
      return top + radius * Vector<2>{std::sin(angle), std::cos(angle) - 1.0};
    };
    for (int k = 0; k < count; ++k) result.push_back({at(k), at(k + 1)});
    return result;
  }
};

struct PressedCrack {
  CrackedPlate plate;
  std::vector<Vector<2>> jumps;

  /// Under a pressure of 1; far away as a straight crack of this half length opens the plate.
  PressedCrack(int n, const std::vector<CrackFacet<2>>& seeds, double half_length)
      : plate(n, seeds) {
    const test::ExactCrack far{
        plate.middle(),     0.0, half_length, 0.0, 0.0, 0.0, 1.0, plate.shear_modulus(),
        plate.poisson_ratio};
    const Eigen::VectorXd u = plate.solve(far);
    for (Index f = 0; f < static_cast<Index>(seeds.size()); ++f) {
      Vector<2> jump = plate.cracked->jump(f, {u.data(), static_cast<std::size_t>(u.size())});
      jump[0] += plate.cracked->pressed_by(f);
      jumps.push_back(jump);
    }
  }

  CrackTip tip(int end) const {
    const auto& facets = plate.cracked->facets();
    const Index last = end == 1 ? static_cast<Index>(facets.size()) - 1 : 0;
    const Vector<2> along = facets[last][1] - facets[last][0];
    return {facets[last][end], (end == 1 ? 1.0 : -1.0) / norm(along) * along, last, no_facet};
  }
  std::vector<Index> all() const {
    std::vector<Index> facets(plate.cracked->facets().size());
    std::iota(facets.begin(), facets.end(), 0);
    return facets;
  }
  CrackShape shape(int end) {
    const CrackTip at = tip(end);
    return crack_shape(*plate.cracked, at, all(), all(),
                       facets_near(*plate.cracked, all(), at.place), 1.0);
  }
  /// Of the jumps, where K_I by an even pressure is `even`.
  TipModes modes(int end, double even) {
    CrackShape its = shape(end);
    its.scale_to(even);
    return its.modes(stress_of(its, its, 1.0, jumps, {}, 0.9));
  }
};

TEST(CrackShape, IsNoLineWhereTheCrackTurns) {
  const PressedCrack line(40, test::straight_crack({20.0, 20.5}, 0.0, 8), 4.0);
  EXPECT_TRUE(is_line(*line.plate.cracked, line.tip(1), line.all()));
  const PressedCrack arc(40, Arc{15.0, 0.6}.facets({20.0, 20.5}, 18), 9.0);
  EXPECT_FALSE(is_line(*arc.plate.cracked, arc.tip(1), arc.all()));
}

TEST(CrackShape, KnowsAnArcUnderEvenPressure) {
  for (const double half_angle : {0.3, 0.6, 0.9}) {
    const Arc arc{9.0 / half_angle, half_angle};
    PressedCrack crack(40, arc.facets({20.0, 20.5}, 18), 9.0);
    const double exact = ratio_of(arc.modes());
    EXPECT_NEAR(ratio_of(crack.shape(1).under_pressure()), -exact, 0.025 * exact) << half_angle;
    EXPECT_NEAR(ratio_of(crack.shape(0).under_pressure()), exact, 0.025 * exact) << half_angle;
  }
}

/// Far away the plate moves as by a straight crack of this arc's half length; at rest there, as the
/// shape sees it, it is 2 % stiffer.
TEST(CrackShape, FindsTheIntensitiesOfAnArcInItsJumps) {
  const Arc arc{15.0, 0.6};
  PressedCrack crack(140, arc.facets({70.0, 70.9}, 18), arc.radius * std::sin(arc.half_angle));
  for (const int end : {0, 1}) {
    const TipModes found = crack.modes(end, arc.modes().opening);
    EXPECT_NEAR(found.opening / arc.modes().opening, 1.0, 0.03) << end;
    EXPECT_NEAR(found.sliding / arc.modes().sliding, end == 1 ? -1.0 : 1.0, 0.045) << end;
  }
}

/// A leg of two facets beyond a kink of 45 degrees, upwards and downwards.
TEST(CrackShape, KnowsAKinkWhicheverWayItTurns) {
  std::vector<double> ratios;
  for (const double sign : {-1.0, 1.0}) {
    std::vector<CrackFacet<2>> facets = test::straight_crack({69.3, 69.5}, 0.0, 12);
    const Vector<2> leg = {std::sqrt(0.5), sign * std::sqrt(0.5)};
    for (int k = 0; k < 2; ++k) facets.push_back({facets.back()[1], facets.back()[1] + leg});
    PressedCrack crack(140, facets, 6.7);
    const double even = ratio_of(crack.shape(1).under_pressure());
    EXPECT_NEAR(ratio_of(crack.modes(1, 1.0)), even, 0.03 * std::abs(even));
    ratios.push_back(even);
  }
  EXPECT_GT(ratios[1], 0.3);
  EXPECT_NEAR(ratios[0], -ratios[1], 1e-9);
}

/// On a lattice faces of oblique rows part where they slide: a fit to how an infinite body's do
/// would see that as a mode.
TEST(CrackShape, KnowsTheTeethOfItsRows) {
  for (const double angle : {0.3, 0.7}) {
    const auto turned = [&](double a) { return Vector<2>{std::cos(a), std::sin(a)}; };
    std::vector<CrackFacet<2>> facets = test::straight_crack({30.2, 30.1}, angle, 10);
    for (int k = 0; k < 3; ++k) {
      facets.push_back({facets.back()[1], facets.back()[1] + turned(angle - 0.5)});
    }
    PressedCrack crack(60, facets, 6.0);
    std::vector<Vector<2>> tractions;
    const double xx = 0.3, yy = 1.0, xy = -0.4;
    for (const FaceJump<2>& face : crack.plate.cracked->jumps()) {
      const Vector<2>& n = face.normal;
      const Vector<2> on = {xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]};
      tractions.push_back({dot(n, on), dot(face.tangents[0], on)});
    }
    const CrackShape shape = crack.shape(1);
    const Eigen::Vector3d found =
        stress_of(shape, shape, 1.0, crack.plate.cracked->jumps_by(tractions), {}, 0.5);
    EXPECT_NEAR(found[0], xx, 1e-8);
    EXPECT_NEAR(found[1], yy, 1e-8);
    EXPECT_NEAR(found[2], xy, 1e-8);
  }
}

}  // namespace
}  // namespace perifrac
