#include "modules/crack_fluid/carter_leak_off.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

/// What a facet of a metre has leaked by each of some times [m^2], `fill` of it wet then.
std::vector<double> leaked_at(const std::vector<double>& times, const std::vector<double>& fill) {
  const std::vector<CrackFacet<2>> facet(1, CrackFacet<2>{{{0.0, 0.0}, {1.0, 0.0}}});
  const CrackGraph graph(facet);
  CarterLeakOff<2> carter(ByRegion<2, double>{1e-4}, 1000.0);
  carter.match(PointSet{}, graph);
  LeakedFluid step{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), {}};
  std::vector<double> leaked{0.0};
  for (std::size_t k = 1; k < times.size(); ++k) {
    carter.begin({times[k - 1], times[k]}, std::span(&fill[k - 1], 1));
    carter.evaluate({}, Eigen::VectorXd::Constant(1, fill[k]), step);
    carter.accept(std::span(&fill[k], 1));
    leaked.push_back(leaked.back() + step.mass[0] / 1000.0);
  }
  return leaked;
}

/// A front that goes through a facet at a steady speed: 4 C_L sqrt(t - t_0) over all its parts, in
/// steps of any length.
TEST(CarterLeakOff, TakesAFacetAsTheFrontGoesThrough) {
  const std::vector<double> times{2.0, 2.1, 2.4, 2.5, 3.0, 3.5, 7.0};  // full at 3
  std::vector<double> fill;
  for (const double t : times) fill.push_back(std::min(t - 2.0, 1.0));
  const std::vector<double> leaked = leaked_at(times, fill);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double since = times[k] - 2.0, after = std::max(since - 1.0, 0.0);
    const double exact = 4e-4 * 2.0 / 3.0 * (std::pow(since, 1.5) - std::pow(after, 1.5));
    EXPECT_NEAR(leaked[k], exact, 1e-12 * exact) << times[k];
  }
}

/// Where fluid has been before nothing begins anew.
TEST(CarterLeakOff, DrainedAndFilledAgainTakesNoMore) {
  const std::vector<double> leaked = leaked_at({0.0, 1.0, 4.0, 9.0}, {1.0, 1.0, 0.25, 1.0});
  EXPECT_NEAR(leaked[1], 4e-4, 1e-15);
  EXPECT_NEAR(leaked[2] - leaked[1], 0.25 * 4e-4, 1e-15);
  EXPECT_NEAR(leaked[3] - leaked[2], 4e-4, 1e-15);
}

/// A full crack along x through three rocks: each leaks by its own coefficient, facets that come
/// later too.
TEST(CarterLeakOff, DiffersFromRegionToRegion) {
  const ByRegion<2, double> coefficient{
      1e-4, {{{"tight", {1.0, -1.0}, {3.0, 1.0}}, 0.0}, {{"open", {3.0, -1.0}, {9.0, 1.0}}, 3e-4}}};
  const std::vector<double> of_facet{1e-4, 0.0, 0.0, 3e-4};
  CarterLeakOff<2> carter(coefficient, 1000.0);
  std::vector<CrackFacet<2>> facets;
  std::vector<double> x, y;
  for (int count : {2, 4}) {
    while (std::ssize(facets) < count) {
      const double begin = static_cast<double>(facets.size());
      facets.push_back({{{begin, 0.0}, {begin + 1.0, 0.0}}});
      x.push_back(begin + 0.5);
      y.push_back(0.0);
    }
    PointSet points{.name = "crack", .dimension = 2, .count = facets.size()};
    points.position[0] = x;
    points.position[1] = y;
    const CrackGraph graph{std::span<const CrackFacet<2>>(facets)};
    carter.match(points, graph);
    const std::vector<double> full(count, 1.0);
    LeakedFluid step{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count), {}};
    const double begin = count == 2 ? 0.0 : 1.0, end = begin + 1.0;
    carter.begin({begin, end}, full);
    carter.evaluate({}, Eigen::VectorXd::Ones(count), step);
    carter.accept(full);
    for (int f = 0; f < count; ++f) {
      const double since = f < 2 ? 0.0 : 1.0;
      const double exact = 4e3 * of_facet[f] * (std::sqrt(end - since) - std::sqrt(begin - since));
      EXPECT_NEAR(step.mass[f], exact, 1e-13) << f;
      EXPECT_EQ(carter.coefficient(f), of_facet[f]);
    }
  }
}

}  // namespace
}  // namespace perifrac
