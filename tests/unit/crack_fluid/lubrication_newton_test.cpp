#include "modules/crack_fluid/network/lubrication_newton.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

constexpr double facet_size = 4.0, rock_modulus = 26.7e9;
constexpr int line_facets = 17, arm_facets = 9;
constexpr CrackLiquid slickwater{.density = 1000.0,
                                 .viscosity = 1e-2,
                                 .bulk_modulus = 2.2e9,
                                 .vapour_pressure = 0.0,
                                 .residual_aperture = 2e-6};

/// A line of facets that another one crosses at 60 degrees, so that four meet in a corner.
std::vector<CrackFacet<2>> crossing() {
  std::vector<CrackFacet<2>> facets;
  const auto line = straight_line({0.0, 0.0}, 0.0, facet_size, line_facets);
  for (int k = 0; k < line_facets; ++k) facets.push_back({line[k], line[k + 1]});
  const Vector<2> corner = line[11];
  const auto arm = [&](double angle, int count) {
    const auto corners = straight_line(corner, angle, facet_size, count);
    for (int k = 0; k < count; ++k) facets.push_back({corners[k], corners[k + 1]});
  };
  arm(std::numbers::pi / 3.0, 5);
  arm(std::numbers::pi * 4.0 / 3.0, arm_facets - 5);
  return facets;
}

/// Displacement discontinuities of either line, and something of one in the other.
Eigen::MatrixXd compliance_of(const std::vector<CrackFacet<2>>& facets) {
  const auto count = static_cast<Eigen::Index>(facets.size());
  Eigen::MatrixXd stiffness(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const Vector<2> apart = middle<2>(facets[i]) - middle<2>(facets[j]);
      const double square = apart[0] * apart[0] + apart[1] * apart[1];
      const bool same_line = (i < line_facets) == (j < line_facets);
      stiffness(i, j) = -rock_modulus * facet_size /
                        (4.0 * std::numbers::pi * (square - 0.25 * facet_size * facet_size));
      if (!same_line) {
        stiffness(i, j) = -0.1 * rock_modulus * facet_size /
                          (4.0 * std::numbers::pi * (square + facet_size * facet_size));
      }
    }
  }
  return stiffness.inverse();
}

/// A state of the cracks that physics allows, and a step from it.
struct RandomStep {
  std::mt19937 random;
  Eigen::MatrixXd compliance = compliance_of(crossing());
  Lubrication lubrication{slickwater, CrackGraph(crossing())};
  Eigen::Matrix<double, -1, -1, Eigen::RowMajor> slope = compliance;
  Eigen::VectorXd closed_by, v;
  std::vector<double> value, rate, mass;
  std::vector<FacetInflow> inflows;
  std::vector<WellFlow> wells;

