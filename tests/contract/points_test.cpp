#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/frozen_points.hpp"
#include "coupling/mapping.hpp"
#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::even_windows;
using fake::Particles;
using fake::Wall;
using testing::ElementsAre;

/// Points in the plane from a deterministic, irregular sequence.
struct Cloud {
  Cloud(std::string name, std::size_t count, unsigned seed) {
    for (std::size_t i = 0; i < count; ++i) {
      for (auto* axis : {&x, &y}) {
        seed = 1664525u * seed + 1013904223u;
        axis->push_back(static_cast<double>(seed >> 8) / 16777216.0);
      }
    }
    set = {.name = std::move(name), .dimension = 2, .position = {x, y, {}}, .count = count};
  }
  std::vector<double> x, y;
  PointSet set;
};

/// By trying every one; of equals the first.
std::size_t brute_force_nearest(const Cloud& from, std::size_t i, const Cloud& to) {
  std::size_t best = 0;
  const auto distance = [&](std::size_t j) {
    return std::pow(from.x[i] - to.x[j], 2) + std::pow(from.y[i] - to.y[j], 2);
  };
  for (std::size_t j = 1; j < to.x.size(); ++j) {
    if (distance(j) < distance(best)) best = j;
  }
  return best;
}

TEST(Mapping, ConsistentTakesTheNearestValue) {
  const Cloud source("a", 200, 1);
  const Cloud target("b", 331, 2);
  Mapping mapping(PortKind::intensive);
  mapping.update(source.set, target.set);
  std::vector<double> values(400);
  std::iota(values.begin(), values.end(), 0.0);
  std::vector<double> mapped(662, -1.0);
  mapping.apply(values, mapped);
  for (std::size_t i = 0; i < 331; ++i) {
    EXPECT_EQ(mapped[i], values[brute_force_nearest(target, i, source)]);
    EXPECT_EQ(mapped[331 + i], mapped[i] + 200.0) << "second component";
  }
}

TEST(Mapping, ConservativeIsTheTransposeAndKeepsTheSum) {
  const Cloud source("a", 200, 1);
  const Cloud target("b", 57, 2);
  Mapping conservative(PortKind::extensive);
  Mapping consistent(PortKind::intensive);
  conservative.update(source.set, target.set);
  consistent.update(target.set, source.set);
  std::vector<double> masses(200);
  std::vector<double> pressures(57);
  for (std::size_t i = 0; i < masses.size(); ++i) masses[i] = std::sin(1.0 + i);
  for (std::size_t i = 0; i < pressures.size(); ++i) pressures[i] = std::cos(2.0 * i);
  std::vector<double> masses_there(57, 7.0);
  std::vector<double> pressures_here(200);
  conservative.apply(masses, masses_there);
  consistent.apply(pressures, pressures_here);
  const auto sum = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0);
  };
  EXPECT_NEAR(sum(masses_there), sum(masses), 1e-13);
  EXPECT_NEAR(std::inner_product(masses_there.begin(), masses_there.end(), pressures.begin(), 0.0),
              std::inner_product(masses.begin(), masses.end(), pressures_here.begin(), 0.0), 1e-12);
}

TEST(Mapping, IsRebuiltWhenAVersionChanges) {
  Cloud source("a", 3, 1);
  source.x = {0.0, 1.0, 2.0};
  source.y = {0.0, 0.0, 0.0};
  Cloud target("b", 1, 2);
  target.x = {0.1};
  target.y = {0.0};
  Mapping mapping(PortKind::intensive);
  const std::vector<double> values = {10.0, 11.0, 12.0};
  std::vector<double> mapped(1);
  mapping.update(source.set, target.set);
  mapping.apply(values, mapped);
  EXPECT_THAT(mapped, ElementsAre(10.0));
  source.x = {2.0, 1.0, 0.0};
  ++source.set.version;
  mapping.update(source.set, target.set);
  mapping.apply(values, mapped);
  EXPECT_THAT(mapped, ElementsAre(12.0));
}

