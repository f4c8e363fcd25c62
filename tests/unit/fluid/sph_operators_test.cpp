#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "modules/fluid/sph/sph_moments.hpp"
#include "modules/fluid/sph/sph_momentum.hpp"

/// The sums of smoothed particle hydrodynamics on points with given fields.
namespace perifrac::sph_operators {
namespace {

constexpr double spacing = 0.1;
constexpr double horizon = 3.0 * spacing;

template <int D>
using Field = std::function<double(const Vector<D>&)>;

/// Water in a box of `count` points an axis, periodic or with surfaces all round.
template <int D>
struct SphWater {
  SphWater(int count, double jitter, bool is_periodic, double viscosity = 0.0)
      : width(count * spacing),
        periodic(is_periodic),
        fluid{.density = 1000.0, .bulk_modulus = 1e6, .viscosity = viscosity},
        neighbours(horizon, 0.25 * spacing, make_period()) {
    std::mt19937 bits(7);
    std::uniform_real_distribution<double> shift(-jitter * spacing, jitter * spacing);
    for (int n = 0; n < std::pow(count, D); ++n) {
      Vector<D> x;
      for (int a = 0, rest = n; a < D; ++a, rest /= count) {
        x[a] = spacing * (rest % count + 0.5) + shift(bits);
      }
      points.add(x, {}, 1000.0, 1000.0 * std::pow(spacing, D));
    }
    neighbours.find(points, {}, no_walls);
    points.volume.assign(points.count, std::pow(spacing, D));
    points.pressure.assign(points.count, 0.0);
    moments.bulk_trace = lattice_trace<D>(spacing, horizon, influence);
  }

  Period<D> make_period() const {
    Period<D> period;
    if (periodic) period.ends.fill(std::pair{0.0, width});
    return period;
  }

  void set(std::vector<double>& values, const Field<D>& field) {
    for (Index i = 0; i < points.count; ++i) values[i] = field(points.at(i));
  }

  /// Another pressure and velocity at every point.
  void shake() {
    std::mt19937 bits(3);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (Index i = 0; i < points.count; ++i) {
      for (auto& component : points.velocity) component[i] = value(bits);
      points.pressure[i] = 1e4 * value(bits);
      points.density[i] = 1000.0 + value(bits);
      points.volume[i] *= 1.0 + 0.05 * value(bits);
    }
  }

  void find() {
    for (auto& values : points.velocity) neighbours.images().copy(values, points.count);
    for (auto* values : {&points.density, &points.volume, &points.pressure}) {
      neighbours.images().copy(*values, points.count);
    }
    FluidValues<D> values;
    sums.find(points, no_walls, neighbours, influence, values, moments);
    const FluidStep<D> step{points, cloud,  neighbours, moments, fluid,
                            scheme, weight, gravity,    stress};
    find_sph_forces<D>(step, influence, values, forces);
  }

  /// Uses every point that has all its neighbours.
  void for_inner(const std::function<void(Index, const Vector<D>&)>& use) const {
    int count = 0;
    for (Index i = 0; i < points.count; ++i) {
      const Vector<D> x = points.at(i);
      const bool inner =
          std::ranges::all_of(x, [&](double c) { return c > horizon && c < width - horizon; });
      if (inner) use(i, x), ++count;
    }
    ASSERT_GT(count, 8);
  }

