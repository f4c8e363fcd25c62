// What pores press on the faces of cracks.

#include <gtest/gtest.h>

#include "modules/solid/fracturing_solid.hpp"
#include "tests/port_named.hpp"
#include "tests/unit/fracture/breaking_solid.hpp"
#include "tests/unit/fracture/cracked_plate.hpp"
#include "tests/unit/solid/elastic_solid.hpp"

namespace perifrac::test {
namespace {

/// One pore stress everywhere, nothing from outside: rock that bears none of it swells evenly, and
/// what pores press on the faces of a crack is what the rock there pulls.
TEST(PoreSwelling, IsEvenRoundACrack) {
  constexpr double pore_stress = 0.01, strain = pore_stress / (2.0 * (lambda + mu));
  for (const double angle : {0.0, 0.46, M_PI / 4.0}) {
    const auto body = box_body<2>({20, 20}, 1.0);
    SolidBoundary<2> boundary(*body);
    boundary.roller(0, 0.0);
    boundary.roller(2, 0.0);
    const Breakable<2> parts(*body, boundary, {lambda, mu});
    FracturingSolid<2> solid(body, parts.family, parts.elastic, boundary, {},
                             straight_crack({10.0, 10.0}, angle, 8), {{INFINITY}});
    std::ranges::fill(port_named(solid, "pore_stress").value, pore_stress);
    solid.initialize(0.0);
    solid.advance({0.0, 1.0});
    solid.conclude({0.0, 1.0});
    const auto moved = port_named(solid, "displacement").value;
    const Index count = body->points().size();
    for (Index i = 0; i < count; ++i) {
      for (int a = 0; a < 2; ++a) {
        EXPECT_NEAR(moved[a * count + i], strain * body->points().at(i)[a], 1e-11)
            << angle << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace perifrac::test
