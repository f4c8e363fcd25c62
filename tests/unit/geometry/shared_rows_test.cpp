#include "core/base/shared_rows.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

/// Few different rows, of several lengths, by turns.
std::vector<int> row_of(int n) { return std::vector<int>(n % 3 + 1, n % 5); }

SharedRows<int> some_rows(int count) {
  SharedRowList<int> list;
  for (int n = 0; n < count; ++n) list.add(row_of(n));
  return list.take();
}

TEST(SharedRows, AreThoseThatWereAdded) {
  const SharedRows<int> rows = some_rows(100);
  ASSERT_EQ(rows.count(), 100);
  std::size_t total = 0;
  for (int n = 0; n < 100; ++n) {
    EXPECT_THAT(rows[n], ElementsAreArray(row_of(n)));
    total += row_of(n).size();
  }
  EXPECT_EQ(rows.total(), total);
}

TEST(SharedRows, KeepEqualOnesOnce) {
  const SharedRows<int> rows = some_rows(1000);
  EXPECT_EQ(rows[0].data(), rows[15].data());
  SharedRows<int> apart;
  for (int n = 0; n < 1000; ++n) apart.add(row_of(n));
  EXPECT_TRUE(rows == apart);
  EXPECT_LE(rows.bytes(), apart.bytes() - sizeof(int) * (rows.total() - 30));
}

TEST(SharedRows, OneIsChangedAlone) {
  SharedRows<int> rows = some_rows(100);
  const SharedRows<int> before = rows;
  rows.own(32)[1] = -1;  // the first that has what it has is row 2
  EXPECT_THAT(rows[32], ElementsAre(2, -1, 2));
  for (int n = 0; n < 100; ++n) {
    if (n == 32) continue;
    EXPECT_THAT(rows[n], ElementsAreArray(before[n]));
  }
  const std::size_t bytes = rows.bytes();
  rows.own(32)[1] = 2;
  EXPECT_TRUE(rows == before);
  EXPECT_EQ(rows.bytes(), bytes);
  rows.own(2)[0] = 7;  // the row that others repeat
  EXPECT_THAT(rows[17], ElementsAre(2, 2, 2));
}

TEST(SharedRows, MayBeEmpty) {
  SharedRowList<int> list;
  list.add({});
  list.add({});
  const SharedRows<int> rows = list.take();
  EXPECT_EQ(rows.count(), 2);
  EXPECT_TRUE(rows[1].empty());
}

}  // namespace
}  // namespace perifrac
