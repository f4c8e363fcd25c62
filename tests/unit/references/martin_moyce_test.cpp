#include "app/references/solutions/martin_moyce.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

using martin_moyce::front;

TEST(MartinMoyce, TableAgreesWithTheirFigure) {
  // Read off figure 3 of the same paper, to 0.05 in T.
  for (const auto& [T, read] :
       {std::pair{0.832, 1.217}, {1.219, 1.474}, {1.997, 2.292}, {2.547, 2.995}}) {
    EXPECT_GE(read, front(T - 0.05));
    EXPECT_LE(read, front(T + 0.05));
  }
}

TEST(MartinMoyce, FrontRunsBehindRitters) {
  double before = 1.0;
  for (double T = 0.01; T < martin_moyce::end(); T += 0.01) {
    EXPECT_GE(front(T), before);
    EXPECT_LT(front(T), 1.0 + 2.0 * T);
    before = front(T);
  }
}

TEST(MartinMoyce, IsKnownAsLongAsItWasMeasured) {
  EXPECT_EQ(front(0.0), 1.0);
  EXPECT_EQ(front(martin_moyce::end()), 4.11);
  EXPECT_TRUE(std::isnan(front(3.34)));
}

}  // namespace
}  // namespace perifrac
