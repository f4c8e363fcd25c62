#include "modules/crack_fluid/network/lubrication.hpp"

#include <random>

#include <gtest/gtest.h>

#include "modules/crack_fluid/carter_leak_off.hpp"
#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

std::vector<CrackFacet<2>> facets_of(const std::vector<Vector<2>>& corners) {
  std::vector<CrackFacet<2>> facets;
  for (std::size_t k = 1; k < corners.size(); ++k) facets.push_back({corners[k - 1], corners[k]});
  return facets;
}

/// A line of ten facets with a branch of five from its middle.
CrackGraph fork() {
  const auto line = straight_line({0.0, 0.0}, 0.3, 1e-3, 10);
  auto facets = facets_of(line);
  for (const auto& facet : facets_of(straight_line(line[5], 1.4, 0.7e-3, 5))) {
    facets.push_back(facet);
  }
  return CrackGraph(facets);
}

TEST(CrackGraph, JoinsFacetsWhereTheyShareAPoint) {
  const CrackGraph graph = fork();
  ASSERT_EQ(graph.facet_count(), 15);
  EXPECT_NEAR(graph.area(3), 1e-3, 1e-15);
  EXPECT_NEAR(graph.area(12), 0.7e-3, 1e-15);
  ASSERT_EQ(graph.joint_count(), 13u);  // 9 on the line, of which one with the branch, and 4
  int junctions = 0;
  for (std::size_t k = 0; k < graph.joint_count(); ++k) {
    const auto joint = graph.joint(k);
    if (joint.size() == 2) continue;
    ++junctions;
    ASSERT_EQ(joint.size(), 3u);
    EXPECT_EQ(joint[0].facet, 4);
    EXPECT_EQ(joint[0].side, 1);
    EXPECT_EQ(joint[1].facet, 5);
    EXPECT_EQ(joint[1].side, 0);
    EXPECT_EQ(joint[2].facet, 10);
    EXPECT_EQ(joint[2].side, 0);
  }
  EXPECT_EQ(junctions, 1);
}

/// Rectangles of 2 mm * 1 mm, five along each axis.
std::vector<CrackFacet<3>> rectangles() {
  const auto corner = [](int i, int j) { return Vector<3>{2e-3 * i, 0.01, 1e-3 * j}; };
  std::vector<CrackFacet<3>> facets;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      facets.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return facets;
}

TEST(CrackGraph, JoinsFacetsIn3DWhereTheyShareASide) {
  const CrackGraph graph{rectangles()};
  ASSERT_EQ(graph.facet_count(), 25);
  EXPECT_EQ(graph.joint_count(), 40u);
  EXPECT_NEAR(graph.area(7), 2e-6, 1e-20);
  for (std::size_t k = 0; k < graph.joint_count(); ++k) EXPECT_EQ(graph.joint(k).size(), 2u);
}

/// In a plane slit a pressure that falls evenly drives w^3 / (12 mu) times its slope through every
/// side, times the side's width.
TEST(Lubrication, FollowsTheCubicLawIn3D) {
  const CrackLiquid liquid{.density = 1000.0, .viscosity = 1e-3, .bulk_modulus = 1e18};
  Lubrication lubrication(liquid, CrackGraph(rectangles()));
  const double w = 5e-5, along_x = 3e6, along_z = -1e6;
  std::vector<double> pressure;
  const std::vector<double> aperture(25, w), full(25, 1.0);
  for (const auto& facet : rectangles()) {
    const Vector<3> at = middle<3>(facet);
    pressure.push_back(1e5 + along_x * at[0] + along_z * at[2]);
  }
  int counted = 0;
  const auto compare = [&](const auto& a, const auto& b, double flux) {
    const bool is_along_x = std::abs(a.facet - b.facet) == 5;
    const double rise = is_along_x ? along_x : along_z, width = is_along_x ? 1e-3 : 2e-3;
    const double towards = b.facet > a.facet ? -1.0 : 1.0;
    const double exact =
        towards * liquid.density * w * w * w / (12.0 * liquid.viscosity) * rise * width;
    EXPECT_NEAR(flux, exact, 1e-10 * std::abs(exact));
    ++counted;
  };
  lubrication.for_each_flux(pressure, full, aperture, compare);
  EXPECT_EQ(counted, 40);
}

/// Fluid at rest is under its weight. Of what is half full half as much falls as of what is full.
TEST(Lubrication, FluidHasTheWeightThatGravityGivesIt) {
  const CrackLiquid liquid{.density = 1000.0, .viscosity = 1e-3, .bulk_modulus = 1e18};
  const double w = 5e-5, weight = 1e4, dx = 1e-3;
  std::vector<CrackFacet<2>> facets;
  for (int f = 0; f < 6; ++f) facets.push_back({{{0.0, f * dx}, {0.0, (f + 1) * dx}}});
  Eigen::VectorXd height(6);
  std::vector<double> at_rest, none(6, 0.0);
  for (int f = 0; f < 6; ++f) {
    height[f] = weight * (f + 0.5) * dx;
    at_rest.push_back(1e5 - height[f]);
  }
  Lubrication lubrication(liquid, CrackGraph(facets), height);
  const double falls = liquid.density * w * w * w / (12.0 * liquid.viscosity) * weight;
  const auto largest_error = [&](std::span<const double> pressure, double fill, double exact) {
    double error = 0.0;
    const auto compare = [&](const auto& a, const auto& b, double flux) {
      const double upwards = b.facet > a.facet ? flux : -flux;
      error = std::max(error, std::abs(upwards + exact));
    };
    lubrication.for_each_flux(pressure, std::vector<double>(6, fill), std::vector<double>(6, w),
                              compare);
    return error;
  };
  EXPECT_LT(largest_error(at_rest, 1.0, 0.0), 1e-10 * falls);
  EXPECT_LT(largest_error(none, 1.0, falls), 1e-12 * falls);
  EXPECT_LT(largest_error(none, 0.5, 0.5 * falls), 1e-12 * falls);
}

