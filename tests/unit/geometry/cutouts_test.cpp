#include "core/body/cutouts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/body/body.hpp"
#include "core/geometry/lattice.hpp"
#include "core/operators/linear_exact.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

const Region<2> notch{"notch", {4.0, 5.0}, {6.0, INFINITY}};

/// A box of 10 x 8 points a metre apart, less what the boxes hold.
std::shared_ptr<Body<2>> cut_body(const std::vector<Region<2>>& cutouts) {
  const Points<2> lattice = box_lattice<2>({10, 8}, 1.0);
  Points<2> points;
  for (Index i = 0; i < lattice.size(); ++i) {
    const bool gone = std::ranges::any_of(
        cutouts, [&](const Region<2>& box) { return box.contains(lattice.at(i)); });
    if (!gone) points.add(lattice.at(i), 1.0);
  }
  std::vector<Face> faces = {
      {"left", 0, -1, 0.0}, {"right", 0, 1, 10.0}, {"bottom", 1, -1, 0.0}, {"top", 1, 1, 8.0}};
  auto body = std::make_shared<Body<2>>(std::move(points), std::move(faces), 1.0, 2.5,
                                        InfluenceFunction::gaussian);
  body->set_cutouts(cutouts);
  return body;
}

/// Samples the segment: what goes through the box has a sample well inside.
bool is_seen_inside(const Region<2>& box, const Vector<2>& x, const Vector<2>& y) {
  for (int n = 1; n < 1000; ++n) {
    const double t = n / 1000.0;
    bool inside = true;
    for (int a = 0; a < 2; ++a) {
      const double at = x[a] + t * (y[a] - x[a]);
      inside = inside && at > box.from[a] + 1e-6 && at < box.to[a] - 1e-6;
    }
    if (inside) return true;
  }
  return false;
}

Vector<2> node(const Family<2>& family, Index i) {
  return {family.position[0][i], family.position[1][i]};
}

/// Bonds of the family as the body would have it without its cut-outs, less those seen inside.
void expect_bonds_beside(const Body<2>& body, FaceSet mirrored,
                         const std::vector<Region<2>>& boxes) {
  const Family<2> whole = build_family<2>(body.points(), body.faces(), mirrored, body.horizon(),
                                          InfluenceFunction::gaussian);
  const auto family = body.family(mirrored);
  ASSERT_EQ(family->node_count(), whole.node_count());
  Index removed = 0;
  for (Index i = 0; i < family->point_count; ++i) {
    std::vector<std::pair<Index, double>> expected, found;
    for (const auto& bond : whole.bonds(i)) {
      const auto through = [&](const Region<2>& box) {
        return is_seen_inside(box, node(whole, i), node(whole, bond.other));
      };
      if (std::ranges::any_of(boxes, through)) {
        ++removed;
      } else {
        expected.emplace_back(bond.other, bond.weight);
      }
    }
    for (const auto& bond : family->bonds(i)) found.emplace_back(bond.other, bond.weight);
    EXPECT_EQ(found, expected) << "point " << i;
  }
  EXPECT_GT(removed, 0);
}

TEST(Cutouts, TakeOutTheirPoints) { EXPECT_EQ(cut_body({notch})->points().size(), 80 - 2 * 3); }

TEST(Cutouts, NoBondPassesThroughOne) { expect_bonds_beside(*cut_body({notch}), 0, {notch}); }

TEST(Cutouts, NoBondPassesThroughOneOfSeveral) {
  const Region<2> hole{"hole", {2.0, 2.0}, {3.0, 3.0}};
  expect_bonds_beside(*cut_body({notch, hole}), 0, {notch, hole});
}

TEST(Cutouts, AreMirroredAtFaces) {
  // A slot one point wide, as far from the left face: bonds to ghosts would pass through its image.
  const Region<2> slot{"slot", {1.0, 2.0}, {2.0, 5.0}};
  const Region<2> image{"image", {-2.0, 2.0}, {-1.0, 5.0}};
  expect_bonds_beside(*cut_body({slot}), 0b0001, {slot, image});
}

TEST(Cutouts, FamiliesStaySymmetric) {
  const auto family = cut_body({notch})->family(0);
  for (Index i = 0; i < family->point_count; ++i) {
    for (const auto& bond : family->bonds(i)) {
      const Index j = bond.other;
      EXPECT_EQ(std::ranges::count(family->steps[j], i - j), 1);
    }
  }
}

/// A box of 16 x 14 points a metre apart, less a hole in it.
std::shared_ptr<Body<2>> body_with_hole(const Face& hole) {
  const Points<2> lattice = box_lattice<2>({16, 14}, 1.0);
  Points<2> points;
  for (Index i = 0; i < lattice.size(); ++i) {
    if (hole.depth(lattice.at(i)) > 0.0) points.add(lattice.at(i), 1.0);
  }
  std::vector<Face> faces = {{"left", 0, -1, 0.0},
                             {"right", 0, 1, 16.0},
                             {"bottom", 1, -1, 0.0},
                             {"top", 1, 1, 14.0},
                             hole};
  return std::make_shared<Body<2>>(std::move(points), std::move(faces), 1.0, 2.5,
                                   InfluenceFunction::gaussian);
}

