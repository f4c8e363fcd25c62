#include "coupling/link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::Line;
using fake::Socket;
using testing::ElementsAre;

using Values = std::vector<double>;

/// A source that answers theta to p, and a target that takes theta and answers p. Ports 0 are in,
/// ports 1 out.
struct Pair {
  explicit Pair(bool lagged = true)
      : source({{"p", "Pa", PortDirection::in},
                {.name = "theta", .unit = "1", .negligible = negligible_strain}},
               points.set(), true),
        target({{"theta", "1", PortDirection::in}, {"p", "Pa", PortDirection::out}}, points.set(),
               true),
        link({"solid", &source, 1}, {"pore_flow", &target, 0}, lagged) {}

  /// What the target is told theta is, `before` the end of the window, if its own p is `p`.
  Values told(double before, const Values& p) const {
    const Socket::Values& in = target.at[0];
    Values theta(in.value.size());
    for (std::size_t i = 0; i < theta.size(); ++i) {
      theta[i] = in.value[i] - in.rate[i] * before + in.slope[i] * p[i];
    }
    return theta;
  }

  Line points{2};
  Socket source;
  Socket target;
  Link link;
};

TEST(Link, AnAgreeingTargetIsToldTheOutputItself) {
  Pair pair;
  pair.link.use_slope(0);
  pair.source.at[1].slope = {0.5, 0.25};
  // The source saw p = value + slope x own output: {3, 5} + {2, 0} * {10, 20}.
  pair.source.at[0].value = {3.0, 5.0};
  pair.source.at[0].slope = {2.0, 0.0};
  pair.source.at[1].value = {10.0, 20.0};
  pair.link.start();
  pair.link.predict(0.0);
  pair.link.deliver();
  EXPECT_EQ(pair.target.at[0].slope, (Values{0.5, 0.25}));
  EXPECT_EQ(pair.told(0.0, {23.0, 5.0}), (Values{10.0, 20.0}));
  // One that differs by 1 is told the source's first answer to that.
  EXPECT_EQ(pair.told(0.0, {24.0, 6.0}), (Values{10.5, 20.25}));
}

TEST(Link, ValueAndRateRunFromTheLastWindowsEndToThisOnes) {
  Pair pair;
  pair.link.use_slope(0);
  pair.source.at[1].slope = {0.5, 0.25};
  pair.source.at[0].slope = {0.0, 0.0};
  pair.source.at[0].value = {1.0, 2.0};
  pair.source.at[1].value = {10.0, 20.0};
  pair.link.start();
  pair.link.predict(2.0);
  pair.link.deliver();
  EXPECT_EQ(pair.told(0.0, {1.0, 2.0}), (Values{10.0, 20.0})) << "no rate is known yet";

  pair.source.at[0].value = {3.0, 2.0};
  pair.source.at[1].value = {14.0, 26.0};
  pair.link.collect(2.0);
  pair.link.deliver();
  EXPECT_EQ(pair.told(0.0, {3.0, 2.0}), (Values{14.0, 26.0}));
  EXPECT_EQ(pair.told(2.0, {1.0, 2.0}), (Values{10.0, 20.0})) << "the window's beginning";

  // An accelerated value may be another one: the window's beginning is not.
  pair.link.relax(Values{7.0, 7.0}, 2.0);
  pair.link.deliver();
  EXPECT_EQ(pair.target.at[0].value, (Values{7.0, 7.0}));
  EXPECT_EQ(pair.told(2.0, {1.0, 2.0}), (Values{10.0, 20.0}));

  // The next window starts on a straight line through the two.
  pair.link.accept();
  pair.link.predict(1.0);
  pair.link.deliver();
  EXPECT_EQ(pair.told(0.0, {4.0, 2.0}), (Values{16.0, 29.0}));
  EXPECT_EQ(pair.told(1.0, {3.0, 2.0}), (Values{14.0, 26.0}));
}

TEST(Link, PredictsNoChangeWhereItIsTold) {
  Pair pair;
  pair.link.use_slope(0);
  pair.link.predict_no_change();
  pair.source.at[0].slope = {0.0, 0.0};
  pair.source.at[1].value = {10.0, 20.0};
  pair.link.start();
  pair.link.predict(2.0);
  pair.link.deliver();
  pair.source.at[1].value = {14.0, 26.0};
  pair.link.collect(2.0);
  pair.link.accept();
  pair.link.predict(1.0);
  pair.link.deliver();
  EXPECT_EQ(pair.told(0.0, {0.0, 0.0}), (Values{14.0, 26.0}));
  EXPECT_EQ(pair.told(1.0, {0.0, 0.0}), (Values{14.0, 26.0}));
}

