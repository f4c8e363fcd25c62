#include "coupling/ledger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::Consolidation;
using fake::even_windows;

Balance mass_after(double leak) {
  Consolidation consolidation({.leak = leak}, even_windows(0.1));
  consolidation.run(1.0);
  const auto mass = consolidation.manager.ledger().mass();
  EXPECT_TRUE(mass.has_value());
  return mass.value_or(Balance{});
}

TEST(Ledger, ClosesWhereNothingIsLost) {
  const Balance mass = mass_after(0.0);
  EXPECT_LT(mass.stored, -0.1) << "nothing has moved";
  EXPECT_LE(mass.relative_error, 1e-14);
}

TEST(Ledger, FindsAPlantedLeak) {
  // 4 points lose 1e-6 a second.
  const Balance mass = mass_after(1e-6);
  EXPECT_NEAR(mass.error, -4e-6, 1e-9);
  EXPECT_GT(mass.relative_error, 1e-6);
}

/// Values on ports of any roles, to be changed by hand.
class Books final : public PhysicsModule {
 public:
  struct Entry {
    std::string name;
    PortRole role;
    double value;
  };
  explicit Books(const std::vector<Entry>& entries) {
    for (const auto& [name, role, value] : entries) {
      ports_.push_back({name, "kg", PortDirection::out, PortKind::extensive, role});
      values.push_back(value);
    }
  }
  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override { return {.points = &point_, .value = {&values[id], 1}}; }
  void initialize(double) override {}
  double stable_time_step() const override { return 1.0; }
  double advance(const TimeWindow& window) override { return window.end; }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}

  std::vector<double> values;

 private:
  std::vector<Port> ports_;
  PointSet point_{.name = "total"};
};

std::vector<std::string> names_of(const std::vector<LedgerColumn>& columns) {
  std::vector<std::string> names;
  for (const LedgerColumn& column : columns) names.push_back(column.name);
  return names;
}

TEST(Ledger, AddsEnergyOverModulesSinceTheStart) {
  std::vector<ModuleSlot> modules;
  const auto account = [](double stored) {
    return std::make_unique<Books>(
        std::vector<Books::Entry>{{"elastic", PortRole::energy_stored, stored},
                                  {"work", PortRole::energy_gained, 0.0},
                                  {"friction", PortRole::energy_dissipated, 0.0}});
  };
  modules.push_back({"one", account(100.0)});
  modules.push_back({"two", account(20.0)});
  Ledger ledger(modules);
  ledger.start();
  static_cast<Books&>(*modules[0].module).values = {105.0, 10.0, 3.0};
  static_cast<Books&>(*modules[1].module).values[0] = 22.0;
  ASSERT_TRUE(ledger.energy().has_value());
  EXPECT_DOUBLE_EQ(ledger.energy()->stored, 127.0);
  EXPECT_DOUBLE_EQ(ledger.energy()->gained, 10.0);
  EXPECT_DOUBLE_EQ(ledger.energy()->dissipated, 3.0);
  EXPECT_DOUBLE_EQ(ledger.energy()->error, 0.0);
  static_cast<Books&>(*modules[1].module).values[1] = 1.27;
  EXPECT_NEAR(ledger.energy()->error, -1.27, 1e-12);
  EXPECT_NEAR(ledger.energy()->relative_error, 0.01, 1e-12);

  EXPECT_FALSE(ledger.mass().has_value());
  EXPECT_THAT(
      names_of(ledger.columns()),
      testing::ElementsAre("energy_stored", "energy_gained", "energy_dissipated", "energy_error",
                           "elastic", "elastic", "work", "work", "friction", "friction"));
}

