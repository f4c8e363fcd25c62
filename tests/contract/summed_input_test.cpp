#include "coupling/summed_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/state/snapshot.hpp"
#include "tests/contract/fake_modules.hpp"

/// Modules that hand over totals to one in-port of another, each told how that answers its own.
namespace perifrac {
namespace {

using fake::Line;
using fake::Socket;
using testing::ElementsAre;
using Values = std::vector<double>;

/// Wells on the points of one reservoir, p = p0 + s sum m, that all feel: m = L c (well - p) at the
/// window's end, in the order of their names. Backward Euler of each, with what the others do as it
/// is told.
struct Reservoir {
  /// By well: conductance and pressure, the same at all points.
  explicit Reservoir(std::vector<std::pair<double, double>> wells, CouplingOptions options,
                     double drain = 0.0) {
    const Port out_mass{"m", "kg", PortDirection::out, PortKind::extensive};
    const Port in_pressure{"p", "Pa", PortDirection::in};
    std::vector<ModuleSlot> modules;
    for (std::size_t k = 0; k < wells.size(); ++k) {
      auto well =
          std::make_unique<Socket>(std::vector<Port>{in_pressure, out_mass}, line.set(), true);
      well->at[1].slope.clear();
      Socket* const self = well.get();
      well->respond = [self, of = wells[k]](const TimeWindow& window) {
        const auto& in = self->at[0];
        for (std::size_t i = 0; i < in.value.size(); ++i) {
          const double c = window.length() * of.first;
          self->at[1].value[i] = c * (of.second - in.value[i]) / (1.0 + c * in.slope[i]);
        }
      };
      modules.push_back({"well" + std::to_string(k), std::move(well)});
    }
    auto rock = std::make_unique<Socket>(
        std::vector<Port>{{"m", "kg", PortDirection::in, PortKind::extensive},
                          {"p", "Pa", PortDirection::out}},
        line.set(), true);
    pores = rock.get();
    pores->at[0].slope.clear();
    pores->at[1].slope.assign(2, slope);
    pores->respond = [this, drain](const TimeWindow& window) {
      for (std::size_t i = 0; i < 2; ++i) {
        double& p = pores->at[1].value[i];
        p = (p + slope * pores->at[0].value[i]) / (1.0 + drain * window.length());
      }
    };
    modules.push_back({"rock", std::move(rock)});
    manager.emplace(std::move(modules), options);
    manager->initialize(0.0);
  }

  double mass(int well) { return manager->modules()[well].module->port(1).value[0]; }
  double pressure() { return pores->at[1].value[0]; }

  static constexpr double slope = 2.0;
  Line line{2};
  Socket* pores = nullptr;
  std::optional<CouplingManager> manager;
};

CouplingOptions one_pass() {
  CouplingOptions options = fake::even_windows(0.1);
  options.max_iterations = 1;
  return options;
}

TEST(SummedInput, ThePoresGetTheExactSumOfWhatWellsGive) {
  Reservoir reservoir({{0.3, 1.0}, {0.7, 3.0}, {0.1, 2.0}}, one_pass());
  double before = 0.0;
  Values passed(3, 0.0);
  for (int window = 0; window < 5; ++window) {
    reservoir.manager->advance(1.0);
    const double sum = reservoir.mass(0) + reservoir.mass(1) + reservoir.mass(2);
    EXPECT_EQ(reservoir.pores->at[0].value[0], sum);
    EXPECT_NEAR(reservoir.pressure() - before, 2.0 * sum, 1e-15);
    before = reservoir.pressure();
    for (int k = 0; k < 3; ++k) passed[k] += 2.0 * reservoir.mass(k);  // two points
  }
  const auto columns = reservoir.manager->ledger().columns();
  ASSERT_EQ(columns.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(columns[k].name, "m_from_well" + std::to_string(k));
    EXPECT_EQ(columns[k].unit, "kg");
    EXPECT_NEAR(columns[k].value, passed[k], 1e-15);
  }
}

/// Each takes off its own share and adds its own answer; those before it are told as they are in
/// this window, those after it at the pace of the last one.
TEST(SummedInput, EachIsToldTheOthersAndItself) {
  Reservoir reservoir({{0.3, 1.0}, {0.7, 3.0}}, one_pass());
  double p = 0.0, second_before = 0.0;
  for (int window = 0; window < 6; ++window) {
    reservoir.manager->advance(1.0);
    const double c0 = 0.03, c1 = 0.07;
    const double first = c0 * (1.0 - p - 2.0 * second_before) / (1.0 + c0 * 2.0);
    const double second = c1 * (3.0 - p - 2.0 * first) / (1.0 + c1 * 2.0);
    EXPECT_NEAR(reservoir.mass(0), first, 1e-15) << window;
    EXPECT_NEAR(reservoir.mass(1), second, 1e-15) << window;
    p += 2.0 * (first + second);
    second_before = second;
  }
}

/// Told the others at the pace of the last window only, windows long beside the filling would swing
/// by -1 - sqrt(2) each.
TEST(SummedInput, LongWindowsAreStable) {
  Reservoir reservoir({{1e6, 2.0}, {1e6, 2.0}}, one_pass());
  for (int window = 0; window < 40; ++window) {
    reservoir.manager->advance(1e9);
    EXPECT_LE(std::abs(reservoir.pressure()), 2.001) << window;
  }
  EXPECT_NEAR(reservoir.pressure(), 2.0, 1e-6);
}

TEST(SummedInput, GoesOnBitForBitAfterARollback) {
  Reservoir whole({{0.3, 1.0}, {0.7, 3.0}}, one_pass()),
      other({{0.3, 1.0}, {0.7, 3.0}}, one_pass());
  for (int window = 0; window < 3; ++window) whole.manager->advance(10.0);
  Snapshot middle;
  middle.save([&](StateVisitor& visitor) { whole.manager->visit_state(visitor); });
  middle.restore([&](StateVisitor& visitor) { other.manager->visit_state(visitor); });
  for (std::size_t k = 0; k < 3; ++k) {  // stand-ins show no state
    auto& from = static_cast<Socket&>(*whole.manager->modules()[k].module);
    static_cast<Socket&>(*other.manager->modules()[k].module).at = from.at;
  }
  for (int window = 0; window < 3; ++window) {
    whole.manager->advance(10.0);
    other.manager->advance(10.0);
    EXPECT_EQ(whole.pressure(), other.pressure());
  }
  const auto a = whole.manager->ledger().columns(), b = other.manager->ledger().columns();
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].value, b[k].value);
}

}  // namespace
}  // namespace perifrac
