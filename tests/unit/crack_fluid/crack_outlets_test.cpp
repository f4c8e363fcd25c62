#include "modules/crack_fluid/crack_outlets.hpp"

#include <gtest/gtest.h>

#include "tests/port_named.hpp"
#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

/// A body of 6 x 4 with a slit of facets of length 1 from the left face, the scene's, that has
/// grown to `reach`; 0.1 mm wide everywhere.
struct GrownSlit {
  std::shared_ptr<const Body<2>> body = box_body<2>({6, 4}, 1.0);
  BondState<2>& bonds = body->claim_bond_state();
  CrackFluid<2> module;

  GrownSlit(const BehindFace& right, double reach, std::vector<CrackInlet> inlets)
      : module(
            body, water, std::make_unique<Lubrication>(water),
            CrackInlets(std::move(inlets), water), {}, nullptr,
            std::make_unique<CrackOutlets<2>>(body, std::vector<BehindFace>{{}, right, {}, {}})) {
    for (int k = 0; k < 3; ++k) add(k, k + 1.0);
    module.initialize(0.0);
    add(3, 4.0);
    add(4, 5.0);
    add(5, reach);
  }
  void add(double from, double to) { bonds.add_facet({{{from, 2.0}, {to, 2.0}}}, {}); }
  PortView port(const std::string& name) { return test::port_named(module, name); }
  /// Pressures after three seconds.
  std::vector<double> pressures() {
    std::ranges::fill(port("free_crack_opening").value, 1e-4);
    for (int n = 0; n < 100; ++n) module.advance({0.03 * n, 0.03 * (n + 1)});
    const auto value = port("crack_pressure").value;
    return {value.begin(), value.end()};
  }
  double stored() { return port("crack_fluid_stored_mass").value[0]; }
  double gained() { return port("injected_crack_fluid_mass").value[0]; }
};

std::vector<CrackInlet> pump(double rate) { return {rate_inlet({0.5, 2.0}, rate)}; }

/// In the end what is pumped in flows out, under the fall of pressure of the cubic law.
TEST(CrackOutlets, DrainACrackThatHasGrownToAFreeFace) {
  constexpr double rate = 1e-3;
  GrownSlit slit({}, 6.0, pump(rate));
  const std::vector<double> p = slit.pressures();
  EXPECT_NEAR(p.back(), 0.0, 1e-6);
  const double fall = 12.0 * water.viscosity / 1e-12 * rate;  // of 1 m, at the density of p = 0
  const double compressed = 1.0 + p.front() / water.bulk_modulus;
  EXPECT_NEAR(p.front() / (5.0 * fall), 1.0, 0.85 * (compressed - 1.0));
  EXPECT_NEAR(slit.stored(), slit.gained(), 1e-14);
}

TEST(CrackOutlets, TakeWhatStandsBehindADrainedFace) {
  const BehindFace water_behind{.pressure = 2e7, .gives = true};
  GrownSlit slit(water_behind, 6.0, {});
  for (const double p : slit.pressures()) EXPECT_NEAR(p, 2e7, 1.0);
  EXPECT_NEAR(slit.gained(), 1000.0 * 6e-4 * (1.0 + 2e7 / water.bulk_modulus), 1e-9);
}

/// Air comes in, which is nothing.
TEST(CrackOutlets, TakeNothingWhereNoFluidIs) {
  GrownSlit slit({}, 6.0, {});
  slit.pressures();
  EXPECT_EQ(slit.gained(), 0.0);
  EXPECT_EQ(slit.stored(), 0.0);
}

/// Where the face is held, where free fluid is, where the crack has not come to it, and where the
/// scene has an inlet at it.
TEST(CrackOutlets, StayClosedElsewhere) {
  constexpr double rate = 2.05e-4;  // 1.025 of what the slit holds, in three seconds
  const double pumped = 3.0 * 1000.0 * rate;
  const auto gained = [](const BehindFace& right, double reach) {
    GrownSlit slit(right, reach, pump(rate));
    slit.pressures();
    return slit.gained();
  };
  EXPECT_NEAR(gained({.kind = BehindFace::Kind::held}, 6.0), pumped, 1e-12);
  EXPECT_NEAR(gained({.kind = BehindFace::Kind::free_fluid}, 6.0), pumped, 1e-12);
  EXPECT_NEAR(gained({}, 5.3), pumped, 1e-12);
  EXPECT_LT(gained({}, 5.6), 0.95 * pumped);
  GrownSlit slit({}, 6.0, {pump(rate)[0], pressure_inlet("end", {5.5, 2.0}, 1e5)});
  EXPECT_NEAR(slit.pressures().back(), 1e5, 1e-3);
}

}  // namespace
}  // namespace perifrac
