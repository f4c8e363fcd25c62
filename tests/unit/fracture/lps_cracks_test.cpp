// Cracks in the linear peridynamic solid, against exact ones in a rock with the moduli that its
// lattice has as a whole.

#include <gtest/gtest.h>

#include "modules/solid/fracturing_solid.hpp"
#include "tests/port_named.hpp"
#include "tests/unit/fracture/breaking_solid.hpp"
#include "tests/unit/fracture/cracked_plate.hpp"
#include "tests/unit/solid/elastic_solid.hpp"

namespace perifrac::test {
namespace {

CrackedPlate plate_with(double angle, int half) {
  const int n = 2 * half + 44;
  return {n, straight_crack({0.5 * n, 0.5 * n}, angle, 2 * half), 0.25, nullptr, {}, Rock::lps};
}

PlaneStiffness stiffness_of_the_lattice() {
  CrackedPlate intact(20, {}, 0.25, nullptr, {}, Rock::lps);
  return intact.effective_stiffness();
}

std::vector<double> port_of(PhysicsModule& module, const std::string& name) {
  const auto value = test::port_named(module, name).value;
  return {value.begin(), value.end()};
}

/// As the lattice sums of LatticeModuli have it, 6.5 % and -19.5 % at Poisson's ratio 0.25.
TEST(LpsCracks, AreInARockWithTheModuliOfItsLattice) {
  const PlaneStiffness c = stiffness_of_the_lattice();
  const double mu = 0.375, more = c(0, 0) - 3.0 * mu;
  EXPECT_NEAR(more, 0.0648 * 3.0 * mu, 9e-5);
  EXPECT_NEAR(c(2, 2), mu - more, 1e-9);
  EXPECT_NEAR(c(0, 1), mu - more, 1e-9);
  EXPECT_NEAR(c(1, 1), c(0, 0), 1e-9);
  EXPECT_NEAR(c(0, 2), 0.0, 1e-9);
}

/// A solid that may crack, without a crack, is the solid that may not.
TEST(LpsCracks, LeaveASolidWithoutThemAsItIs) {
  const auto body = box_body<2>({12, 9}, 0.5);
  SolidBoundary<2> boundary(*body);
  boundary.roller(0, 0.0);
  boundary.fixed(2, {});
  boundary.traction(3, {0.02, -0.1});
  const Breakable<2> parts(*body, boundary, {lambda, mu}, Rock::lps);
  FracturingSolid cracking(body, parts.family, parts.elastic, boundary, {}, {}, {{1.0}});
  QuasiStaticSolid<2> plain(body, lps<2>(*body, boundary, {lambda, mu}), boundary);
  const std::vector<double> pore = random_values(body->points().volume.size());
  for (PhysicsModule* module :
       {static_cast<PhysicsModule*>(&cracking), static_cast<PhysicsModule*>(&plain)}) {
    const PortView pores = test::port_named(*module, "pore_stress");
    std::ranges::copy(pore, pores.value.begin());
    module->initialize(0.0);
    module->advance({0.0, 1.0});
    module->conclude({0.0, 1.0});
  }
  for (const char* field : {"displacement", "dilatation", "effective_stress", "elastic_energy"}) {
    const std::vector<double> one = port_of(cracking, field), other = port_of(plain, field);
    ASSERT_EQ(one.size(), other.size());
    EXPECT_GT(largest(other), 0.0);
    EXPECT_LE(largest(as_eigen(one) - as_eigen(other)), 1e-11 * largest(other)) << field;
  }
}

/// Sneddon: w goes as sqrt(a^2 - x^2), and is in the middle what the rock's moduli make it.
TEST(LpsCracks, OpenUnderPressureAsSneddonSays) {
  const int half = 20;
  const PlaneStiffness stiffness = stiffness_of_the_lattice();
  for (const double angle : {0.0, quarter}) {
    CrackedPlate plate = plate_with(angle, half);
    const CrystalCrack exact{plate.middle(), angle, half, 0.0, 0.0, 0.0, 1e-3, stiffness};
    plate.solve(exact);
    const auto faces = plate.cracked->faces(plate.pressure);
    double volume = 0.0;
    const double middle = exact.middle_jump()[0];
    for (int f = 0; f < 2 * half; ++f) {
      const double x = f + 0.5 - half;
      const double opening = middle * std::sqrt(half * half - x * x);
      if (std::abs(x) < 0.8 * half) {
        EXPECT_NEAR(faces.opening[f], opening, 0.044 * opening) << x;
      }
      volume += faces.opening[f];
    }
    // The facets at the tips open too far.
    EXPECT_NEAR(volume, 0.5 * middle * M_PI * half * half, 0.02 * volume) << angle;
  }
}

/// J is what the rock's own moduli make of the load, in the mean over five facets.
TEST(LpsCracks, ReleaseTheEnergyOfTheExactCrack) {
  constexpr int half = 10, steps = 4;
  const PlaneStiffness stiffness = stiffness_of_the_lattice();
  for (const double angle : {0.0, 0.35, quarter}) {
    CrackedPlate plate = plate_with(angle, half);
    double tension = 0.0, pressure = 0.0;
    for (int k = 0; k <= steps; ++k) {
      if (k > 0) plate.cracked->cut(straight_crack(plate.middle(), angle, 2 * (half + k)).back());
      const double off = 0.5 * k;
      CrystalCrack exact{
          {plate.middle()[0] + off * std::cos(angle), plate.middle()[1] + off * std::sin(angle)},
          angle,
          half + off,
          1e-3,
          0.0,
          0.0,
          0.0,
          stiffness};
      const auto ratio = [&] {
        const double j = plate.tip_load(exact, 1, plate.solve(exact)).energy_release;
        return std::sqrt(exact.energy_release() / j) / (steps + 1);
      };
      tension += ratio();
      std::swap(exact.normal, exact.pressure);
      pressure += ratio();
    }
    EXPECT_NEAR(tension, 1.0, 0.010) << angle;
    EXPECT_NEAR(pressure, 1.0, 0.027) << angle;
  }
}

/// J is what growth takes from the energy: of a clamped plate under tension, and of one that fluid
/// in the crack pulls apart.
TEST(LpsCracks, TakeTheEnergyThatTheyRelease) {
  constexpr int half = 10, steps = 4;
  CrackedPlate plate = plate_with(0.0, half);
  const CrystalCrack clamped{
      plate.middle(), 0.0, 1e-9, 1e-3, 0.0, 0.0, 0.0, stiffness_of_the_lattice()};
  std::vector<double> tension, pressure;
  double by_tension = 0.0, by_pressure = 0.0;
  for (int k = 0; k <= steps; ++k) {
    if (k > 0) plate.cracked->cut(straight_crack(plate.middle(), 0.0, 2 * (half + k)).back());
    const double share = k == 0 || k == steps ? 0.5 : 1.0;
    CrystalCrack tip = clamped;
    tip.half_length = half + k;
    const Eigen::VectorXd u = plate.solve(clamped);
    by_tension += share * plate.tip_load(tip, 1, u).energy_release;
    tension.push_back(plate.potential_energy({u.data(), std::size_t(u.size())}, {}));
    const std::vector<double> dry(plate.family->point_count, 0.0);
    const Eigen::VectorXd v = plate.solve(dry, 1e-3);
    by_pressure += share * plate.tip_load(tip, 1, v).energy_release;
    pressure.push_back(plate.potential_energy({v.data(), std::size_t(v.size())}, dry));
  }
  EXPECT_NEAR(by_tension, tension.front() - tension.back(), 1.7e-3 * by_tension);
  EXPECT_NEAR(by_pressure, pressure.front() - pressure.back(), 0.05 * by_pressure);
}

TEST(LpsCracks, KinkUnderMixedLoad) {
  const PlaneStiffness stiffness = stiffness_of_the_lattice();
  CrackedPlate plate = plate_with(0.0, 10);
  const CrystalCrack exact{plate.middle(), 0.0, 10, 1e-3, 0.0, 0.3e-3, 0.0, stiffness};
  const Eigen::VectorXd u = plate.solve(exact);
  const double j = exact.energy_release();
  for (const int end : {0, 1}) {
    const TipLoad load = plate.tip_load(exact, end, u);
    EXPECT_NEAR(load.energy_release, j, 0.02 * j);
    EXPECT_NEAR(kink_angle(modes_of(load)) * 180.0 / M_PI, -29.0, 2.5);
  }
}

}  // namespace
}  // namespace perifrac::test
