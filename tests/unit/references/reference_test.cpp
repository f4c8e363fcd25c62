#include "app/references/reference.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/state/snapshot.hpp"

namespace perifrac {
namespace {

/// Compares `state`, which a run would change, with 2 t.
Reference reference_of(const double& state) {
  Reference reference("made_up", "Twice the time", 10.0);
  const auto exact = [](double t) { return 2.0 * t; };
  reference.add(Reference::History{"state at home", "Pa", [&] { return state; }, exact});
  reference.add(Reference::Rate{"rate at home", "Pa/s", 0});
  reference.add(Reference::Error{"state_error", [&](double t) { return state - 2.0 * t; }});
  reference.add(Reference::Profile{"state along x",
                                   "Pa",
                                   "x",
                                   {1.0, 3.0},
                                   [&](std::size_t n) { return state + n; },
                                   [](double x, double t) { return x * t; }});
  reference.add(Reference::Figure{"peak", "Pa", 9.0, 2.0, 0,
                                  [](auto times, auto values) -> std::optional<double> {
                                    if (times.size() < 2) return {};
                                    return *std::ranges::max_element(values);
                                  }});
  return reference;
}

TEST(Reference, TellsWhatWasRecorded) {
  double state = 5.0;
  Reference reference = reference_of(state);
  reference.record_history(1.0);
  EXPECT_FALSE(reference.summary().contains("quantities")) << "a figure before it is known";
  state = 8.0;
  reference.record_history(2.0);
  reference.record_output(2.0);
  const nlohmann::json summary = reference.summary();
  EXPECT_EQ(summary["type"], "made_up");
  EXPECT_EQ(summary["table"], nlohmann::json::parse(R"([
      {"time": 2.0, "dimensionless_time": 0.2, "state_error": 4.0}])"));
  EXPECT_EQ(summary["histories"][0]["time"], nlohmann::json({1.0, 2.0}));
  EXPECT_EQ(summary["histories"][0]["computed"], nlohmann::json({5.0, 8.0}));
  EXPECT_EQ(summary["histories"][0]["exact"], nlohmann::json({2.0, 4.0}));
  EXPECT_EQ(summary["histories"][1], nlohmann::json::parse(R"({
      "name": "rate at home", "unit": "Pa/s", "time": [1.5], "computed": [3.0], "exact": [2.0]})"));
  EXPECT_EQ(summary["profiles"][0]["computed"], nlohmann::json::parse("[[8.0, 9.0]]"));
  EXPECT_EQ(summary["profiles"][0]["exact"], nlohmann::json::parse("[[2.0, 6.0]]"));
  EXPECT_EQ(summary["quantities"][0]["max_error"], 0.5);
  EXPECT_EQ(summary["quantities"][0]["computed"]["value"], 8.0);
  EXPECT_NE(reference.table().find("state error"), std::string::npos);
  EXPECT_NE(reference.table().find("peak: 8, exact 9 Pa"), std::string::npos);
}

TEST(Reference, GoesOnFromItsState) {
  double state = 5.0;
  Reference first = reference_of(state);
  first.record_history(1.0);
  first.record_output(1.0);
  Snapshot snapshot;
  snapshot.save([&](StateVisitor& visitor) { first.visit_state(visitor); });
  Reference second = reference_of(state);
  snapshot.restore([&](StateVisitor& visitor) { second.visit_state(visitor); });
  state = 7.0;
  for (Reference* reference : {&first, &second}) {
    reference->record_history(2.0);
    reference->record_output(2.0);
  }
  EXPECT_EQ(first.summary(), second.summary());
}

}  // namespace
}  // namespace perifrac
