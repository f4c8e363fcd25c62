#include "core/bonds/bond_weights.hpp"

#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

constexpr Index bonds = 4;  // a point

/// So many different numbers, by turns, each also a rounding above itself.
SharedRows<double> some_weights(int different) {
  SharedRows<double> all;
  for (int n = 0; n < 4 * different; n += bonds) {
    std::vector<double> row;
    for (int k = n; k < n + bonds; ++k) {
      const double weight = std::exp(-0.01 * (k % different));
      row.push_back(k % 3 == 0 ? std::nextafter(weight, 2.0) : weight);
    }
    all.add(row);
  }
  return all;
}

void expect_near(const BondWeights& found, const SharedRows<double>& expected, double rounding) {
  ASSERT_EQ(found.point_count(), expected.count());
  for (Index i = 0; i < expected.count(); ++i) {
    ASSERT_EQ(found.bond_count(i), expected.size(i));
    for (Index k = 0; k < bonds; ++k) EXPECT_NEAR(found(i, k), expected[i][k], rounding);
  }
}

TEST(BondWeights, TakeAByteABondWhereFewAreDifferent) {
  const SharedRows<double> all = some_weights(255);
  BondWeights packed(all);
  packed.pack();
  ASSERT_TRUE(packed.is_packed());
  EXPECT_LT(packed.bytes(), all.bytes());
  expect_near(packed, all, 1e-15);
  const auto at = [&](Index n) { return packed(n / bonds, n % bonds); };
  for (Index n = 0; n < 3 * 255; ++n) {
    EXPECT_EQ(at(n), at(n + 255)) << "equal up to rounding is equal";
  }
}

TEST(BondWeights, OfPointsThatHaveTheSameTakeNoRoom) {
  SharedRows<double> all;
  const std::vector<double> row(100, 0.25);
  for (Index i = 0; i < 1000; ++i) all.add(row);
  BondWeights packed(all);
  packed.pack();
  EXPECT_LT(packed.bytes(), 1000 * 10u + 1000u);
}

TEST(BondWeights, StayAsTheyAreWhereManyAreDifferent) {
  const SharedRows<double> all = some_weights(256);
  BondWeights weights(all);
  weights.pack();
  EXPECT_FALSE(weights.is_packed());
  expect_near(weights, all, 0.0);
}

TEST(BondWeightList, PacksAsPackDoesAsTheyCome) {
  for (const int different : {1, 255, 256, 400}) {
    const SharedRows<double> all = some_weights(different);
    BondWeightList list;
    for (Index i = 0; i < all.count(); ++i) list.add(all[i]);
    const BondWeights found = list.take();
    BondWeights packed(all);
    packed.pack();
    EXPECT_EQ(found.is_packed(), packed.is_packed());
    expect_near(found, all, 1e-12);
  }
}

TEST(BondWeights, AreTakenApartAgain) {
  const SharedRows<double> before = some_weights(9);
  BondWeights weights(before);
  weights.pack();
  weights.unpack();
  EXPECT_FALSE(weights.is_packed());
  expect_near(weights, before, 1e-15);
}

TEST(BondWeights, AreSetAndTakenBack) {
  for (const int different : {4, 255, 400}) {
    BondWeights weights(some_weights(different));
    weights.pack();
    const BondWeights before = weights;
    weights.set(1, 3, 0.0);
    EXPECT_EQ(weights(1, 3), 0.0);
    EXPECT_FALSE(weights == before);
    weights.set(1, 3, before(1, 3));
    EXPECT_TRUE(weights == before);
    weights.set(1, 3, 1.5);  // there before or not, and with room in the table or not
    EXPECT_EQ(weights(1, 3), 1.5);
    weights.set(1, 3, before(1, 3));
    for (Index i = 0; i < weights.point_count(); ++i) {
      for (Index k = 0; k < bonds; ++k) EXPECT_NEAR(weights(i, k), before(i, k), 1e-15);
    }
  }
}

TEST(BondWeights, GiveLoopsWhatTheyHold) {
  for (const int different : {3, 400}) {
    BondWeights weights(some_weights(different));
    weights.pack();
    for (Index i = 0; i < weights.point_count(); ++i) {
      weights.with(i, [&](const auto& weight) {
        for (Index k = 0; k < bonds; ++k) EXPECT_EQ(weight[k], weights(i, k));
      });
    }
  }
}

}  // namespace
}  // namespace perifrac
