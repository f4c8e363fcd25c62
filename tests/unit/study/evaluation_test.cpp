#include "app/study/evaluation.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

TEST(spread, is_median_and_ends) {
  const Spread odd = spread({3.0, 1.0, 7.0});
  EXPECT_EQ(odd.median, 3.0);
  EXPECT_EQ(odd.least, 1.0);
  EXPECT_EQ(odd.most, 7.0);
  EXPECT_EQ(spread({4.0, 1.0}).median, 2.5);
  EXPECT_EQ(spread({}).median, 0.0);
}

}  // namespace
}  // namespace perifrac