  double width;
  bool periodic;
  FluidProperties fluid;
  FluidScheme scheme{.spacing = spacing,
                     .horizon = horizon,
                     .artificial_viscosity = 0.0,
                     .density_diffusion = 0.5,
                     .courant = 0.35};
  FluidPoints<D> points;
  FluidNeighbours<D> neighbours;
  NearWalls<D> no_walls;
  WallCloud<D> cloud;
  WendlandInfluence influence{horizon};
  PairInfluence weight{influence};
  FluidMoments<D> moments;
  SphMoments<D> sums;
  Vector<D> gravity{};
  std::array<std::vector<double>, symmetric_size<D>> stress;
  FluidForces<D> forces;
};

constexpr int count_of(int dimension) { return dimension == 2 ? 20 : 10; }

/// The sums at every point, over all pairs, from the kernel's own gradient.
template <int D>
void expect_sums_over_all_pairs() {
  SphWater<D> water(D == 2 ? 12 : 8, 0.2, true, 40.0);
  water.shake();
  water.find();
  const double bulk = water.moments.bulk_trace / D;
  const FluidPoints<D>& points = water.points;
  for (Index i = 0; i < points.count; ++i) {
    double divergence = 0.0, heat = 0.0;
    Vector<D> force{};
    for (Index j = 0; j < points.count; ++j) {
      Vector<D> y = points.at(j) - points.at(i);
      for (double& c : y) c -= water.width * std::round(c / water.width);
      const double r = norm(y);
      if (j == i || r >= horizon) continue;
      const double omega = std::pow(1.0 - r / horizon, 3) / bulk * points.volume[j];
      const Vector<D> apart = vector_at(points.velocity, j) - vector_at(points.velocity, i);
      divergence += omega * dot(apart, y);
      force += points.volume[i] * omega *
               (2.0 * 40.0 * apart - (points.pressure[i] + points.pressure[j]) * y);
      heat += points.volume[i] * omega * 40.0 * squared_norm(apart);
    }
    EXPECT_NEAR(water.moments.divergence[i], divergence, 1e-11 * std::abs(divergence) + 1e-12);
    EXPECT_NEAR(water.forces.heat[i], heat, 1e-12 * heat);
    for (int a = 0; a < D; ++a) {
      EXPECT_NEAR(water.forces.force[a][i], force[a], 1e-11 * norm(force)) << i;
    }
  }
}

TEST(SphOperators, AreSumsOverAllPairs) {
  expect_sums_over_all_pairs<2>();
  expect_sums_over_all_pairs<3>();
}

/// Action and reaction; and what pressure does to velocities is what it takes to compress.
template <int D>
void expect_momentum_and_energy_kept() {
  SphWater<D> water(count_of(D), 0.2, true);
  water.shake();
  water.find();
  const FluidPoints<D>& points = water.points;
  Vector<D> all{};
  double size = 0.0, work = 0.0, done = 0.0;
  for (Index i = 0; i < points.count; ++i) {
    const Vector<D> force = vector_at(water.forces.force, i);
    all += force;
    size += norm(force);
    const double power = dot(force, vector_at(points.velocity, i));
    work += power - points.pressure[i] * points.volume[i] * water.moments.divergence[i];
    done += std::abs(power);
  }
  EXPECT_LT(norm(all), 1e-14 * size);
  EXPECT_LT(std::abs(work), 1e-13 * done);
  EXPECT_GT(done, 0.0);
}

TEST(SphOperators, KeepMomentumAndEnergy) {
  expect_momentum_and_energy_kept<2>();
  expect_momentum_and_energy_kept<3>();
}

/// Patch tests: on a lattice what is constant has no gradient, and linear fields have their own.
template <int D>
void expect_exact_on_a_lattice() {
  SphWater<D> water(count_of(D), 0.0, false, 5.0);
  for (int a = 0; a < D; ++a) {
    water.set(water.points.velocity[a],
              [&](const Vector<D>& x) { return (0.3 + 0.2 * a) * x[a] - 0.7 * x[(a + 1) % D]; });
  }
  water.set(water.points.pressure,
            [](const Vector<D>& x) { return 5e4 + 1e4 * x[0] - 4e3 * x[1]; });
  water.find();
  const double divergence = D == 2 ? 0.8 : 1.5;
  water.for_inner([&](Index i, const Vector<D>&) {
    EXPECT_NEAR(water.moments.trace[i], water.moments.bulk_trace, 1e-13);
    EXPECT_NEAR(water.moments.divergence[i], divergence, 1e-12);
    EXPECT_NEAR(water.forces.force[0][i], -1e4 * water.points.volume[i],
                1e-8 * water.points.volume[i]);
    EXPECT_NEAR(water.forces.force[1][i], 4e3 * water.points.volume[i],
                1e-8 * water.points.volume[i]);
    for (int a = 0; a < D; ++a) EXPECT_NEAR(water.moments.crowding[a][i], 0.0, 1e-12 / spacing);
  });
}

TEST(SphOperators, AreExactForLinearFieldsOnALattice) {
  expect_exact_on_a_lattice<2>();
  expect_exact_on_a_lattice<3>();
}

/// No density that is linear diffuses, at surfaces or not, however points lie; and what does
/// diffuse stays.
template <int D>
void expect_diffusion_of_what_is_not_linear() {
  SphWater<D> water(count_of(D), 0.15, false);
  water.set(water.points.density,
            [](const Vector<D>& x) { return 1000.0 + 20.0 * x[0] - 9.0 * x[1]; });
  water.find();
  for (Index i = 0; i < water.points.count; ++i) {
    // At corners shape tensors are lifted.
    const Vector<D> x = water.points.at(i);
    int borders = 0;
    for (const double c : x) borders += c < horizon || c > water.width - horizon;
    if (borders < 1) {
      EXPECT_NEAR(water.moments.diffusion[i], 0.0, 1e-9);
    }
  }
  SphWater<D> mixed(count_of(D), 0.15, true);
  mixed.shake();
  mixed.find();
  double gained = 0.0, size = 0.0;
  for (Index i = 0; i < mixed.points.count; ++i) {
    gained += mixed.points.volume[i] * mixed.moments.diffusion[i];
    size += mixed.points.volume[i] * std::abs(mixed.moments.diffusion[i]);
  }
  EXPECT_LT(std::abs(gained), 1e-13 * size);
  EXPECT_GT(size, 0.0);
}

TEST(SphOperators, DiffuseNoLinearDensityAndKeepTheRest) {
  expect_diffusion_of_what_is_not_linear<2>();
  expect_diffusion_of_what_is_not_linear<3>();
}

}  // namespace
}  // namespace perifrac::sph_operators
