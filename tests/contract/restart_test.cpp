#include <gtest/gtest.h>

#include "core/state/snapshot.hpp"
#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::Consolidation;

Snapshot save(CouplingManager& manager) {
  Snapshot snapshot;
  snapshot.save([&](StateVisitor& visitor) { manager.visit_state(visitor); });
  return snapshot;
}

void restore(CouplingManager& manager, const Snapshot& snapshot) {
  snapshot.restore([&](StateVisitor& visitor) { manager.visit_state(visitor); });
  manager.restart_point();
}

CouplingOptions options(Split split, int iterations) {
  return {.first_window = 0.01,
          .window_growth = 1.3,
          .largest_window = 0.2,
          .split = split,
          .max_iterations = iterations,
          .tolerance = 1e-8,
          .acceleration = AccelerationType::quasi_newton};
}

struct Scheme {
  Split split;
  int iterations;
};

class Restart : public testing::TestWithParam<Scheme> {
 protected:
  const CouplingOptions options_ = options(GetParam().split, GetParam().iterations);
  const Consolidation::Setup setup_ = {.storage = 4.0};
};

TEST_P(Restart, AnotherManagerGoesOnBitForBit) {
  Consolidation whole(setup_, options_);
  whole.run(0.7);
  const Snapshot middle = save(whole.manager);
  whole.manager.restart_point();
  while (whole.manager.time() < 2.0) whole.manager.advance(2.0);

  Consolidation restarted(setup_, options_);
  restore(restarted.manager, middle);
  EXPECT_EQ(restarted.manager.time(), 0.7);
  while (restarted.manager.time() < 2.0) restarted.manager.advance(2.0);

  EXPECT_EQ(save(restarted.manager).fields(), save(whole.manager).fields());
  EXPECT_EQ(restarted.pores->pressure(), whole.pores->pressure());
  EXPECT_EQ(restarted.manager.step(), whole.manager.step());
}

TEST_P(Restart, GoingBackInOneProcessRepeatsBitForBit) {
  Consolidation run(setup_, options_);
  run.run(0.7);
  const Snapshot before = save(run.manager);
  run.manager.restart_point();
  for (int i = 0; i < 3; ++i) run.manager.advance(5.0);
  const Snapshot after = save(run.manager);
  EXPECT_NE(after.fields(), before.fields());
  restore(run.manager, before);
  EXPECT_EQ(save(run.manager).fields(), before.fields());
  for (int i = 0; i < 3; ++i) run.manager.advance(5.0);
  EXPECT_EQ(save(run.manager).fields(), after.fields());
}

TEST_P(Restart, ARestartPointDoesNotChangeTheAnswer) {
  Consolidation plain(setup_, options_);
  Consolidation stopped(setup_, options_);
  plain.run(0.7);
  stopped.run(0.7);
  stopped.manager.restart_point();
  plain.manager.advance(2.0);
  stopped.manager.advance(2.0);
  EXPECT_EQ(stopped.pores->content(), plain.pores->content());
}

INSTANTIATE_TEST_SUITE_P(Schemes, Restart,
                         testing::Values(Scheme{Split::fixed_stress, 1},
                                         Scheme{Split::fixed_stress, 50},
                                         Scheme{Split::drained, 50}),
                         [](const auto& info) { return std::to_string(info.index); });

TEST(RestartChangingPoints, ParticlesThatCameAndWentAreRestored) {
  const auto make = [] {
    std::vector<ModuleSlot> modules;
    modules.push_back({"particles", std::make_unique<fake::Particles>()});
    modules.push_back({"wall", std::make_unique<fake::Wall>()});
    CouplingOptions options = fake::even_windows(0.4);
    options.max_iterations = 60;
    auto manager = std::make_unique<CouplingManager>(std::move(modules), options);
    manager->initialize(0.0);
    return manager;
  };
  const auto whole = make();
  whole->settle();
  for (int i = 0; i < 20; ++i) whole->advance(100.0);
  const Snapshot middle = save(*whole);
  whole->restart_point();
  for (int i = 0; i < 20; ++i) whole->advance(100.0);

  const auto restarted = make();
  restore(*restarted, middle);
  for (int i = 0; i < 20; ++i) restarted->advance(100.0);
  EXPECT_EQ(save(*restarted).fields(), save(*whole).fields());
}

}  // namespace
}  // namespace perifrac
