#include "modules/solid/equilibrium/tip_search.hpp"

#include <functional>

#include <gtest/gtest.h>

namespace perifrac::test {
namespace {

/// Passes until it is found, the first of which says nothing.
int look(TipSearch& search, const std::function<double(double)>& excess, double foretold) {
  int passes = 1;
  while (search.look_further(excess(search.trial()), foretold)) ++passes;
  return passes;
}

TEST(TipSearch, FindsWhereNothingIsLeftOver) {
  for (const double place : {0.1, 0.55, 0.98, 1.2}) {
    const auto excess = [&](double s) { return 0.2 * (place - s) / (0.3 + s); };
    TipSearch search;
    search.begin(0.05, 0.7);
    EXPECT_LE(look(search, excess, 0.4), 7);
    EXPECT_NEAR(search.trial(), place, 0.004);
  }
}

TEST(TipSearch, StandsWhereItIsHeld) {
  TipSearch search;
  search.begin(0.3, 0.5);
  EXPECT_LE(look(
                search, [](double s) { return -0.1 - s; }, 0.3),
            4);
  EXPECT_EQ(search.trial(), 0.3);
}

/// A window that is too long: how far it would go says how much of it is its own.
TEST(TipSearch, SaysHowFarBeyondItsFacetItWouldGo) {
  TipSearch search;
  search.begin(0.5, 1.0);
  look(
      search, [](double s) { return 0.1 * (3.0 - s); }, 1.2);
  EXPECT_EQ(search.trial(), TipSearch::farthest);
  EXPECT_NEAR(search.reach(), 3.0, 1e-9);
}

/// Fluid that comes to a facet or leaves it makes what holds a tip another at once.
TEST(TipSearch, EndsAtAJump) {
  TipSearch search;
  search.begin(0.0, 0.5);
  EXPECT_LE(look(
                search, [](double s) { return s < 0.613 ? 0.1 : -0.1; }, 0.9),
            15);
  EXPECT_NEAR(search.trial(), 0.613, 1e-3);
}

/// Other modules go on from pass to pass, and with them the place.
TEST(TipSearch, FollowsAPlaceThatMoves) {
  TipSearch search;
  search.begin(0.0, 0.5);
  double place = 0.3;
  const auto excess = [&](double s) {
    place += 0.5 * (0.6 - place);
    return place - s;
  };
  EXPECT_LE(look(search, excess, 0.4), 15);
  EXPECT_NEAR(search.trial(), 0.6, 0.01);
}

}  // namespace
}  // namespace perifrac::test
