// The apparent toughness of the criteria, K_app / K_IC: the exact field of a crack is imposed on a
// plate around it, and J of the plate's own solution is held against the exact one. `make
// toughness` prints the table.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/bonds/crack_cut.hpp"
#include "modules/solid/fracture/stretch_limit.hpp"
#include "tests/unit/fracture/cracked_plate.hpp"

namespace perifrac::test {
namespace {

constexpr double degree = M_PI / 180.0;

struct Loading {
  const char* name;
  double normal, along, pressure;
};

constexpr Loading loadings[] = {
    {"uniaxial", 1e-3, 0.0, 0.0}, {"biaxial", 1e-3, 1e-3, 0.0}, {"pressure", 0.0, 0.0, 1e-3}};

struct Apparent {
  double mean;
  double largest;
};

/// The exact field that a plate stands for: in the moduli that its lattice has as a whole, which
/// with `lps` are not those of the rock.
struct Exact {
  Rock rock;
  double poisson;
  PlaneStiffness stiffness;

  Exact(Rock kind, double poisson_ratio, std::shared_ptr<const Body<2>> body)
      : rock(kind), poisson(poisson_ratio) {
    if (rock == Rock::linear_exact) return;
    const int n = body ? static_cast<int>(std::lround(body->faces()[1].coordinate)) : 24;
    stiffness = CrackedPlate(n, {}, poisson, body, {}, rock).effective_stiffness();
  }

