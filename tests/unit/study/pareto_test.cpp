#include "app/study/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(pareto_front, leaves_out_what_another_beats_in_both) {
  const std::vector<ErrorAndCost> points = {{1e-2, 1.0}, {1e-3, 5.0}, {2e-2, 2.0},
                                            {1e-3, 6.0}, {1e-4, 4.0}, {5e-2, 0.5}};
  EXPECT_THAT(pareto_front(points), ElementsAre(5, 0, 4));
}

TEST(pareto_front, takes_the_better_of_two_that_cost_the_same_and_the_first_of_equals) {
  EXPECT_THAT(pareto_front(std::vector<ErrorAndCost>{{2.0, 1.0}, {1.0, 1.0}}), ElementsAre(1));
  EXPECT_THAT(pareto_front(std::vector<ErrorAndCost>{{1.0, 1.0}, {1.0, 1.0}}), ElementsAre(0));
  EXPECT_THAT(pareto_front({}), IsEmpty());
}

TEST(cheapest, are_those_that_reach_it_by_cost) {
  const std::vector<ErrorAndCost> points = {{1e-2, 1.0}, {1e-3, 5.0}, {2e-3, 2.0}};
  EXPECT_THAT(cheapest(points, 2e-3), ElementsAre(2, 1));
  EXPECT_THAT(cheapest(points, 1e-4), IsEmpty());
}

}  // namespace
}  // namespace perifrac
