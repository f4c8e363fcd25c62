#include "coupling/ledger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

/// One value on every port of a role.
class Account final : public PhysicsModule {
 public:
  Account(double stored, double gained, double dissipated) : values_{stored, gained, dissipated} {}
  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override { return {.points = &point_, .value = {&values_[id], 1}}; }
  void initialize(double) override {}
  double stable_time_step() const override { return 1.0; }
  double advance(const TimeWindow& window) override { return window.end; }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}

  void change(double stored, double gained, double dissipated) {
    values_[0] += stored;
    values_[1] += gained;
    values_[2] += dissipated;
  }

 private:
  std::vector<Port> ports_ = {
      {"elastic", "J", PortDirection::out, PortKind::extensive, PortRole::energy_stored},
      {"work", "J", PortDirection::out, PortKind::extensive, PortRole::energy_gained},
      {"friction", "J", PortDirection::out, PortKind::extensive, PortRole::energy_dissipated}};
  PointSet point_{.name = "total"};
  double values_[3];
};

TEST(Ledger, AddsEnergyOverModulesSinceTheStart) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"one", std::make_unique<Account>(100.0, 0.0, 0.0)});
  modules.push_back({"two", std::make_unique<Account>(20.0, 0.0, 0.0)});
  Ledger ledger(modules);
  ledger.start();
  static_cast<Account&>(*modules[0].module).change(5.0, 10.0, 3.0);
  static_cast<Account&>(*modules[1].module).change(2.0, 0.0, 0.0);
  ASSERT_TRUE(ledger.energy().has_value());
  EXPECT_DOUBLE_EQ(ledger.energy()->stored, 127.0);
  EXPECT_DOUBLE_EQ(ledger.energy()->gained, 10.0);
  EXPECT_DOUBLE_EQ(ledger.energy()->dissipated, 3.0);
  EXPECT_DOUBLE_EQ(ledger.energy()->error, 0.0);
  static_cast<Account&>(*modules[1].module).change(0.0, 1.27, 0.0);
  EXPECT_NEAR(ledger.energy()->error, -1.27, 1e-12);
  EXPECT_NEAR(ledger.energy()->relative_error, 0.01, 1e-12);

  EXPECT_FALSE(ledger.mass().has_value());
  std::vector<std::string> names;
  for (const LedgerColumn& column : ledger.columns()) names.push_back(column.name);
  EXPECT_THAT(names, testing::ElementsAre("energy_stored", "energy_gained", "energy_dissipated",
                                          "energy_error"));
}

/// Holds fluid, some of which a numerical measure made.
class Smoothed final : public PhysicsModule {
 public:
  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override { return {.points = &point_, .value = {&values_[id], 1}}; }
  void initialize(double) override {}
  double stable_time_step() const override { return 1.0; }
  double advance(const TimeWindow& window) override { return window.end; }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}

  void make(double mass) {
    for (double& value : values_) value += mass;
  }

 private:
  std::vector<Port> ports_ = {
      {"mass", "kg", PortDirection::out, PortKind::extensive, PortRole::mass_stored},
      {"made", "kg", PortDirection::out, PortKind::extensive, PortRole::mass_artificial}};
  PointSet point_{.name = "total"};
  double values_[2] = {8.0, 0.0};
};

TEST(Ledger, ShowsArtificialMassAndDoesNotExcuseIt) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"smoothed", std::make_unique<Smoothed>()});
  Ledger ledger(modules);
  ledger.start();
  static_cast<Smoothed&>(*modules[0].module).make(2.0);
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