TEST(Ledger, ShowsEachMassWhereThereAreSeveral) {
  const std::vector<std::string> sums = {"fluid_mass_stored", "fluid_mass_gained",
                                         "fluid_mass_error"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), sums.begin(), sums.end());
    return more;
  };
  const Books::Entry free{"free", PortRole::mass_stored, 100.0},
      injected{"injected", PortRole::mass_gained, 3.0},
      removed{"removed", PortRole::mass_gained, -1.0}, pores{"pores", PortRole::mass_stored, 7.0},
      drained{"drained", PortRole::mass_gained, -0.5}, rest{"rest", PortRole::mass_reference, 50.0};
  std::vector<ModuleSlot> modules;
  modules.push_back({"pore_flow", std::make_unique<Books>(std::vector{pores, rest, drained})});
  Ledger one(modules);
  one.start();
  EXPECT_EQ(names_of(one.columns()), sums);
  modules.clear();
  modules.push_back({"fluid", std::make_unique<Books>(std::vector{free, injected, removed})});
  Ledger fluid(modules);
  fluid.start();
  EXPECT_EQ(names_of(fluid.columns()), with({"injected", "removed"}));
  modules.push_back({"pore_flow", std::make_unique<Books>(std::vector{pores, rest, drained})});
  Ledger both(modules);
  both.start();
  EXPECT_EQ(names_of(both.columns()), with({"free", "pores", "injected", "removed", "drained"}));
  EXPECT_DOUBLE_EQ(both.columns()[4].value, 7.0);
  EXPECT_DOUBLE_EQ(both.columns()[7].value, -0.5);
}

TEST(Ledger, StopsARunWhoseMassHasDriftedBeyondTheBound) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"flow", std::make_unique<Books>(std::vector<Books::Entry>{
                                 {"stored", PortRole::mass_stored, 0.0},
                                 {"rest", PortRole::mass_reference, 1000.0},
                                 {"gained", PortRole::mass_gained, 0.0}})});
  std::vector<double>& values = static_cast<Books&>(*modules[0].module).values;
  Ledger ledger(modules);
  ledger.start();
  values = {2.0, 1000.0, 2.0 * (1.0 - 0.9e-6)};
  EXPECT_NO_THROW(ledger.check_mass(1e-6, 1.0));
  values = {2.0, 1000.0, 2.0 * (1.0 - 1.1e-6)};
  EXPECT_THROW(ledger.check_mass(1e-6, 1.0), NumericalError);
  EXPECT_NO_THROW(ledger.check_mass(2e-6, 1.0));
  // Nothing flowed: all that is there is rounding of a thousand times a thousand million of it.
  values = {0.9e-9, 1000.0, 0.0};
  EXPECT_EQ(ledger.mass()->relative_error, 1.0);
  EXPECT_NO_THROW(ledger.check_mass(1e-6, 1.0));
  values = {1.1e-9, 1000.0, 0.0};
  EXPECT_THROW(ledger.check_mass(1e-6, 1.0), NumericalError);
}

TEST(Ledger, KeepsTwelveDigitsOfAHugeMass) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"fluid", std::make_unique<Books>(std::vector<Books::Entry>{
                                  {"free", PortRole::mass_stored, 1e9}})});
  modules.push_back({"pores", std::make_unique<Books>(std::vector<Books::Entry>{
                                  {"pores", PortRole::mass_stored, 1e-3}})});
  Ledger ledger(modules);
  ledger.start();
  static_cast<Books&>(*modules[0].module).values[0] -= 1e-3;
  static_cast<Books&>(*modules[1].module).values[0] += 2e-3;
  EXPECT_NEAR(ledger.mass()->error, 1e-3, 2e-7);
  EXPECT_NEAR(ledger.mass()->relative_error, 1e-12, 2e-16);
}

TEST(Ledger, ShowsArtificialMassAndDoesNotExcuseIt) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"smoothed", std::make_unique<Books>(std::vector<Books::Entry>{
                                     {"mass", PortRole::mass_stored, 8.0},
                                     {"made", PortRole::mass_artificial, 0.0}})});
  Ledger ledger(modules);
  ledger.start();
  static_cast<Books&>(*modules[0].module).values = {10.0, 2.0};
  EXPECT_DOUBLE_EQ(ledger.mass()->error, 2.0);
  EXPECT_DOUBLE_EQ(ledger.mass()->relative_error, 0.2);
  const auto columns = ledger.columns();
  ASSERT_EQ(columns.size(), 4u);
  EXPECT_EQ(columns[3].name, "fluid_mass_artificial");
  EXPECT_DOUBLE_EQ(columns[3].value, 2.0);
}

TEST(Ledger, IsEmptyWithoutPorts) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"alarm", std::make_unique<fake::Alarm>(1.0)});
  Ledger ledger(modules);
  ledger.start();
  EXPECT_TRUE(ledger.columns().empty());
}

}  // namespace
}  // namespace perifrac