/// What answers a total over the window answers what of it differs from the last window's pace.
TEST(Link, ATotalBeginsEveryWindowAtNothing) {
  const Line points{1};
  Socket source({{"mass", "kg", PortDirection::in, PortKind::extensive},
                 {"pressure", "Pa", PortDirection::out}},
                points.set(), true);
  Socket target({{"pressure", "Pa", PortDirection::in}}, points.set(), true);
  Link link({"pores", &source, 1}, {"fluid", &target, 0}, true);
  source.at[0].slope.clear();
  link.use_slope(0);
  link.start();
  source.at[1].slope = {5.0};
  const auto told = [&](double before, double mass) {
    const Socket::Values& in = target.at[0];
    return in.value[0] - in.rate[0] * before + in.slope[0] * mass;
  };
  link.predict(2.0);
  source.at[0].value = {8.0};  // 4 a second
  source.at[1].value = {10.0};
  link.collect(2.0);
  link.deliver();
  EXPECT_EQ(told(0.0, 8.0), 10.0) << "the same window again";
  EXPECT_EQ(told(2.0, 0.0), 0.0) << "its beginning";

  link.accept();
  link.predict(1.0);
  link.deliver();
  EXPECT_EQ(told(1.0, 0.0), 10.0);
  EXPECT_EQ(told(0.0, 4.0), 15.0) << "at the pace of the last window";
  EXPECT_EQ(told(0.0, 4.5), 17.5);
}

TEST(Link, AWindowOfNoLengthHasNoRate) {
  Pair pair;
  pair.source.at[1].value = {10.0, 20.0};
  pair.link.start();
  pair.link.predict(0.0);
  pair.source.at[1].value = {11.0, 22.0};
  pair.link.collect(0.0);
  pair.link.deliver();
  EXPECT_EQ(pair.target.at[0].value, (Values{11.0, 22.0}));
  EXPECT_EQ(pair.target.at[0].rate, (Values{0.0, 0.0}));
}

TEST(Link, WithoutASlopeNoneIsLeftOver) {
  Pair pair;
  pair.target.at[0].slope = {9.0, 9.0};
  pair.link.start();
  pair.link.predict(0.0);
  pair.link.deliver();
  EXPECT_EQ(pair.target.at[0].slope, (Values{0.0, 0.0}));
}

TEST(Link, TheMismatchIsWhatWasUsedAgainstTheAnswer) {
  Pair pair;
  pair.source.at[1].value = {3.0, 4.0};
  pair.link.start();
  pair.link.predict(1.0);
  pair.source.at[1].value = {6.0, 8.0};
  pair.link.collect(1.0);
  EXPECT_DOUBLE_EQ(pair.link.mismatch().absolute, 5.0);
  EXPECT_DOUBLE_EQ(pair.link.mismatch().relative(), 0.5);
}

/// Such as the dilatation of a body at rest, which is compared with nothing.
TEST(Link, AStrainOfRoundingIsNoMismatch) {
  Pair pair;
  const auto mismatch = [&](double theta) {
    pair.source.at[1].value = {0.0, 0.0};
    pair.link.start();
    pair.link.predict(1.0);
    pair.source.at[1].value = {theta, 0.0};
    pair.link.collect(1.0);
    return pair.link.mismatch().relative();
  };
  EXPECT_EQ(mismatch(1e-16), 0.0);
  EXPECT_GT(mismatch(1e-15), 0.5);
}

TEST(Link, ASourceThatChangesItsPointsIsFollowed) {
  for (const PortKind kind : {PortKind::intensive, PortKind::extensive}) {
    const Line two(2, "few");
    const Line three(3, "few but one more");
    const Line wall(3, "wall");
    Socket source({{"q", "kg", PortDirection::out, kind}}, two.set());
    Socket target({{"q", "kg", PortDirection::in, kind}}, wall.set());
    Link link({"a", &source, 0}, {"b", &target, 0}, true);
    source.at[0].value = {1.0, 2.0};
    link.start();
    link.predict(2.0);
    link.deliver();
    source.at[0] = {three.set(), {5.0, 6.0, 7.0}, {}, {}};
    link.collect(2.0);
    if (kind == PortKind::intensive) {
      EXPECT_THAT(target.at[0].value, ElementsAre(1.0, 2.0, 2.0));
      EXPECT_THAT(Values(link.used().begin(), link.used().end()), ElementsAre(1.0, 2.0, 2.0));
    } else {
      EXPECT_THAT(target.at[0].value, ElementsAre(1.0, 2.0, 0.0));
      EXPECT_THAT(Values(link.used().begin(), link.used().end()), ElementsAre(1.0, 2.0, 0.0));
    }
    link.deliver();
    EXPECT_THAT(target.at[0].value, ElementsAre(5.0, 6.0, 7.0));
    if (kind == PortKind::intensive) {
      EXPECT_THAT(target.at[0].rate, ElementsAre(2.0, 2.0, 2.5));
    } else {
      EXPECT_THAT(target.at[0].rate, ElementsAre(2.5, 3.0, 3.5)) << "a total grows from nothing";
    }
  }
}