Face hole_at(double x, double y, double radius) {
  return {.name = "hole", .axis = -1, .direction = -1, .coordinate = radius, .centre = {x, y}};
}

// Bonds between points stay outside; images lie within, as far from the wall as what they are of.
TEST(Hole, KeepsBondsOutsideAndImagesWithin) {
  const Face hole = hole_at(8.2, 6.9, 2.6);
  const auto family = body_with_hole(hole)->family(0b10000);
  Index images = 0, bonds_to_images = 0;
  for (Index i = 0; i < family->point_count; ++i) {
    const Vector<2> x = node(*family, i);
    images += hole.depth(x) <= 2.5 ? 1 : 0;
    for (const auto& bond : family->bonds(i)) {
      if (bond.other >= family->point_count) {
        ++bonds_to_images;
        continue;
      }
      for (int n = 1; n < 50; ++n) {
        const Vector<2> between = x + n / 50.0 * (node(*family, bond.other) - x);
        EXPECT_GT(hole.depth(between), -1e-9) << "point " << i;
      }
    }
  }
  EXPECT_EQ(family->ghost_count(), images);
  EXPECT_GT(bonds_to_images, images);
  for (Index g = 0; g < family->ghost_count(); ++g) {
    const Vector<2> image = node(*family, family->point_count + g);
    const Vector<2> source = node(*family, family->ghost_source[g]);
    EXPECT_NEAR(hole.depth(image), -hole.depth(source), 1e-12);
    EXPECT_NEAR(hole.normal(image)[0], hole.normal(source)[0], 1e-12);
    EXPECT_NEAR(family->volume[family->point_count + g], hole.place(image) / hole.place(source),
                1e-12);
  }
}

// Without images it removes what passes through it, and half of it beside a plane of symmetry what
// would pass through the whole.
TEST(Hole, IsMirroredAtFaces) {
  const Face hole = hole_at(0.0, 7.0, 2.6);
  const auto body = body_with_hole(hole);
  const auto family = body->family(0b0001);
  for (Index i = 0; i < family->point_count; ++i) {
    for (const auto& bond : family->bonds(i)) {
      EXPECT_FALSE(passes_through<2>(hole, node(*family, i), node(*family, bond.other)));
    }
  }
  EXPECT_TRUE(body->are_parted_by_cutout({2.4, 4.5}, {0.5, 9.9}));
  EXPECT_FALSE(body->are_parted_by_cutout({2.6, 4.5}, {2.6, 9.9}));
}

TEST(Cutouts, AlongASurfaceIsNotThrough) {
  EXPECT_FALSE(passes_through<2>(notch, {3.5, 4.5}, {6.5, 4.5}));  // below it
  EXPECT_FALSE(passes_through<2>(notch, {3.5, 5.0}, {6.5, 5.0}));  // along its floor
  EXPECT_FALSE(passes_through<2>(notch, {3.5, 5.5}, {4.5, 4.5}));  // its corner
  EXPECT_TRUE(passes_through<2>(notch, {3.5, 5.5}, {5.5, 4.5}));
  EXPECT_TRUE(passes_through<2>(notch, {3.5, 5.5}, {6.5, 5.5}));
  EXPECT_TRUE(passes_through<2>(notch, {5.0, 4.5}, {5.0, 6.5}));  // into it
}

TEST(Cutouts, LeaveGradientsOfLinearFieldsExact) {
  const auto body = cut_body({notch});
  const auto family = body->family(0);
  const auto gradient =
      gradient_matrix(*family, family_moments(*family), MirrorCondition<2, 1>(*family));
  const Index count = body->points().size();
  Eigen::VectorXd u(count);
  for (Index i = 0; i < count; ++i) {
    const Vector<2> x = body->points().at(i);
    u[i] = 0.3 + 0.7 * x[0] - 0.4 * x[1];
  }
  const Eigen::VectorXd slope = gradient * u;
  for (Index i = 0; i < count; ++i) {
    EXPECT_NEAR(slope[i], 0.7, 1e-12);
    EXPECT_NEAR(slope[count + i], -0.4, 1e-12);
  }
}

TEST(Cutouts, CutBoxesIn3D) {
  const Region<3> hole{"hole", {0.0, 0.0, -INFINITY}, {1.0, 1.0, INFINITY}};
  EXPECT_TRUE(passes_through<3>(hole, {-0.5, 0.5, 0.5}, {1.5, 0.5, 1.5}));
  EXPECT_FALSE(passes_through<3>(hole, {-0.5, 0.5, 0.5}, {0.5, -0.5, 1.5}));
  EXPECT_FALSE(passes_through<3>(hole, {-0.5, 0.5, 0.5}, {-0.5, 0.5, 1.5}));
}

}  // namespace
}  // namespace perifrac