TEST(Mapping, OneValueWithoutAPlace) {
  const Cloud cloud("a", 3, 1);
  const PointSet single{.name = "total"};
  std::vector<double> on_cloud(3);
  Mapping spread(PortKind::intensive);
  spread.update(single, cloud.set);
  spread.apply(std::vector<double>{4.0}, on_cloud);
  EXPECT_THAT(on_cloud, ElementsAre(4.0, 4.0, 4.0));
  std::vector<double> sum(1);
  Mapping gather(PortKind::extensive);
  gather.update(cloud.set, single);
  gather.apply(std::vector<double>{1.0, 2.0, 4.0}, sum);
  EXPECT_THAT(sum, ElementsAre(7.0));
  EXPECT_THROW(Mapping(PortKind::intensive).update(cloud.set, single), std::logic_error);
  EXPECT_THROW(Mapping(PortKind::extensive).update(single, cloud.set), std::logic_error);
}

TEST(FrozenPoints, KeepThePlaceTheyWereTakenAt) {
  Cloud cloud("a", 2, 1);
  const SharedPoints first = freeze(cloud.set, nullptr);
  const double x = cloud.x[0];
  EXPECT_EQ(freeze(cloud.set, first), first) << "an unchanged version is not copied again";
  cloud.x[0] = 9.0;
  EXPECT_EQ(first->set().position[0][0], x);
  ++cloud.set.version;
  EXPECT_EQ(freeze(cloud.set, first)->set().position[0][0], 9.0);
}

/// Particles and the wall they give mass to.
struct Inflow {
  Inflow(bool wall_first, int iterations) {
    auto from = std::make_unique<Particles>();
    auto to = std::make_unique<Wall>();
    particles = from.get();
    wall = to.get();
    std::vector<ModuleSlot> modules;
    if (wall_first) modules.push_back({"wall", std::move(to)});
    modules.push_back({"particles", std::move(from)});
    if (!wall_first) modules.push_back({"wall", std::move(to)});
    CouplingOptions options = even_windows(0.4);
    options.max_iterations = iterations;
    options.tolerance = 1e-12;
    manager = std::make_unique<CouplingManager>(std::move(modules), options);
    manager->initialize(0.0);
    manager->settle();
  }

  Particles* particles;
  Wall* wall;
  std::unique_ptr<CouplingManager> manager;
};

TEST(ChangingPoints, TotalsArriveToRoundOffWhilePointsComeAndGo) {
  for (const int iterations : {1, 60}) {
    Inflow inflow(false, iterations);
    std::size_t most = 0;
    for (int i = 0; i < 60; ++i) {
      inflow.manager->advance(100.0);
      most = std::max(most, inflow.particles->count());
      ASSERT_NEAR(inflow.wall->taken(), inflow.particles->lost(), 1e-13 * inflow.particles->lost());
    }
    EXPECT_GT(most, 10u);
    EXPECT_LT(inflow.particles->count(), 61u) << "no particle has left";
  }
}

TEST(ChangingPoints, ATotalThatIsLaggedIsLateByOneWindowAndWhole) {
  Inflow inflow(true, 1);
  double lost_before = 0.0;
  for (int i = 0; i < 60; ++i) {
    lost_before = inflow.particles->lost();
    inflow.manager->advance(100.0);
    ASSERT_NEAR(inflow.wall->taken(), lost_before, 1e-13 * (1.0 + lost_before));
  }
  EXPECT_GT(lost_before, 1.0);
}

TEST(ChangingPoints, IteratingAgreesWhichEverWayRoundTheModulesAre) {
  Inflow one(false, 60);
  Inflow other(true, 60);
  for (int i = 0; i < 30; ++i) {
    one.manager->advance(100.0);
    other.manager->advance(100.0);
    ASSERT_EQ(one.particles->count(), other.particles->count());
    ASSERT_NEAR(one.particles->lost(), other.particles->lost(), 1e-9);
    ASSERT_NEAR(one.wall->taken(), other.wall->taken(), 1e-9);
  }
  EXPECT_GT(one.manager->work().passes, 30);
}

}  // namespace
}  // namespace perifrac
