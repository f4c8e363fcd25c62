#include "modules/solid/equilibrium/learned_slope.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "modules/solid/fracture/opening_kernel.hpp"

namespace perifrac {
namespace {

constexpr int facets = 10;

/// Of a straight crack of facets of length 1, in rock of E' = 1.
Eigen::MatrixXd endless(int count) {
  std::vector<CrackFacet<2>> crack;
  for (int k = 0; k < count; ++k) crack.push_back({Vector<2>{1.0 * k, 0.0}, {k + 1.0, 0.0}});
  return pressure_by_opening<2>(crack, std::vector<double>(count, 1.0), {});
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& m) {
  return m.llt().solve(Eigen::MatrixXd::Identity(m.rows(), m.cols()));
}

TEST(LearnedSlope, IsTheInverseHoweverItGrows) {
  LearnedSlope grown;
  for (int count = 4; count <= facets; count += 3)
    grown.extend(endless(count), Eigen::VectorXd::Ones(count));
  const Eigen::MatrixXd exact = inverse(endless(facets));
  EXPECT_LT((grown.matrix() - exact).norm(), 1e-13 * exact.norm());
  grown.keep(5);
  EXPECT_EQ(grown.size(), 5);
  EXPECT_LT((grown.matrix() - inverse(endless(5))).norm(), 1e-13 * exact.norm());
}

TEST(LearnedSlope, SaysOfAPressureWhatItWasShown) {
  const Eigen::VectorXd area = Eigen::VectorXd::LinSpaced(facets, 0.5, 1.0);
  // Another rock: stiffer at one end.
  const Eigen::VectorXd stiffer = Eigen::VectorXd::LinSpaced(facets, 1.0, 1.5);
  const Eigen::MatrixXd truth =
      inverse(stiffer.asDiagonal() * endless(facets) * stiffer.asDiagonal()) * area.asDiagonal();
  LearnedSlope slope;
  slope.extend(endless(facets), area);
  const double unlearned = (slope.matrix() - truth).norm();
  for (int k = 0; k < 6 * facets; ++k) {
    Eigen::VectorXd pressure(facets);
    for (int f = 0; f < facets; ++f) pressure[f] = std::cos(0.7 * (k + 1) * (f + 0.5));
    slope.learn(pressure, truth * pressure);
    const Eigen::VectorXd said = slope.matrix() * pressure;
    EXPECT_LT((said - truth * pressure).norm(), 1e-11 * said.norm());
  }
  EXPECT_LT((slope.matrix() - truth).norm(), 0.35 * unlearned);
  const Eigen::MatrixXd weighed = area.asDiagonal() * slope.matrix();
  EXPECT_LT((weighed - weighed.transpose()).norm(), 1e-12 * weighed.norm());
  EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(weighed).info(), Eigen::Success);
}

/// No rock opens against its pressure.
TEST(LearnedSlope, LearnsNothingFromWhatNoRockDoes) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(facets);
  LearnedSlope slope;
  slope.extend(endless(facets), one);
  const Eigen::MatrixXd before = slope.matrix();
  slope.learn(one, -one);
  EXPECT_EQ(slope.matrix(), before);
}

}  // namespace
}  // namespace perifrac
