#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "modules/fluid/semi_lagrangian/find_moments.hpp"
#include "modules/fluid/semi_lagrangian/fluid_momentum.hpp"

/// A step's two loops over neighbours against sums over all pairs, in Eigen's words.
namespace perifrac {
namespace {

constexpr double spacing = 0.5;

/// Jittered water in a periodic box of `count` points an axis: no point lies at a surface.
template <int D>
struct JitteredWater {
  using Bond = Eigen::Matrix<double, D, 1>;
  using Shape = Eigen::Matrix<double, D, D>;

  double width;
  FluidPoints<D> points;
  FluidMoments<D> moments;
  FluidNeighbours<D> neighbours;
  NearWalls<D> no_walls;
  GaussianInfluence influence{2.5 * spacing};

  explicit JitteredWater(int count)
      : width(count * spacing), neighbours(2.5 * spacing, 0.25 * spacing, make_period()) {
    std::mt19937 bits(3);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (int n = 0; n < std::pow(count, D); ++n) {
      Vector<D> x, v;
      for (int a = 0, rest = n; a < D; ++a, rest /= count) {
        x[a] = spacing * (rest % count + 0.5 + 0.2 * value(bits));
        v[a] = value(bits);
      }
      points.add(x, v, 1000.0 + value(bits), 1000.0 * std::pow(spacing, D) + value(bits));
    }
    neighbours.find(points, {}, no_walls);
    points.volume.resize(points.count);
    for (Index i = 0; i < points.count; ++i) points.volume[i] = points.mass[i] / points.density[i];
    for (auto& values : points.velocity) neighbours.images().copy(values, points.count);
    neighbours.images().copy(points.density, points.count);
    neighbours.images().copy(points.volume, points.count);
    moments.bulk_trace = lattice_trace<D>(spacing, 2.5 * spacing, influence);
    FluidValues<D> values;
    find_moments<D>(points, no_walls, neighbours, influence, values, moments);
    neighbours.images().copy(moments.trace, points.count);
  }

  Period<D> make_period() const {
    Period<D> period;
    for (auto& ends : period.ends) ends = {0.0, width};
    return period;
  }

  Bond velocity(Index i) const {
    Bond v;
    for (int a = 0; a < D; ++a) v[a] = points.velocity[a][i];
    return v;
  }

  /// use(j, y, omega V_j) for all others, at their nearest images.
  template <class Use>
  void for_all_others(Index i, Use&& use) const {
    for (Index j = 0; j < points.count; ++j) {
      Bond y;
      for (int a = 0; a < D; ++a) {
        const double apart = points.position[a][j] - points.position[a][i];
        y[a] = apart - width * std::round(apart / width);
      }
      if (j == i || y.norm() > 2.5 * spacing) continue;
      use(j, y, std::exp(-y.squaredNorm() / (spacing * spacing)) * points.volume[j]);
    }
  }

  Shape shape(Index i) const {
    Shape m = Shape::Zero();
    for_all_others(i, [&](Index, const Bond& y, double w) { m += w * y * y.transpose(); });
    return m;
  }
};

template <int D>
void expect_moments(int count) {
  const JitteredWater<D> water(count);
  using Bond = typename JitteredWater<D>::Bond;
  using Shape = typename JitteredWater<D>::Shape;
  for (Index i = 0; i < water.points.count; ++i) {
    const Shape inverse = water.shape(i).inverse();
    Shape gradient = Shape::Zero();
    Bond bonds = Bond::Zero(), slope = Bond::Zero();
    double difference = 0.0;
    water.for_all_others(i, [&](Index j, const Bond& y, double w) {
      const double denser = water.points.density[j] - water.points.density[i];
      gradient += w * (water.velocity(j) - water.velocity(i)) * (inverse * y).transpose();
      bonds += w * y;
      slope += w * denser * y;
      difference += w * denser;
    });
    const double scale = 2.0 * D / water.moments.bulk_trace;
    const double diffusion = scale * (difference - bonds.dot(inverse * slope));
    EXPECT_NEAR(water.moments.trace[i], water.shape(i).trace(), 1e-12);
    EXPECT_NEAR(water.moments.divergence[i], gradient.trace(), 1e-11 / spacing);
    EXPECT_NEAR(water.moments.diffusion[i], diffusion, 1e-10);
    for (int a = 0; a < D; ++a) {
      EXPECT_NEAR(water.moments.crowding[a][i], bonds[a] * D / water.moments.bulk_trace, 1e-11);
      for (int b = a; b < D; ++b) {
        EXPECT_NEAR(water.moments.inverse_shape[symmetric_index<D>(a, b)][i], inverse(a, b), 1e-9);
      }
    }
  }
}

TEST(FluidLoops, FindTheMomentsThatAllPairsGive) {
  expect_moments<2>(12);
  expect_moments<3>(8);
}

template <int D>
void expect_forces(int count) {
  const JitteredWater<D> water(count);
  using Bond = typename JitteredWater<D>::Bond;
  using Shape = typename JitteredWater<D>::Shape;
  const FluidProperties fluid{.density = 1000.0, .bulk_modulus = 1e6, .viscosity = 500.0};
  const FluidScheme scheme{.spacing = spacing,
                           .horizon = 2.5 * spacing,
                           .artificial_viscosity = 0.0,
                           .density_diffusion = 0.0,
                           .shifting = 0.0,
                           .courant = 0.3};
  std::array<std::vector<double>, symmetric_size<D>> stress;
  std::vector<Shape> stress_of;
  for (auto& values : stress) values.resize(water.points.count);
  for (Index i = 0; i < water.points.count; ++i) {
    stress_of.push_back(-fluid.pressure(water.points.density[i]) * water.shape(i).inverse());
    for (int a = 0; a < D; ++a) {
      for (int b = a; b < D; ++b) stress[symmetric_index<D>(a, b)][i] = stress_of[i](a, b);
    }
  }
  for (auto& values : stress) water.neighbours.images().copy(values, water.points.count);
  FluidForces<D> forces;
  ForceValues<D> values;
  find_pair_forces<D>({water.points, WallCloud<D>{}, water.neighbours, water.moments, fluid, scheme,
                       water.influence, Vector<D>{}, stress},
                      water.influence, values, forces);
  Bond all = Bond::Zero();
  double largest = 0.0;
  for (Index i = 0; i < water.points.count; ++i) {
    Bond expected = Bond::Zero(), found;
    double heat = 0.0;
    water.for_all_others(i, [&](Index j, const Bond& y, double w) {
      const double drag =
          fluid.viscosity * 4.0 * D / (water.shape(i).trace() + water.shape(j).trace());
      expected +=
          water.points.volume[i] * w *
          ((stress_of[i] + stress_of[j]) * y + drag * (water.velocity(j) - water.velocity(i)));
      heat += 0.5 * water.points.volume[i] * w * drag *
              (water.velocity(j) - water.velocity(i)).squaredNorm();
    });
    for (int a = 0; a < D; ++a) found[a] = forces.force[a][i];
    EXPECT_LT((found - expected).norm(), 1e-11 * expected.norm()) << "at point " << i;
    EXPECT_NEAR(forces.heat[i], heat, 1e-12 * heat) << "at point " << i;
    all += found;
    largest = std::max(largest, found.norm());
  }
  EXPECT_LT(all.norm(), 1e-13 * largest * water.points.count);
}

TEST(FluidLoops, FindTheForcesThatAllPairsGiveAndKeepMomentum) {
  expect_forces<2>(12);
  expect_forces<3>(7);
}

}  // namespace
}  // namespace perifrac
