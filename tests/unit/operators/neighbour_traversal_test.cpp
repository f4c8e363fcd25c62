#include "core/geometry/neighbour_traversal.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/geometry/cell_grid.hpp"
#include "tests/unit/operators/brute_force.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

constexpr double horizon = 2.5;

/// Points with lists that reach beyond the horizon, as they do while points move.
template <int D>
struct Crowd {
  Points<D> points;
  Neighbours neighbours;

  explicit Crowd(const std::array<int, D>& counts)
      : points(test::box_points<D>(counts, 1.0, Cloud::jittered)) {
    CellGrid<D> grid;
    grid.build(positions_of(points.position), 1.1 * horizon);
    grid.find_others(points.size(), 1.1 * horizon, neighbours);
  }
};

/// Sums of 1, y_0 y_1 and a field, with weights, over all pairs.
template <int D>
std::array<double, 3> all_pairs(const Points<D>& points, Index i) {
  std::array<double, 3> sum{};
  for (Index j = 0; j < points.size(); ++j) {
    const double r = test::distance<D>(points.at(i), points.at(j));
    if (j == i || r > horizon) continue;
    const double s = r / (0.4 * horizon);
    const double weight = std::exp(-s * s) * points.volume[j];
    const Vector<D> x = points.at(i), other = points.at(j);
    sum[0] += weight;
    sum[1] += weight * (other[0] - x[0]) * (other[1] - x[1]);
    sum[2] += weight * (points.position[D - 1][j] - x[D - 1]);
  }
  return sum;
}

template <int D>
void expect_all_pairs(const std::array<int, D>& counts) {
  const Crowd<D> crowd(counts);
  const Points<D>& points = crowd.points;
  const std::vector<double>& field = points.position[D - 1];
  const GaussianInfluence influence(horizon);
  for (Index i = 0; i < points.size(); ++i) {
    const auto at_once = sum_over_neighbours<3, D>(
        crowd.neighbours, i, points.at(i), points.position, influence,
        [&](const Index* j, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * gather(points.volume, j);
          return std::array<Packet, 3>{weight, weight * y[0] * y[1],
                                       weight * (gather(field, j) - field[i])};
        });
    const auto one_by_one =
        sum_over_neighbours<3, D>(crowd.neighbours, i, points.at(i), points.position, influence,
                                  [&](Index j, const Vector<D>& y, double omega) {
                                    const double weight = omega * points.volume[j];
                                    return std::array<double, 3>{weight, weight * y[0] * y[1],
                                                                 weight * (field[j] - field[i])};
                                  });
    const auto expected = all_pairs<D>(points, i);
    for (int k = 0; k < 3; ++k) {
      ASSERT_NEAR(at_once[k], expected[k], 1e-11) << "sum " << k << " of point " << i;
      ASSERT_NEAR(one_by_one[k], expected[k], 1e-11) << "sum " << k << " of point " << i;
    }
  }
}

TEST(NeighbourTraversal, SumsOverEveryNeighbourOnce) {
  expect_all_pairs<2>({9, 8});
  expect_all_pairs<3>({6, 5, 4});
}

// Lists shorter than a packet, the first ones among them, and empty ones.
TEST(NeighbourTraversal, SumsOverShortLists) {
  for (int count = 1; count < 12; ++count) expect_all_pairs<2>({count, 1});
}

template <int N, class Values>
void expect_own_numbers() {
  constexpr Index count = 40;
  std::array<std::vector<double>, N> numbers;
  std::array<std::span<const double>, N> columns;
  for (int k = 0; k < N; ++k) {
    for (Index i = 0; i < count; ++i) numbers[k].push_back(100.0 * i + k);
    columns[k] = numbers[k];
  }
  Values values;
  values.set(columns);
  std::array<Index, packet_size> j;
  for (int l = 0; l < packet_size; ++l) j[l] = (7 * l + 3) % count;
  const auto brought = values.gather(j.data());
  for (int k = 0; k < N; ++k) {
    const Packet packet = brought[k];
    for (int l = 0; l < packet_size; ++l)
      ASSERT_EQ(packet[l], 100.0 * j[l] + k) << "number " << k << " of " << N << ", point " << l;
  }
}

TEST(NeighbourTraversal, BringsEachPointsOwnNumbersByRowAndByColumn) {
  expect_own_numbers<1, NeighbourRows<1>>();
  expect_own_numbers<8, NeighbourRows<8>>();
  expect_own_numbers<14, NeighbourRows<14>>();
  expect_own_numbers<9, NeighbourColumns<9>>();
}

TEST(NeighbourTraversal, ReadsOtherTargetsThanThePointsThemselves) {
  const std::array<std::vector<double>, 2> position = {{{1.0, 0.0, 3.0}, {0.0, 2.0, 0.0}}};
  const Neighbours neighbours{.offset = {0, 0, 2}, .other = {0, 1}};
  const GaussianInfluence influence(horizon);
  const auto vectors_to = [&](Index target) {
    return sum_over_neighbours<2, 2>(
        neighbours, target, {0.0, 0.0}, position, influence,
        [](const Index*, const PacketVector<2>& y, const Packet& omega) {
          return std::array<Packet, 2>{omega * y[0], omega * y[1]};
        });
  };
  EXPECT_EQ(vectors_to(0), (std::array{0.0, 0.0}));
  EXPECT_EQ(vectors_to(1), (std::array{influence(1.0), 2.0 * influence(4.0)}));
}

// What keeps momentum: both ends of a pair see the same weight and the opposite vector.
TEST(NeighbourTraversal, GivesBothEndsOfAPairTheSameBits) {
  const std::array<std::vector<double>, 2> position = {{{0.1, 1.3}, {0.7, 0.2}}};
  const Neighbours neighbours{.offset = {0, 1, 2}, .other = {1, 0}};
  const GaussianInfluence influence(horizon);
  std::array<std::array<double, 3>, 2> seen;
  for (Index i = 0; i < 2; ++i) {
    seen[i] = sum_over_neighbours<3, 2>(
        neighbours, i, {position[0][i], position[1][i]}, position, influence,
        [](const Index*, const PacketVector<2>& y, const Packet& omega) {
          return std::array<Packet, 3>{omega, omega * y[0], omega * y[1]};
        });
  }
  EXPECT_GT(seen[0][0], 0.0);
  EXPECT_EQ(seen[0][0], seen[1][0]);
  EXPECT_EQ(seen[0][1], -seen[1][1]);
  EXPECT_EQ(seen[0][2], -seen[1][2]);
}

}  // namespace
}  // namespace perifrac
