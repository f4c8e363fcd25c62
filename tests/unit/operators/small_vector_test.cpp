#include "core/base/small_vector.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "core/base/points.hpp"

namespace perifrac {
namespace {

TEST(SmallVector, IsAddedAndScaledByComponents) {
  const Vector<3> a = {1.0, 2.0, 3.0}, b = {10.0, 20.0, 40.0};
  EXPECT_EQ(a + b, (Vector<3>{11.0, 22.0, 43.0}));
  EXPECT_EQ(b - a, (Vector<3>{9.0, 18.0, 37.0}));
  EXPECT_EQ(-a, (Vector<3>{-1.0, -2.0, -3.0}));
  EXPECT_EQ(2.0 * a, (Vector<3>{2.0, 4.0, 6.0}));
  EXPECT_EQ(a * 2.0, 2.0 * a);
  EXPECT_EQ(b / 10.0, (Vector<3>{1.0, 2.0, 4.0}));
  EXPECT_EQ(componentwise(a, b), (Vector<3>{10.0, 40.0, 120.0}));
  Vector<3> c = a;
  c += b;
  c -= a;
  c *= 0.5;
  EXPECT_EQ(c, (Vector<3>{5.0, 10.0, 20.0}));
}

TEST(SmallVector, HasProducts) {
  const Vector<2> x = {3.0, 4.0}, y = {-4.0, 3.0};
  EXPECT_EQ(dot(x, y), 0.0);
  EXPECT_EQ(norm(x), 5.0);
  EXPECT_EQ(squared_norm(x), 25.0);
  EXPECT_EQ(cross(x, y), 25.0);
  EXPECT_EQ(perpendicular(x), y);
  EXPECT_EQ(cross(Vector<3>{1.0, 0.0, 0.0}, Vector<3>{0.0, 1.0, 0.0}), (Vector<3>{0.0, 0.0, 1.0}));
}

/// Of these numbers each other order gives another sum.
TEST(SmallVector, AddsInTheOrderOfTheComponents) {
  const Vector<3> ones = {1.0, 1.0, 1.0};
  EXPECT_EQ(dot({1e16, 1.0, -1e16}, ones), 0.0);
  EXPECT_EQ(dot({1e16, -1e16, 1.0}, ones), 1.0);
  EXPECT_EQ(trace(Tensor<3, 3>{1e16, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1e16}), 0.0);
}

TEST(SmallVector, TensorTimesVectorSumsOverTheColumns) {
  const Tensor<2, 2> gradient = {1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(gradient * (Vector<2>{10.0, 1.0}), (Vector<2>{12.0, 34.0}));
  EXPECT_EQ(trace(gradient), 5.0);
  Tensor<2, 2> stress = gradient;
  add_to_diagonal(stress, -1.0);
  EXPECT_EQ(stress, (Tensor<2, 2>{0.0, 2.0, 3.0, 3.0}));
}

TEST(SmallVector, IsReadFromArraysOfComponentsAndWrittenToThem) {
  std::array<std::vector<double>, 2> columns = {{{1.0, 2.0}, {10.0, 20.0}}};
  EXPECT_EQ(vector_at(columns, 1), (Vector<2>{2.0, 20.0}));
  append(columns, {3.0, 30.0});
  add_at(columns, 2, {1.0, 1.0});
  set_at(columns, 0, {5.0, 50.0});
  EXPECT_EQ(columns[0], (std::vector<double>{5.0, 2.0, 4.0}));
  EXPECT_EQ(columns[1], (std::vector<double>{50.0, 20.0, 31.0}));

  const std::array<std::vector<double>, 3> unused_third = {columns[0], columns[1], {}};
  EXPECT_EQ(vector_at<2>(unused_third, 1), (Vector<2>{2.0, 20.0}));
}

TEST(SmallVector, IsReadFromBlocksAndWrittenToThem) {
  std::vector<double> blocks = {1.0, 2.0, 3.0, 10.0, 20.0, 30.0};
  EXPECT_EQ(vector_at<2>(blocks, 3, 1), (Vector<2>{2.0, 20.0}));
  add_at(blocks, 3, 0, Vector<2>{1.0, 1.0});
  set_at(blocks, 3, 2, Vector<2>{7.0, 70.0});
  EXPECT_EQ(blocks, (std::vector<double>{2.0, 2.0, 7.0, 11.0, 20.0, 70.0}));
}

}  // namespace
}  // namespace perifrac
