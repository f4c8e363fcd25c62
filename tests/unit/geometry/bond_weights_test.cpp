#include "core/bonds/bond_weights.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// So many different numbers, by turns, each also a rounding above itself.
std::vector<double> some_weights(int different) {
  std::vector<double> all;
  for (int n = 0; n < 4 * different; ++n) {
    const double weight = std::exp(-0.01 * (n % different));
    all.push_back(n % 3 == 0 ? std::nextafter(weight, 2.0) : weight);
  }
  return all;
}

TEST(BondWeights, TakeAByteABondWhereFewAreDifferent) {
  const std::vector<double> all = some_weights(255);
  BondWeights packed(all);
  packed.pack();
  ASSERT_TRUE(packed.is_packed());
  ASSERT_EQ(packed.size(), all.size());
  EXPECT_LT(packed.bytes(), 4 * all.size());
  for (std::size_t bond = 0; bond < all.size(); ++bond) {
    EXPECT_NEAR(packed[bond], all[bond], 1e-15);
    EXPECT_EQ(packed[bond], packed[bond % 255]) << "equal up to rounding is equal";
  }
}

TEST(BondWeights, StayAsTheyAreWhereManyAreDifferent) {
  const std::vector<double> all = some_weights(256);
  BondWeights weights(all);
  weights.pack();
  EXPECT_FALSE(weights.is_packed());
  for (std::size_t bond = 0; bond < all.size(); ++bond) EXPECT_EQ(weights[bond], all[bond]);
}

TEST(BondWeightList, PacksAsPackDoesAsTheyCome) {
  for (const int different : {1, 255, 256, 400}) {
    const std::vector<double> all = some_weights(different);
    BondWeightList list(all.size());
    for (std::size_t begin = 0; begin < all.size(); begin += 7) {
      list.add(std::span(all).subspan(begin, std::min<std::size_t>(7, all.size() - begin)));
    }
    const BondWeights found = list.take();
    BondWeights packed(all);
    packed.pack();
    EXPECT_EQ(found.is_packed(), packed.is_packed());
    ASSERT_EQ(found.size(), all.size());
    for (std::size_t bond = 0; bond < all.size(); ++bond)
      EXPECT_NEAR(found[bond], all[bond], 1e-12);
  }
}

TEST(BondWeights, AreTakenApartAgain) {
  BondWeights weights(some_weights(9));
  const BondWeights before = weights;
  weights.pack();
  weights.unpack();
  EXPECT_FALSE(weights.is_packed());
  for (std::size_t bond = 0; bond < weights.size(); ++bond)
    EXPECT_NEAR(weights[bond], before[bond], 1e-15);
}

TEST(BondWeights, AreSetAndTakenBack) {
  for (const int different : {3, 255, 400}) {
    BondWeights weights(some_weights(different));
    weights.pack();
    const BondWeights before = weights;
    weights.set(7, 0.0);
    EXPECT_EQ(weights[7], 0.0);
    EXPECT_FALSE(weights == before);
    weights.set(7, before[7]);
    EXPECT_TRUE(weights == before);
    weights.set(7, 1.5);  // there before or not, and with room in the table or not
    EXPECT_EQ(weights[7], 1.5);
    for (std::size_t bond = 8; bond < weights.size(); ++bond)
      EXPECT_EQ(weights[bond], before[bond]);
  }
}

TEST(BondWeights, GiveLoopsWhatTheyHold) {
  for (const int different : {3, 400}) {
    BondWeights weights(some_weights(different));
    weights.pack();
    const double sum = weights.with([&](const auto& weight) {
      double sum = 0.0;
      for (std::size_t bond = 0; bond < weights.size(); ++bond) sum += weight[bond];
      return sum;
    });
    double expected = 0.0;
    for (std::size_t bond = 0; bond < weights.size(); ++bond) expected += weights[bond];
    EXPECT_EQ(sum, expected);
  }
}

}  // namespace
}  // namespace perifrac