TEST(Link, RefusesValuesThatAreNotOnTheirPoints) {
  Pair pair;
  pair.link.start();
  pair.link.predict(0.0);
  pair.target.at[0].value.resize(1);
  EXPECT_THROW(pair.link.deliver(), std::logic_error);
}

/// Two quantities sent to and fro, x = matrix of the other's answer, the second in units of `unit`.
std::int64_t passes_in_units_of(double unit, AccelerationType acceleration) {
  const Line line(1);
  const std::vector<Port> there = {{"x", "1", PortDirection::in},
                                   {"y", "1", PortDirection::in},
                                   {"u", "1", PortDirection::out},
                                   {"v", "1", PortDirection::out}};
  const std::vector<Port> back = {{"u", "1", PortDirection::in},
                                  {"v", "1", PortDirection::in},
                                  {"x", "1", PortDirection::out},
                                  {"y", "1", PortDirection::out}};
  auto first = std::make_unique<Socket>(there, line.set());
  auto second = std::make_unique<Socket>(back, line.set());
  first->respond = [&a = *first](const TimeWindow&) {
    a.at[2].value = a.at[0].value;
    a.at[3].value = a.at[1].value;
  };
  second->respond = [unit, &b = *second](const TimeWindow&) {
    const double u = b.at[0].value[0];
    const double v = b.at[1].value[0] / unit;
    b.at[2].value[0] = 1.0 - 0.9 * u + 0.2 * v;
    b.at[3].value[0] = unit * (2.0 + 0.1 * u + 0.8 * v);
  };
  std::vector<ModuleSlot> modules;
  modules.push_back({"first", std::move(first)});
  modules.push_back({"second", std::move(second)});
  CouplingOptions options = fake::even_windows(1.0);
  options.acceleration = acceleration;
  CouplingManager manager(std::move(modules), options);
  manager.initialize(0.0);
  manager.settle();
  return manager.work().passes;
}

TEST(Link, UnitsOfWhatIsExchangedDoNotMatterToAccelerations) {
  for (const auto type : {AccelerationType::aitken, AccelerationType::anderson}) {
    EXPECT_EQ(passes_in_units_of(0x1p40, type), passes_in_units_of(1.0, type));
  }
  EXPECT_LE(passes_in_units_of(0x1p40, AccelerationType::anderson), 6);
}

TEST(Link, PointsThatComeInAWindowStartTheAccelerationOver) {
  const Line two(2, "few");
  const Line three(3, "few but one more");
  auto target = std::make_unique<Socket>(
      std::vector<Port>{{"x", "1", PortDirection::in}, {"u", "1", PortDirection::out}}, two.set());
  auto source = std::make_unique<Socket>(
      std::vector<Port>{{"u", "1", PortDirection::in}, {"x", "1", PortDirection::out}}, two.set());
  target->respond = [&t = *target](const TimeWindow&) { t.at[1].value = t.at[0].value; };
  source->respond = [&s = *source, &three, pass = 0](const TimeWindow&) mutable {
    if (++pass == 4) s.at[1].points = three.set();
    s.at[1].value = {1.0 - 0.9 * s.at[0].value[0], 2.0 - 0.8 * s.at[0].value[1]};
    if (pass >= 4) s.at[1].value.push_back(7.0);
  };
  const Socket& solved = *target;
  std::vector<ModuleSlot> modules;
  modules.push_back({"target", std::move(target)});
  modules.push_back({"source", std::move(source)});
  CouplingOptions options = fake::even_windows(1.0);
  options.acceleration = AccelerationType::anderson;
  CouplingManager manager(std::move(modules), options);
  manager.initialize(0.0);
  manager.settle();
  EXPECT_NEAR(solved.at[0].value[0], 1.0 / 1.9, 1e-9);
  EXPECT_NEAR(solved.at[0].value[1], 2.0 / 1.8, 1e-9);
}

}  // namespace
}  // namespace perifrac
