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
  // 80 neighbours are more than a word has bits.
  EXPECT_FALSE(LatticeBonds<3>::find(*box_body<3>({7, 5, 4}, 0.3)->family(0)));
}

TEST(LatticeBonds, KnowsEveryPointOnce) {
  const auto family = box_body<2>({9, 6}, 0.3)->family(0);
  const auto bonds = LatticeBonds<2>::find(*family);
  std::vector<int> met(family->point_count, 0);
  bonds->for_each_packet([&](Index cell) {
    for (int l = 0; l < packet_size; ++l) {
      if (const Index i = bonds->point(cell + l); i >= 0) ++met[i];
    }
  });
  EXPECT_EQ(met, std::vector<int>(family->point_count, 1));
}

/// Packet by packet or bond by bond, before and after bonds broke, beside mirrored faces and free.
template <int D>
void expect_the_same_force(const std::array<int, D>& counts, FaceSet mirrored, double ratio) {
  const auto body = box_body<D>(counts, 0.3, Cloud::lattice, ratio);
  auto family = std::make_shared<Family<D>>(*body->family(mirrored));
  MirrorCondition<D, D> mirror(*family);
  if (mirrored != 0) mirror.set_odd(0, 0);
  LinearExactOperator<D, AnyLaw<D, D>> op(family, mirror, {});
  const std::vector<double> u = random_values(op.size());
  std::vector<double> packets(op.size()), bonds(op.size());
  const auto expect_same = [&] {
    op.apply(u, packets);
    op.apply(u, bonds, [](Index, const Tensor<D, D>&, Tensor<D, D>&) {});
    EXPECT_LE(largest(as_eigen(packets) - as_eigen(bonds)), 1e-12 * largest(bonds));
  };
  expect_same();
  const std::vector<double> intact = bonds;
  std::vector<Index> points;
  for (const Index i : {3, 11, 20}) {
    const Index j = family->other[family->offset[i]];
    silence(*family, i, j);
    points.insert(points.end(), {i, j});
  }
  op.update(points);
  expect_same();
  EXPECT_GT(largest(as_eigen(bonds) - as_eigen(intact)), 1e-3 * largest(intact));
}

TEST(LatticeBonds, GiveTheSameForceAsBondsOneByOne) {
  expect_the_same_force<2>({13, 9}, 0, 2.5);
  expect_the_same_force<2>({13, 9}, 0b0101, 3.0);
  expect_the_same_force<3>({7, 5, 4}, 0, 2.0);
  expect_the_same_force<3>({7, 5, 4}, 0b000101, 1.5);
}

}  // namespace
}  // namespace perifrac::test
