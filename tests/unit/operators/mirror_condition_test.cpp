#include "core/bonds/mirror_condition.hpp"

#include <gtest/gtest.h>

#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

TEST(MirrorCondition, ReflectsAboutTheFaceValueOfOddFacesOnly) {
  const auto body = test::box_body<2>({5, 5}, 1.0);
  MirrorCondition<2, 2> mirror(*body->family(0b1111));
  mirror.set_odd(3, 1);
  EXPECT_EQ(mirror.face_value_count(), 1);
  EXPECT_EQ(mirror.face_value(3, 1), 0);
  EXPECT_EQ(mirror.face_value(3, 0), -1);
  const auto odd = mirror.image(face_bit(3), 1);
  EXPECT_EQ(odd.sign, -1.0);
  ASSERT_EQ(odd.term_count, 1);
  EXPECT_EQ(odd.terms[0].coefficient, 2.0);
  for (const auto& even : {mirror.image(face_bit(3), 0), mirror.image(face_bit(0), 1)}) {
    EXPECT_EQ(even.sign, 1.0);
    EXPECT_EQ(even.term_count, 0);
  }
  const auto edge = mirror.image(face_bit(3) | face_bit(0), 1);
  EXPECT_EQ(edge.sign, -1.0);
  EXPECT_EQ(edge.term_count, 1);
}

// Behind a corner of odd faces the field keeps to the range of what is prescribed on them.
TEST(MirrorCondition, MeetsAtCornersOfOddFaces) {
  const auto body = test::box_body<3>({4, 4, 4}, 1.0);
  MirrorCondition<3, 1> mirror(*body->family(0b010101));
  for (const int face : {0, 2, 4}) mirror.set_odd(face, 0);
  const auto edge = mirror.image(0b000101, 0);
  EXPECT_EQ(edge.sign, 1.0);
  EXPECT_EQ(edge.term_count, 0);
  const auto corner = mirror.image(0b010101, 0);
  EXPECT_EQ(corner.sign, -1.0);
  ASSERT_EQ(corner.term_count, 3);
  for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(corner.terms[k].coefficient, 2.0 / 3.0);
}

// An octant has one face more than axes.
TEST(MirrorCondition, HoldsAllFacesOfAnOctant) {
  const auto body = test::ball_body<2>(4.0, 1.0, true);
  MirrorCondition<2, 1> mirror(*body->family(0b111));
  for (const int face : {0, 1, 2}) mirror.set_odd(face, 0);
  const auto corner = mirror.image(0b111, 0);
  EXPECT_EQ(corner.sign, -1.0);
  ASSERT_EQ(corner.term_count, 3);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(corner.terms[k].face_value, k);
}

}  // namespace
}  // namespace perifrac
