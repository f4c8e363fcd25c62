#include "core/bonds/lattice_bonds.hpp"

#include <gtest/gtest.h>

#include "core/bonds/bond_state.hpp"
#include "core/operators/linear_exact.hpp"
#include "tests/unit/operators/any_law.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac::test {
namespace {

TEST(LatticeBonds, AreThoseOfALattice) {
  EXPECT_TRUE(LatticeBonds<2>::find(*box_body<2>({9, 6}, 0.3)->family(0b0101)));
  EXPECT_TRUE(LatticeBonds<3>::find(*box_body<3>({7, 5, 4}, 0.3, Cloud::lattice, 2.0)->family(0)));
  EXPECT_FALSE(LatticeBonds<2>::find(*box_body<2>({9, 6}, 0.3, Cloud::jittered)->family(0)));
  EXPECT_FALSE(LatticeBonds<2>::find(*ball_body<2>(2.2, 0.4)->family(1)));
}

/// 32 to 256 neighbours: bits of a word, just those of one, of two and of four.
TEST(LatticeBonds, HaveAnyNumberOfNeighbours) {
  for (const double ratio : {2.0, 2.5, 3.0, 4.0}) {
    EXPECT_TRUE(
        LatticeBonds<3>::find(*box_body<3>({9, 9, 9}, 0.3, Cloud::lattice, ratio)->family(0)));
  }
}

TEST(LatticeBonds, KnowsEveryPointOnce) {
  const auto family = box_body<2>({9, 6}, 0.3)->family(0);
  const auto bonds = LatticeBonds<2>::find(*family);
  std::vector<int> met(family->point_count, 0);
  bonds->for_each_packet([&](Index cell) {
    for (int l = 0; l < packet_size; ++l) {
      if (const Index i = bonds->points(cell).point[l]; i >= 0) ++met[i];
    }
  });
  EXPECT_EQ(met, std::vector<int>(family->point_count, 1));
}

/// Packet by packet or bond by bond, before and after bonds broke, beside mirrored faces and free.
template <int D, class Law>
void expect_the_same_force(const std::array<int, D>& counts, FaceSet mirrored, double ratio,
                           const Law& law) {
  constexpr int R = Law::components;
  const auto body = box_body<D>(counts, 0.3, Cloud::lattice, ratio);
  auto family = std::make_shared<Family<D>>(*body->family(mirrored));
  MirrorCondition<D, R> mirror(*family);
  if (mirrored != 0) mirror.set_odd(0, 0);
  LinearExactOperator<D, Law> op(family, mirror, law);
  EXPECT_TRUE(op.path().starts_with("packets")) << op.path();
  const std::vector<double> u = random_values(op.size());
  const std::vector<double> pore_stress = random_values(family->point_count, 2);
  std::vector<double> packets(op.size()), bonds(op.size());
  std::vector<double> gradients(R * D * family->point_count), first_components(family->point_count);
  const auto expect_same = [&] {
    op.apply(u, packets);
    op.apply(u, bonds, [](Index, const Tensor<R, D>&, Tensor<R, D>&) {});
    EXPECT_LE(largest(as_eigen(packets) - as_eigen(bonds)), 1e-12 * largest(bonds));
    op.gradient(u, gradients);
    for (Index i = 0; i < family->point_count; ++i) {
      ASSERT_NEAR(gradients[i], op.gradient_at(i)[0], 1e-12 * largest(gradients));
    }
    // Values of points go into the stress, and those of the gradient come out.
    op.apply(u, packets, [&](auto i, const auto& gradient, auto& stress) {
      set_value(first_components.data(), i, gradient[0]);
      stress[0] += value_at(pore_stress.data(), i) * (1.0 + gradient[0]);
    });
    EXPECT_LE(largest(as_eigen(first_components) - as_eigen(gradients).head(family->point_count)),
              1e-12 * largest(gradients));
    op.apply(u, bonds, [&](Index i, const Tensor<R, D>& gradient, Tensor<R, D>& stress) {
      stress[0] += pore_stress[i] * (1.0 + gradient[0]);
    });
    EXPECT_LE(largest(as_eigen(packets) - as_eigen(bonds)), 1e-12 * largest(bonds));
  };
  expect_same();
  const std::vector<double> intact = bonds;
  std::vector<Index> points;
  for (const Index i : {3, 11, 20}) {
    const PointBonds own = family->bonds(i);
    Index heaviest = 0;
    for (Index k = 0; k < own.count(); ++k) {
      if (own.weight(k) > own.weight(heaviest)) heaviest = k;
    }
    const Index j = own.other(heaviest);
    silence(*family, i, j);
    points.insert(points.end(), {i, j});
  }
  op.update(points);
  expect_same();
  EXPECT_GT(largest(as_eigen(bonds) - as_eigen(intact)), 1e-3 * largest(intact));
}

template <int D, int R>
void expect_the_same_force(const std::array<int, D>& counts, FaceSet mirrored, double ratio) {
  expect_the_same_force<D>(counts, mirrored, ratio, AnyLaw<R, D>{});
}

TEST(LatticeBonds, GiveTheSameForceAsBondsOneByOne) {
  expect_the_same_force<2, 2>({13, 9}, 0, 2.5);
  expect_the_same_force<2, 2>({13, 9}, 0b0101, 3.0);
  expect_the_same_force<3, 3>({7, 5, 4}, 0, 2.0);
  expect_the_same_force<3, 3>({7, 5, 4}, 0b000101, 1.5);
}

TEST(LatticeBonds, AreSoManyAsTheHorizonAsksFor) {
  expect_the_same_force<3, 3>({9, 7, 7}, 0, 3.0);
  expect_the_same_force<3, 3>({7, 5, 5}, 0b000101, 2.5);
  expect_the_same_force<3, 1>({7, 5, 9}, 0b000100, 4.0);
  expect_the_same_force<2, 1>({13, 9}, 0b0101, 4.0);
}

/// From the last layer within the horizon of a mirrored face bonds reach ghosts farther than any
/// point behind, so that a point may have all bonds of a direction and none of the opposite.
TEST(LatticeBonds, KnowDirectionsThatOnlyGhostsLieIn) {
  // Long enough along x for packets of points that miss no bond.
  expect_the_same_force<2, 2>({30, 3}, 0b0100, 3.0);
  expect_the_same_force<3, 3>({24, 2, 8}, 0b000100, 2.0);
}

TEST(LatticeBonds, TakeLawsThatDifferFromPointToPoint) {
  LawByRegion<AnyLaw<2, 2>> law{{{}, {}, {}}, {}};
  for (double& modulus : law.laws[1].modulus) modulus *= 3.0;
  for (double& modulus : law.laws[2].modulus) modulus *= 0.2;
  for (int i = 0; i < 13 * 9; ++i) law.law_of_point.push_back(i % 50 < 30 ? 0 : i % 3);
  expect_the_same_force<2>({13, 9}, 0b0101, 2.5, law);
}

}  // namespace
}  // namespace perifrac::test
