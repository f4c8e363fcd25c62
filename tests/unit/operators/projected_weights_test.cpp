#include "core/bonds/projected_weights.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/shape_tensor.hpp"
#include "core/operators/linear_exact.hpp"
#include "tests/unit/operators/any_law.hpp"
#include "tests/unit/operators/irregular_body.hpp"

namespace perifrac {
namespace {

using test::AnyLaw;
using test::Volumes;
using test::Weights;

/// Depth below the nearest face that is not mirrored.
template <int D>
double depth(const Body<D>& body, FaceSet mirrored, Index i) {
  double least = INFINITY;
  for (std::size_t f = 0; f < body.faces().size(); ++f) {
    const Face& face = body.faces()[f];
    if (contains(mirrored, static_cast<int>(f))) continue;
    least = std::min(least, std::abs(face.coordinate - body.points().position[face.axis][i]));
  }
  return least;
}

template <int D>
void expect_moments_of_a_lattice(const std::array<int, D>& counts, FaceSet mirrored,
                                 double tolerance = 1e-11) {
  const auto body = test::irregular_box<D>(counts, 0.5, 3);
  const auto family = body->family(mirrored);
  double first = 0.0;  // K of the first complete point
  for (Index i = 0; i < family->point_count; ++i) {
    if (depth(*body, mirrored, i) < body->horizon()) continue;
    const auto shape = shape_tensor_at(*family, i);
    if (first == 0.0) first = shape[0];
    for (int k = 0; k < D * D; ++k) {
      ASSERT_NEAR(shape[k], k % (D + 1) == 0 ? first : 0.0, tolerance * first);
    }
    const auto sum = sum_over_bonds<D>(*family, i, [](Index, const Vector<D>& xi, double w) {
      std::array<double, D> t;
      for (int a = 0; a < D; ++a) t[a] = w * xi[a];
      return t;
    });
    for (const double s : sum) ASSERT_NEAR(s, 0.0, tolerance * first / body->horizon());
  }
  EXPECT_GT(first, 0.0) << "no complete point";
}

TEST(ProjectedWeights, GiveCompletePointsTheMomentsOfALattice) {
  expect_moments_of_a_lattice<2>({14, 13}, 0b0000);
  expect_moments_of_a_lattice<2>({14, 13}, 0b1101);
  expect_moments_of_a_lattice<2>({14, 13}, 0b1111);
  expect_moments_of_a_lattice<3>({6, 5, 6}, 0b110101);
  expect_moments_of_a_lattice<3>({5, 5, 5}, 0b111111);
}

/// Both moments are within 2e-3 of their own, which is not the first point's.
TEST(ProjectedWeights, GiveManyPointsIn3DNearlyTheMomentsOfALattice) {
  expect_moments_of_a_lattice<3>({14, 13, 12}, 0b110101, 4e-3);
}

/// V_i w_ij s_ij = V_j w_ji s_ji: what keeps momentum and mass.
template <int D>
void expect_symmetric_factors(const std::array<int, D>& counts, FaceSet mirrored) {
  const auto body = test::irregular_box<D>(counts, 0.5, 5);
  const auto family = body->family(mirrored);
  for (Index i = 0; i < family->point_count; ++i) {
    for (const auto& [j, weight] : family->bonds(i)) {
      ASSERT_GT(weight, 0.0);
      if (j >= family->point_count) continue;
      double back = 0.0;
      for (const auto& bond : family->bonds(j)) back += bond.other == i ? bond.weight : 0.0;
      const double forth = family->volume[i] * weight;
      ASSERT_NEAR(forth, family->volume[j] * back, 1e-13 * forth);
    }
  }
}

TEST(ProjectedWeights, ArePositiveAndSymmetric) {
  expect_symmetric_factors<2>({12, 11}, 0b0110);
  expect_symmetric_factors<3>({5, 5, 5}, 0b111111);
  expect_symmetric_factors<3>({10, 9, 8}, 0b111111);
}

TEST(ProjectedWeights, LeaveALatticeAlone) {
  const auto body = test::box_body<2>({12, 11}, 0.5);
  Family<2> family = *body->family(0b1101);
  const BondWeights plain = family.weight;
  const auto done = project_weights<2>(family, body->faces(), 0b1101, body->horizon());
  EXPECT_EQ(done.steps, 0);
  EXPECT_EQ(family.weight, plain);
}

TEST(ProjectedWeights, LeaveABodyWithoutCompletePointsAlone) {
  const auto body = test::irregular_box<2>({4, 4}, 0.5, 1, Volumes::voronoi, Weights::plain);
  Family<2> family = *body->family(0);
  const BondWeights plain = family.weight;
  EXPECT_EQ(project_weights<2>(family, body->faces(), 0, body->horizon()).complete_points, 0);
  EXPECT_EQ(family.weight, plain);
}

TEST(ProjectedWeights, AreRefusedWhereAFamilyHasTooFewBonds) {
  const auto body = test::irregular_box<2>({12, 11}, 1.0, 1, Volumes::voronoi, Weights::plain);
  Family<2> family =
      build_family<2>(body->points(), body->faces(), 0b1111, 1.5, InfluenceFunction::gaussian);
  EXPECT_THROW(project_weights<2>(family, body->faces(), 0b1111, 1.5), BodyError);
}

/// Its flux does not turn, so that mirrored faces may hold it.
struct Conduction {
  static constexpr int components = 1;
  Tensor<1, 3> stress(const Tensor<1, 3>& gradient) const { return gradient; }
  double stabilisation() const { return 4.0; }
};

/// The largest force that a linear field leaves at points two horizons inside, relative to the one
/// on the surface.
template <int D, class Law>
double patch_residual(Weights weights, const std::array<int, D>& counts, FaceSet mirrored) {
  constexpr int R = Law::components;
  const auto body = test::irregular_box<D>(counts, 0.5, 4, Volumes::voronoi, weights);
  const auto family = body->family(mirrored);
  LinearExactOperator<D, Law> op(family, MirrorCondition<D, R>(*family), {});
  const Index points = body->points().size();
  std::vector<double> u(op.size()), force(op.size());
  for (int r = 0; r < R; ++r) {
    for (Index i = 0; i < points; ++i) {
      for (int b = 0; b < D; ++b) {
        // Even at mirrored faces: no slope across them.
        if (contains(mirrored, 2 * b)) continue;
        u[r * points + i] += (0.7 - 0.4 * (r * D + b)) * body->points().position[b][i];
      }
    }
  }
  op.apply(u, force);
  double inside = 0.0;
  int count = 0;
  for (Index i = 0; i < points; ++i) {
    if (depth(*body, mirrored, i) < 2.0 * body->horizon()) continue;
    ++count;
    for (int r = 0; r < R; ++r) inside = std::max(inside, std::abs(force[r * points + i]));
  }
  EXPECT_GT(count, 0);
  return inside / test::largest(force);
}

TEST(ProjectedWeights, LeaveNoForceOfAUniformStressInside) {
  EXPECT_LT((patch_residual<2, AnyLaw<1, 2>>(Weights::projected, {20, 18}, 0)), 1e-10);
  EXPECT_LT((patch_residual<2, AnyLaw<2, 2>>(Weights::projected, {20, 18}, 0)), 1e-10);
  EXPECT_LT((patch_residual<3, Conduction>(Weights::projected, {13, 4, 4}, 0b111100)), 1e-10);
  EXPECT_GT((patch_residual<2, AnyLaw<2, 2>>(Weights::plain, {20, 18}, 0)), 1e-3);
}

}  // namespace
}  // namespace perifrac