  template <class Use>
  auto with(const Vector<2>& centre, double angle, double half_length, const Loading& loading,
            Use&& use) const {
    if (rock == Rock::lps) {
      return use(CrystalCrack{centre, angle, half_length, loading.normal, loading.along, 0.0,
                              loading.pressure, stiffness});
    }
    return use(ExactCrack{centre, angle, half_length, loading.normal, loading.along, 0.0,
                          loading.pressure, 0.5 * (1.0 - poisson), poisson});
  }
};

/// K_app / K_IC over a growth by `steps` spacings of the crack's end: K is what the load far away
/// or the pressure makes of the length, K_IC = sqrt(E' Gc) of the constants that a scene states.
Apparent apparent_toughness(Rock rock, const Loading& loading, double angle, int half_length,
                            int steps, double poisson = 0.25,
                            std::shared_ptr<const Body<2>> body = nullptr) {
  const int n = 2 * (half_length + steps / 2 + 20);
  const Vector<2> middle = {0.5 * n, 0.5 * n};
  CrackedPlate plate(n, straight_crack(middle, angle, 2 * half_length), poisson, body, {}, rock);
  const Exact exact(rock, poisson, body);
  Apparent apparent{0.0, 0.0};
  for (int step = 0; step <= steps; ++step) {
    const Vector<2> centre = {middle[0] + 0.5 * step * std::cos(angle),
                              middle[1] + 0.5 * step * std::sin(angle)};
    const double ratio =
        exact.with(centre, angle, half_length + 0.5 * step, loading, [&](const auto& crack) {
          return crack.mode_one() /
                 std::sqrt(plate.tip_load(crack, 1, plate.solve(crack)).energy_release);
        });
    apparent.mean += ratio / (steps + 1);
    apparent.largest = std::max(apparent.largest, ratio);
    const double r = half_length + step;
    const auto at = [&](double s) {
      return Vector<2>{middle[0] + s * std::cos(angle), middle[1] + s * std::sin(angle)};
    };
    plate.cracked->cut({at(r), at(r + 1)});
  }
  return apparent;
}

class ApparentToughnessOf : public testing::TestWithParam<Rock> {};

TEST_P(ApparentToughnessOf, IsThatOfTheMaterialWhateverTheLoadAndTheLattice) {
  fmt::print("K_app / K_IC of energy_release, {}, nu 0.25, 10 spacings of growth: mean (largest)\n",
             name(GetParam()));
  fmt::print("{:>6} {:>7}", "a/dx", "angle");
  for (const Loading& loading : loadings) fmt::print(" {:>16}", loading.name);
  fmt::print("\n");
  for (const int half_length : {10, 20, 40}) {
    for (const double angle : {0.0, 20.0, 26.565051177, 45.0}) {
      fmt::print("{:>6} {:>7.1f}", half_length, angle);
      double biaxial = 0.0;
      for (const Loading& loading : loadings) {
        const Apparent found =
            apparent_toughness(GetParam(), loading, angle * degree, half_length, 10);
        fmt::print("   {:.4f} ({:.3f})", found.mean, found.largest);
        EXPECT_NEAR(found.mean, 1.0, 0.03) << loading.name << ' ' << angle;
        EXPECT_LE(found.largest, 1.05) << loading.name << ' ' << angle;
        if (std::string(loading.name) == "biaxial") biaxial = found.mean;
        if (std::string(loading.name) == "pressure") {
          EXPECT_NEAR(found.mean, biaxial, 0.02) << half_length << ' ' << angle;
        }
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

/// How far from its straight line a crack comes that turns as its tip says, over so many spacings
/// of growth [spacing].
double wander(Rock rock, const Loading& loading, double angle, int half_length, int steps) {
  const int n = 2 * (half_length + steps / 2 + 20);
  const Vector<2> middle = {0.5 * n, 0.5 * n}, ahead = {std::cos(angle), std::sin(angle)};
  CrackedPlate plate(n, straight_crack(middle, angle, 2 * half_length), 0.25, {}, {}, rock);
  const Exact exact(rock, 0.25, {});
  const auto last_facet = [&] { return static_cast<Index>(plate.cracked->facets().size()) - 1; };
  CrackTip tip{{middle[0] + half_length * ahead[0], middle[1] + half_length * ahead[1]},
               ahead,
               last_facet(),
               last_facet() - 1};
  double farthest = 0.0;
  for (int step = 0; step < steps; ++step) {
    const Vector<2> centre = {middle[0] + 0.5 * step * ahead[0], middle[1] + 0.5 * step * ahead[1]};
    const double turn =
        exact.with(centre, angle, half_length + 0.5 * step, loading, [&](const auto& crack) {
          const Eigen::VectorXd u = plate.solve(crack);
          const TipLoad load =
              EnergyRelease(*plate.cracked, 1.0)
                  .at(tip, {u.data(), static_cast<std::size_t>(u.size())}, plate.pressure);
          return load.turn_to + kink_angle(modes_of(load));
        });
    const double c = std::cos(turn), s = std::sin(turn);
    tip.direction = {c * tip.direction[0] - s * tip.direction[1],
                     s * tip.direction[0] + c * tip.direction[1]};
    const Vector<2> from = tip.place;
    for (int a = 0; a < 2; ++a) tip.place[a] += tip.direction[a];
    plate.cracked->cut({from, tip.place});
    tip.before = tip.facet;
    tip.facet = last_facet();
    farthest = std::max(farthest, std::abs((tip.place[1] - middle[1]) * ahead[0] -
                                           (tip.place[0] - middle[0]) * ahead[1]));
  }
  return farthest;
}

TEST_P(ApparentToughnessOf, GoesStraight) {
  const double most = GetParam() == Rock::linear_exact ? 0.4 : 0.65;
  fmt::print("Off the line in 10 spacings of growth, {}, a/dx 10: in spacings\n", name(GetParam()));
  for (const double angle : {0.0, 20.0, 26.565051177, 45.0}) {
    fmt::print("{:>7.1f}", angle);
    for (const Loading& loading : loadings) {
      const double found = wander(GetParam(), loading, angle * degree, 10, 10);
      fmt::print(" {:>9} {:.3f}", loading.name, found);
      EXPECT_LE(found, most) << loading.name << ' ' << angle;
    }
    fmt::print("\n");
  }
}

/// The largest stretch of the bonds across a facet.
double largest_stretch(const CrackedPlate& plate, const CrackFacet<2>& facet,
                       const Eigen::VectorXd& u) {
  const Family<2>& family = *plate.family;
  double largest = 0.0;
  for (const auto& [i, j] : bonds_cut_by<2>(facet, family, INFINITY)) {
    double along = 0.0, square = 0.0;
    for (int a = 0; a < 2; ++a) {
      const double xi = family.position[a][j] - family.position[a][i];
      along += xi * (u[a * family.point_count + j] - u[a * family.point_count + i]);
      square += xi * xi;
    }
    largest = std::max(largest, along / square);
  }
  return largest;
}

/// As it is: no bound, for the criterion has none to meet (docs/fracture.md). The plate is linear,
/// so that the load at which the first bond ahead of the tip breaks follows from one solution.
TEST(ApparentToughness, OfCriticalStretchAsItIs) {
  const auto body = box_body<2>({9, 9}, 1.0);
  const double mu = 0.375;  // E' = 1, nu 0.25
  const IsotropicElasticity<2> law{mu, mu};
  const double corrected = consistent_stretch(law, 1.0, crossing_bonds(*body->family(0), 1.0));
  const double limits[] = {printed_stretch(law, 1.0, body->horizon()), corrected,
                           calibrated_stretch(law, 1.0, 1.0)};
  fmt::print("K_app / K_IC of critical_stretch, nu 0.25: printed, corrected, calibrated\n");
  fmt::print("{:>6} {:>7}", "a/dx", "angle");
  for (const Loading& loading : loadings) fmt::print(" {:>23}", loading.name);
  fmt::print("\n");
  for (const int half_length : {10, 20, 40}) {
    for (const double degrees : {0.0, 20.0, 26.565051177, 45.0}) {
      const double angle = degrees * degree;
      const int n = 2 * (half_length + 20);
      CrackedPlate plate(n, straight_crack({0.5 * n, 0.5 * n}, angle, 2 * half_length));
      const auto at = [&](double r) {
        return Vector<2>{0.5 * n + r * std::cos(angle), 0.5 * n + r * std::sin(angle)};
      };
      fmt::print("{:>6} {:>7.1f}", half_length, degrees);
      for (const Loading& loading : loadings) {
        const ExactCrack exact{plate.middle(),
                               angle,
                               1.0 * half_length,
                               loading.normal,
                               loading.along,
                               0.0,
                               loading.pressure,
                               mu,
                               0.25};
        const double stretch =
            largest_stretch(plate, {at(half_length), at(half_length + 1)}, plate.solve(exact));
        fmt::print("  ");
        for (const double limit : limits) {
          const double found = exact.mode_one() * limit / stretch;
          fmt::print(" {:>6.3f}", found);
          EXPECT_TRUE(std::isfinite(found) && found > 0.0);
        }
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

/// Points moved by up to a fifth of a spacing: the crack meets other bonds at every step.
TEST_P(ApparentToughnessOf, IsThatOfTheMaterialOnJitteredPoints) {
  constexpr int half_length = 10, steps = 10;
  constexpr int n = 2 * (half_length + steps / 2 + 20);
  fmt::print("K_app / K_IC of energy_release, {}, jitter 0.2, a/dx 10: mean (largest)\n",
             name(GetParam()));
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto body = irregular_box<2>({n, n}, 1.0, seed);
    for (const double angle : {0.0, 26.565051177}) {
      for (const Loading& loading : {loadings[0], loadings[2]}) {
        const Apparent found =
            apparent_toughness(GetParam(), loading, angle * degree, half_length, steps, 0.25, body);
        fmt::print("seed {} {:>5.1f} {:<9} {:.4f} ({:.3f})\n", seed, angle, loading.name,
                   found.mean, found.largest);
        EXPECT_NEAR(found.mean, 1.0, 0.08) << seed << ' ' << angle << ' ' << loading.name;
        EXPECT_LE(found.largest, 1.08) << seed << ' ' << angle << ' ' << loading.name;
      }
    }
  }
}

TEST_P(ApparentToughnessOf, DoesNotDependOnPoissonsRatio) {
  for (const double poisson : {0.1, 0.2, 0.3, 0.4}) {
    const Apparent found = apparent_toughness(GetParam(), loadings[0], 0.0, 10, 5, poisson);
    fmt::print("{}, nu {:.1f}: {:.4f} ({:.3f})\n", name(GetParam()), poisson, found.mean,
               found.largest);
    EXPECT_NEAR(found.mean, 1.0, 0.03) << poisson;
  }
}

INSTANTIATE_TEST_SUITE_P(Rocks, ApparentToughnessOf, testing::ValuesIn(rocks),
                         [](const auto& rock) { return std::string(name(rock.param)); });

}  // namespace
}  // namespace perifrac::test
