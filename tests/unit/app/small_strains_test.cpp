#include "app/warnings/small_strains.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

/// Of u = G x on a lattice.
LargestStrain strain_of(const std::array<double, 4>& gradient, bool torn = false) {
  const Body<2> body(box_lattice<2>({10, 6}, 0.5, {0, 0}), {}, 0.5, 1.25,
                     InfluenceFunction::constant);
  const auto family = body.family(0);
  const auto count = static_cast<std::size_t>(body.points().size());
  std::vector<double> u(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector<2> x = body.points().at(static_cast<Index>(i));
    for (int a = 0; a < 2; ++a) {
      u[a * count + i] = gradient[2 * a] * x[0] + gradient[2 * a + 1] * x[1];
    }
  }
  if (torn) u[7] += 3.0;
  if (torn) {
    const std::pair<Index, Index> bonds[] = {{7, 8}};
    body.claim_bond_state().break_bonds(bonds);
  }
  return largest_strain(body, u, 1e-9);
}

TEST(SmallStrains, AreExactWhereDisplacementsAreLinear) {
  const LargestStrain stretched = strain_of({0.0, 0.0, 0.0, -0.2});
  EXPECT_NEAR(stretched.strain, 0.2, 1e-12);
  EXPECT_NEAR(stretched.rotation, 0.0, 1e-12);
  EXPECT_NEAR(strain_of({0.0, 0.3, 0.3, 0.0}).strain, 0.3, 1e-12);  // shear
}

TEST(SmallStrains, KeepRotationsApart) {
  const LargestStrain turned = strain_of({0.0, -0.15, 0.15, 0.0});
  EXPECT_NEAR(turned.strain, 0.0, 1e-12);
  EXPECT_NEAR(turned.rotation, 0.15, 1e-12);
}

TEST(SmallStrains, LeaveOutEndsOfBrokenBonds) {
  const LargestStrain torn = strain_of({0.0, 0.0, 0.0, 0.0}, true);
  EXPECT_NE(torn.strained, 7);
  EXPECT_NE(torn.strained, 8);
}

}  // namespace
}  // namespace perifrac