  explicit RandomStep(unsigned seed) : random(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  bool chance(double part) { return between(0.0, 1.0) < part; }

  CrackStep step(double length) {
    return {.time = {0.0, length},
            .opening = {value, rate, {slope.data(), std::size_t(slope.size())}, length},
            .mass = mass,
            .inflows = inflows,
            .wells = length > 0.0 ? std::span(wells) : std::span<WellFlow>()};
  }

  /// Stress up to 100 MPa, another one across the other line.
  void begin(double stress) {
    const Eigen::Index count = slope.rows();
    closed_by.resize(count);
    const double other = stress * between(1.0, 1.3);
    for (Eigen::Index f = 0; f < count; ++f) closed_by[f] = f < line_facets ? stress : other;
    v.resize(count);
    const double level = between(0.0, 1.05) * stress + between(0.0, 1e6);
    const int first = static_cast<int>(between(0.0, line_facets));
    const int last = static_cast<int>(between(first, line_facets));
    for (Eigen::Index f = 0; f < count; ++f) {
      const bool wet = f < line_facets ? (f >= first && f <= last) : chance(0.5);
      v[f] = wet ? level * between(0.9, 1.0) : slickwater.empty();
      if (chance(0.1)) v[f] = -slickwater.bulk_modulus * between(0.0, 1.0);
    }
    set_opening();
    mass.assign(count, 0.0);
    lubrication.evaluate(step(0.0), v);
    for (Eigen::Index f = 0; f < count; ++f) mass[f] = lubrication.residual()[f];
  }
  void set_opening() {
    const Eigen::VectorXd closed = -(compliance * closed_by);
    value.assign(closed.data(), closed.data() + closed.size());
    rate.assign(value.size(), 0.0);
  }
};

/// Dry, closed and open facets, at rest or over up to half a minute, shut in or pumped, at 0 to 100
/// MPa, after what closes them has changed by a hundredth. The few that Newton leaves, if any, are
/// for shorter steps; without the calm iterations they were 25.
TEST(LubricationNewton, ConvergesFromStatesThatPhysicsAllows) {
  constexpr int states = 4000;
  int failed = 0, iterations = 0;
  for (unsigned seed = 0; seed < states; ++seed) {
    RandomStep random(seed);
    random.begin(seed % 5 == 0 ? 0.0 : 1e8 * std::pow(random.between(0.0, 1.0), 2.0));
    for (double& closed : random.closed_by) closed *= random.between(0.99, 1.01);
    random.set_opening();
    double length = 0.0;
    if (random.chance(0.7)) {
      length = std::pow(10.0, random.between(-6.0, 1.5));
      const double inflow = random.chance(0.3) ? 0.0 : 0.5 * length;
      random.inflows.push_back({8, inflow, inflow, 0.0});
    }
    const FlowReport report = solve(random.lubrication, slickwater, random.step(length), random.v);
    if (!report.converged) ++failed;
    iterations += report.iterations;
  }
  EXPECT_LE(failed, 2);
  EXPECT_LT(iterations, 4.6 * states);  // 3.1
}

/// The same beside a well of three clusters, two in one line and one in the other, that is pumped,
/// shut in, or flows back; their friction from none to a hundred megapascal, and Newton begins at
/// no rates, or at any.
TEST(LubricationNewton, ConvergesBesideAWell) {
  constexpr int states = 4000;
  int failed = 0, iterations = 0;
  for (unsigned seed = 0; seed < states; ++seed) {
    RandomStep random(seed);
    random.begin(seed % 5 == 0 ? 0.0 : 1e8 * std::pow(random.between(0.0, 1.0), 2.0));
    for (double& closed : random.closed_by) closed *= random.between(0.99, 1.01);
    random.set_opening();
    const double length = std::pow(10.0, random.between(-6.0, 1.5));
    const double full = 5e-4, rate = full * std::array{1.0, 0.0, -1.0}[seed % 3];
    std::vector<WellFlow::Opening> openings;
    for (const Index facet : {2, 8, line_facets + 7}) {
      const double most = random.chance(0.2) ? 0.0 : std::pow(10.0, random.between(2.0, 8.0));
      const double begin = random.chance(0.5) ? 0.0 : random.between(-1.0, 1.0) * full;
      openings.push_back({.facet = facet, .resistance = most / (full * full), .rate = begin});
    }
    const WellFlow::Law law{2.2 / full, 0.0, 2.2};
    random.wells.emplace_back(openings, rate, law);
    const FlowReport report = solve(random.lubrication, slickwater, random.step(length), random.v);
    iterations += report.iterations;
    if (!report.converged) {
      ++failed;
      continue;
    }
    double sum = 0.0, through = full;
    const WellFlow& well = random.wells[0];
    for (const auto& at : well.openings()) {
      sum += at.rate;
      through += std::abs(at.rate);
      const double there = std::max(random.v[at.facet], 0.0);
      const double lost = (at.resistance * std::abs(at.rate) + law.laminar) * at.rate;
      EXPECT_NEAR(well.pressure() - there, lost, 2e-9 * (well.pressure() + there) + 1e-8) << seed;
    }
    if (well.pressure() > 0.0) {
      EXPECT_NEAR(sum, rate, 1e-15 * through) << seed;
    } else {
      EXPECT_GE(sum, rate - 1e-15 * through) << seed;
    }
  }
  EXPECT_LE(failed, 4);                // 3, for shorter steps
  EXPECT_LT(iterations, 10 * states);  // 6.9
}

}  // namespace
}  // namespace perifrac
