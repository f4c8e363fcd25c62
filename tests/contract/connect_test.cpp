#include "coupling/connect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

const PointSet point{.name = "point"};

std::vector<ModuleSlot> bare(std::vector<std::vector<Port>> ports, bool sloped = false) {
  std::vector<ModuleSlot> modules;
  for (auto& list : ports) {
    modules.push_back({std::string(1, static_cast<char>('a' + modules.size())),
                       std::make_unique<fake::Socket>(std::move(list), &point, sloped)});
  }
  return modules;
}

const Port heat_in{"heat", "J", PortDirection::in};
const Port heat_out{"heat", "J", PortDirection::out};

TEST(Connect, LinksPortsOfOneNameAndLeavesTheOthers) {
  auto modules = bare({{heat_in, {"pressure", "Pa", PortDirection::in}},
                       {{"speed", "m/s", PortDirection::out}, heat_out}});
  const auto links = connect(modules, Split::fixed_stress);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].path(), "b.heat -> a");
  EXPECT_TRUE(links[0].lagged()) << "b advances after a";
}

TEST(Connect, OneOutPortFeedsManyInPorts) {
  auto modules = bare({{heat_out}, {heat_in}, {heat_in}});
  EXPECT_EQ(connect(modules, Split::drained).size(), 2u);
}

TEST(Connect, RefusesTwoWriters) {
  auto modules = bare({{heat_in}, {heat_out}, {heat_out}});
  EXPECT_THROW(connect(modules, Split::drained), std::logic_error);
}

TEST(Connect, TotalsOfSeveralModulesAddUp) {
  const Port in{"heat", "J", PortDirection::in, PortKind::extensive};
  const Port out{"heat", "J", PortDirection::out, PortKind::extensive};
  auto modules = bare({{out}, {in}, {out}});
  const auto links = connect(modules, Split::drained);
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[0].sum(), links[1].sum());
  EXPECT_TRUE(links[0].is_first_of_sum());
  EXPECT_FALSE(links[1].is_first_of_sum());
  auto one_writer = bare({{out}, {in}});
  EXPECT_EQ(connect(one_writer, Split::drained)[0].sum(), nullptr);
}

TEST(Connect, RefusesPortsThatDoNotFit) {
  const std::vector<Port> misfits = {
      {"heat", "kJ", PortDirection::out},
      {"heat", "J", PortDirection::out, PortKind::extensive},
      {"heat", "J", PortDirection::out, PortKind::intensive, PortRole::field, 2}};
  for (const Port& misfit : misfits) {
    auto modules = bare({{heat_in}, {misfit}});
    EXPECT_THROW(connect(modules, Split::drained), std::logic_error);
  }
}

const std::vector<Port> one = {{"p", "Pa", PortDirection::in}, {"theta", "1", PortDirection::out}};
const std::vector<Port> two = {{"p", "Pa", PortDirection::out}, {"theta", "1", PortDirection::in}};

TEST(Connect, FixedStressSendsTheSlopeToTheFirstAndDrainedSendsNone) {
  auto modules = bare({one, two}, true);
  for (const Link& link : connect(modules, Split::fixed_stress)) {
    EXPECT_EQ(link.uses_slope(), link.lagged());
  }
  EXPECT_EQ(modules[0].name, "a");
  const auto drained = connect(modules, Split::drained);
  for (const Link& link : drained) EXPECT_FALSE(link.uses_slope());
  ASSERT_EQ(coupled_pairs(drained).size(), 1u);
  EXPECT_EQ(coupling_strength(drained[0], drained[1]), 1.0);

  auto without = bare({one, two}, false);
  for (const Link& link : connect(without, Split::fixed_stress)) EXPECT_FALSE(link.uses_slope());
}

TEST(Connect, UndrainedPutsTheModuleThatAddsTheSlopeFirst) {
  for (const Split split : {Split::undrained, Split::automatic}) {
    auto modules = bare({{heat_out}, two, {heat_in}, one}, true);
    const auto links = connect(modules, split);
    EXPECT_EQ(modules[0].name + modules[1].name + modules[2].name + modules[3].name, "adbc");
    for (const Link& link : links) {
      EXPECT_EQ(link.uses_slope(), link.name() == "p");
      EXPECT_EQ(link.lagged(), link.name() == "p") << link.path();
    }
  }
}

/// The later module adds no slope: nothing is moved, and only `automatic` falls back.
TEST(Connect, WithoutAReceiverOfTheSlopeAutomaticIsFixedStress) {
  const auto pair = [] {
    auto modules = bare({two, one}, true);
    auto& solid = static_cast<fake::Socket&>(*modules[1].module);
    solid.at[0].slope.clear();
    return modules;
  };
  for (const Split split : {Split::undrained, Split::automatic}) {
    auto modules = pair();
    const auto links = connect(modules, split);
    EXPECT_EQ(modules[0].name, "a");
    for (const Link& link : links) {
      EXPECT_EQ(link.uses_slope(), split == Split::automatic && link.name() == "theta");
    }
  }
}

/// It is no split: there is no other way round to choose.
TEST(Connect, WhoIsHandedTotalsSendsItsSlopeWhateverTheSplit) {
  for (const Split split :
       {Split::drained, Split::fixed_stress, Split::undrained, Split::automatic}) {
    auto modules = bare(
        {{{"p", "Pa", PortDirection::in}, {"m", "kg", PortDirection::out, PortKind::extensive}},
         {{"p", "Pa", PortDirection::out}, {"m", "kg", PortDirection::in, PortKind::extensive}}},
        true);
    static_cast<fake::Socket&>(*modules[0].module).at[1].slope.clear();
    const auto links = connect(modules, split);
    ASSERT_EQ(links.size(), 2u);
    for (const Link& link : links) EXPECT_EQ(link.uses_slope(), link.name() == "p");
    EXPECT_TRUE(coupled_pairs(links).empty());
  }
}

TEST(Connect, RefusesASlopeThatCouldReferToTwoPorts) {
  auto modules = bare({{{"p", "Pa", PortDirection::in},
                        {"q", "Pa", PortDirection::in},
                        {"theta", "1", PortDirection::out}},
                       {{"p", "Pa", PortDirection::out},
                        {"q", "Pa", PortDirection::out},
                        {"theta", "1", PortDirection::in}}},
                      true);
  EXPECT_THROW(connect(modules, Split::fixed_stress), std::logic_error);
}

}  // namespace
}  // namespace perifrac