/// A step with all there is: facets full, partly full and closed, a dense slope, inlets of all
/// kinds, leak-off.
struct AnyStep {
  CrackLiquid liquid{.density = 1000.0,
                     .viscosity = 1e-3,
                     .bulk_modulus = 22e6,
                     .vapour_pressure = -2e4,
                     .residual_aperture = 1e-5};
  Lubrication lubrication;
  std::vector<double> value, rate, slope, mass;
  std::vector<FacetInflow> inflows{
      {0, -INFINITY, INFINITY, 3e5}, {8, 2e-4, 2e-4, 0.0}, {12, -3e-4, 0.0, -2e4}};
  CarterLeakOff<2> leak_off{ByRegion<2, double>{1e-4, {}}, 1000.0};
  Eigen::VectorXd v{15};

  /// `weight` of the fluid along the first axis [Pa/m].
  explicit AnyStep(double weight = 0.0)
      : lubrication(liquid, fork(), Eigen::VectorXd::LinSpaced(15, 0.0, 14e-3 * weight)) {
    std::mt19937 bits(3);
    std::uniform_real_distribution<double> random(0.0, 1.0);
    for (int f = 0; f < 15; ++f) {
      value.push_back(f % 5 == 4 ? -1e-3 : 2e-5 + 3e-5 * random(bits));
      rate.push_back(1e-4 * random(bits));
      mass.push_back(3e-5 * random(bits));
      v[f] = f % 4 == 3 ? -2e4 - 10e6 * random(bits) : 4e5 * random(bits);
      for (int g = 0; g < 15; ++g) slope.push_back((f == g ? 1e-10 : 0.0) + 1e-11 * random(bits));
    }
    leak_off.match(PointSet{}, lubrication.graph());
    leak_off.begin({0.1, 0.12}, std::vector<double>(15, 0.5));
  }
  CrackStep step(double end = 0.12) {
    return {.time = {0.1, end},
            .opening = {value, rate, slope, 0.13},
            .mass = mass,
            .inflows = inflows,
            .leak_off = &leak_off};
  }
};

/// Without weight, and with one that drives fluid out of facets that are not full.
class LubricationUnder : public testing::TestWithParam<double> {};

TEST_P(LubricationUnder, JacobianIsTheDerivativeOfTheResidual) {
  AnyStep any(GetParam());
  any.lubrication.evaluate(any.step(), any.v);
  const Eigen::MatrixXd jacobian = any.lubrication.jacobian(any.v);
  for (int g = 0; g < 15; ++g) {
    const double h = 1000.0;
    Eigen::VectorXd near = any.v;
    near[g] += h;
    any.lubrication.evaluate(any.step(), near);
    Eigen::VectorXd difference = any.lubrication.residual();
    near[g] -= 2.0 * h;
    any.lubrication.evaluate(any.step(), near);
    difference -= any.lubrication.residual();
    difference /= 2.0 * h;
    EXPECT_LT((difference - jacobian.col(g)).norm(), 1e-6 * jacobian.col(g).norm()) << g;
  }
}

TEST_P(LubricationUnder, WhatLeavesOneFacetEntersOthers) {
  AnyStep any(GetParam());
  any.lubrication.evaluate(any.step(), any.v);
  EXPECT_GT(any.lubrication.outflow().cwiseAbs().sum(), 0.0);
  EXPECT_LT(std::abs(any.lubrication.outflow().sum()),
            1e-15 * any.lubrication.outflow().cwiseAbs().sum());
}

INSTANTIATE_TEST_SUITE_P(Weights, LubricationUnder, testing::Values(0.0, -3e8));

TEST(Lubrication, OnlyFullFacetsGive) {
  AnyStep any;
  any.lubrication.evaluate(any.step(), any.v);
  for (int f = 0; f < 15; ++f) {
    if (any.liquid.is_full(any.v[f])) continue;
    EXPECT_LE(any.lubrication.outflow()[f], 0.0) << f;
  }
}

TEST(Lubrication, NothingFlowsInAStepOfNoLength) {
  AnyStep any;
  any.leak_off.begin({0.1, 0.1}, std::vector<double>(15, 0.5));
  any.inflows.clear();
  any.lubrication.evaluate(any.step(0.1), any.v);
  EXPECT_EQ(any.lubrication.outflow().cwiseAbs().sum(), 0.0);
  EXPECT_EQ(any.lubrication.leaked().cwiseAbs().sum(), 0.0);
}

}  // namespace
}  // namespace perifrac
