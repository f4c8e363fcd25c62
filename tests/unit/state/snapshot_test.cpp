#include "core/state/snapshot.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A module in miniature: arrays of both types, scalars, a group.
struct State {
  std::vector<double> pressure{1.0, -0.0, 3e-310};
  std::vector<std::int64_t> ids{7, -1};
  double inflow = 0.25;
  std::int64_t inserted = 4;

  void visit(StateVisitor& visitor) {
    visitor.enter("flow");
    visitor.visit("pressure", pressure);
    visitor.visit("inflow", inflow);
    visitor.leave();
    visitor.visit("ids", ids);
    visitor.visit("inserted", inserted);
  }
  StateWalk walk() {
    return [this](StateVisitor& visitor) { visit(visitor); };
  }
  bool operator==(const State&) const = default;
};

TEST(Snapshot, PutsEveryFieldBack) {
  State state;
  const State original = state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  state = {.pressure = {9.0, 9.0, 9.0}, .ids = {0, 0}, .inflow = 9.0, .inserted = 9};
  snapshot.restore(state.walk());
  EXPECT_EQ(state, original);
}

TEST(Snapshot, RestoresTheSavedSizes) {
  State state;
  const State original = state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  state.pressure.assign(100, 5.0);
  state.ids.clear();
  snapshot.restore(state.walk());
  EXPECT_EQ(state, original);
}

TEST(Snapshot, TakesNewSizesWhenSavedAgain) {
  State state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  state.pressure = {1.0, 2.0, 3.0, 4.0, 5.0};
  state.ids = {};
  const State larger = state;
  snapshot.save(state.walk());
  state = State{};
  snapshot.restore(state.walk());
  EXPECT_EQ(state, larger);
}

TEST(Snapshot, UsesItsStorageAgainAtUnchangedSizes) {
  State state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  const auto data = [&] {
    return std::get<std::vector<double>>(snapshot.fields().at("flow/pressure")).data();
  };
  const double* before = data();
  state.pressure[0] = 8.0;
  snapshot.save(state.walk());
  EXPECT_EQ(data(), before);
  EXPECT_EQ(before[0], 8.0);
}

TEST(Snapshot, ForgetsFieldsThatAreNoLongerShown) {
  State state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  const StateWalk ids_only = [&](StateVisitor& visitor) { visitor.visit("ids", state.ids); };
  snapshot.save(ids_only);
  EXPECT_EQ(snapshot.fields().size(), 1u);
  EXPECT_NO_THROW(snapshot.restore(ids_only));
}

TEST(Snapshot, HasADigestThatFollowsEveryBit) {
  State state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  const std::int64_t before = snapshot.digest();
  snapshot.save(state.walk());
  EXPECT_EQ(snapshot.digest(), before);
  state.pressure[1] = 0.0;
  snapshot.save(state.walk());
  EXPECT_NE(snapshot.digest(), before);
  state.pressure[1] = -0.0;
  std::swap(state.pressure[0], state.pressure[2]);
  snapshot.save(state.walk());
  EXPECT_NE(snapshot.digest(), before);
}

TEST(Snapshot, RefusesAFieldThatWasNotSaved) {
  State state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  double extra = 0.0;
  const StateWalk with_extra = [&](StateVisitor& visitor) {
    state.visit(visitor);
    visitor.visit("extra", extra);
  };
  EXPECT_THAT([&] { snapshot.restore(with_extra); },
              ThrowsMessage<std::logic_error>(HasSubstr("'extra'")));
}

TEST(Snapshot, RefusesToLeaveASavedFieldOut) {
  State state;
  Snapshot snapshot;
  snapshot.save(state.walk());
  const StateWalk ids_only = [&](StateVisitor& visitor) { visitor.visit("ids", state.ids); };
  EXPECT_THAT([&] { snapshot.restore(ids_only); },
              ThrowsMessage<std::logic_error>(HasSubstr("flow/inflow")));
}

TEST(Snapshot, RefusesAnotherType) {
  std::vector<double> real{1.0};
  std::vector<std::int64_t> integer{1};
  Snapshot snapshot;
  snapshot.save([&](StateVisitor& visitor) { visitor.visit("x", real); });
  EXPECT_THROW(snapshot.restore([&](StateVisitor& visitor) { visitor.visit("x", integer); }),
               std::logic_error);
}

TEST(Snapshot, RefusesTheSameNameTwice) {
  std::vector<double> values{1.0};
  const StateWalk twice = [&](StateVisitor& visitor) {
    visitor.visit("x", values);
    visitor.visit("x", values);
  };
  Snapshot snapshot;
  EXPECT_THROW(snapshot.save(twice), std::logic_error);
}

}  // namespace
}  // namespace perifrac
