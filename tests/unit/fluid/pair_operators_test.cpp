#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"
#include "modules/fluid/points/symmetric_tensor.hpp"
#include "modules/fluid/semi_lagrangian/find_moments.hpp"
#include "modules/fluid/semi_lagrangian/fluid_momentum.hpp"

/// The operators of the free fluid on points with given fields.
namespace perifrac {
namespace {

const FluidProperties fluid{.density = 1000.0, .bulk_modulus = 1e6, .viscosity = 3.0};

template <int D>
using Field = std::function<double(const Vector<D>&)>;

template <int D>
struct Cloud {
  Cloud(int across, double spacing, double jitter = 0.0)
      : scheme{.spacing = spacing,
               .horizon = 2.5 * spacing,
               .artificial_viscosity = 0.0,
               .density_diffusion = 0.5,
               .shifting = 0.0,
               .courant = 0.35},
        influence(scheme.horizon),
        neighbours(scheme.horizon, 0.25 * spacing, {}),
        low(across * spacing) {
    std::array<int, D> counts;
    counts.fill(across);
    const Points<D> lattice = box_lattice<D>(counts, spacing);
    std::mt19937 bits(11);
    std::uniform_real_distribution<double> shift(-jitter * spacing, jitter * spacing);
    for (Index i = 0; i < lattice.size(); ++i) {
      Vector<D> x = lattice.at(i);
      for (double& component : x) component += shift(bits);
      points.add(x, {}, fluid.density, fluid.density * lattice.volume[i]);
    }
    neighbours.find(points, {}, walls);
    points.volume.assign(points.count, lattice.volume[0]);
    points.pressure.assign(points.count, 0.0);
    moments.bulk_trace = lattice_trace<D>(spacing, scheme.horizon, influence);
  }

  void set(std::vector<double>& values, const Field<D>& field) const {
    for (Index i = 0; i < points.count; ++i) values[i] = field(points.at(i));
  }

  void find() {
    FluidValues<D> values;
    find_moments<D>(points, walls, neighbours, influence, values, moments);
    for (int k = 0; k < symmetric_size<D>; ++k) {
      stress[k].resize(points.count);
      for (Index i = 0; i < points.count; ++i) {
        stress[k][i] = -points.pressure[i] * moments.inverse_shape[k][i];
      }
    }
    ForceValues<D> force_values;
    find_pair_forces<D>(
        {points, cloud, neighbours, moments, fluid, scheme, influence, gravity, stress}, influence,
        force_values, forces);
  }

  /// Calls use(i, x) for the points so many horizons from the outermost ones.
  template <class Use>
  void for_inner(int horizons, Use&& use) const {
    int count = 0;
    for (Index i = 0; i < points.count; ++i) {
      const Vector<D> x = points.at(i);
      bool inner = true;
      for (const double c : x) {
        const double margin = horizons * scheme.horizon + scheme.spacing;
        inner = inner && c > margin && c < low - margin;
      }
      if (inner) use(i, x), ++count;
    }
    ASSERT_GT(count, 8);
  }

  FluidScheme scheme;
  GaussianInfluence influence;
  FluidNeighbours<D> neighbours;
  double low;
  FluidPoints<D> points;
  WallCloud<D> cloud;
  NearWalls<D> walls;
  FluidMoments<D> moments;
  Vector<D> gravity{};
  std::array<std::vector<double>, symmetric_size<D>> stress;
  FluidForces<D> forces;
};

constexpr int across(int dimension) { return dimension == 2 ? 26 : 15; }

template <int D>
void expect_exact_force_of_linear_pressure() {
  Cloud<D> cloud(across(D), 0.1);
  cloud.set(cloud.points.pressure, [](const Vector<D>& x) {
    double p = 5e4;
    for (int a = 0; a < D; ++a) p += (1e4 + 3e3 * a) * x[a];
    return p;
  });
  cloud.find();
  cloud.for_inner(2, [&](Index i, const Vector<D>&) {
    for (int a = 0; a < D; ++a) {
      const double expected = -(1e4 + 3e3 * a) * cloud.points.volume[i];
      EXPECT_NEAR(cloud.forces.force[a][i], expected, 1e-11 * std::abs(expected));
    }
  });
}

TEST(PairForces, OfLinearPressureAreExactInALattice2D) {
  expect_exact_force_of_linear_pressure<2>();
}
TEST(PairForces, OfLinearPressureAreExactInALattice3D) {
  expect_exact_force_of_linear_pressure<3>();
}

template <int D>
void expect_exact_drag_of_quadratic_velocity() {
  Cloud<D> cloud(across(D), 0.1);
  // Shear: no component changes along itself.
  cloud.set(cloud.points.velocity[0],
            [](const Vector<D>& x) { return 1.0 + x[1] - 2.0 * x[1] * x[1]; });
  cloud.find();
  cloud.for_inner(2, [&](Index i, const Vector<D>&) {
    const double expected = -4.0 * fluid.viscosity * cloud.points.volume[i];
    EXPECT_NEAR(cloud.forces.force[0][i], expected, 1e-10 * std::abs(expected));
    EXPECT_NEAR(cloud.forces.force[1][i], 0.0, 1e-12 * std::abs(expected));
  });
}

TEST(PairForces, OfQuadraticVelocityAreExactInALattice2D) {
  expect_exact_drag_of_quadratic_velocity<2>();
}
TEST(PairForces, OfQuadraticVelocityAreExactInALattice3D) {
  expect_exact_drag_of_quadratic_velocity<3>();
}

/// The difference form is exact on any points that do not lie on one side only.
template <int D>
void expect_exact_divergence_of_linear_velocity() {
  Cloud<D> cloud(across(D) - 4, 0.1, 0.2);
  double expected = 0.0;
  for (int a = 0; a < D; ++a) {
    cloud.set(cloud.points.velocity[a], [a](const Vector<D>& x) {
      double v = 1.0;
      for (int b = 0; b < D; ++b) v += (0.3 + 0.7 * a - 0.2 * b * b) * x[b];
      return v;
    });
    expected += 0.3 + 0.7 * a - 0.2 * a * a;
  }
  cloud.find();
  cloud.for_inner(1, [&](Index i, const Vector<D>&) {
    EXPECT_NEAR(cloud.moments.divergence[i], expected, 1e-12);
  });
}

TEST(Moments, DivergenceOfLinearVelocityIsExact2D) {
  expect_exact_divergence_of_linear_velocity<2>();
}
TEST(Moments, DivergenceOfLinearVelocityIsExact3D) {
  expect_exact_divergence_of_linear_velocity<3>();
}

/// And free surfaces do not make a linear density diffuse.
template <int D>
void expect_diffusion_of_curved_density_alone() {
  Cloud<D> cloud(across(D), 0.1);
  cloud.set(cloud.points.density, [](const Vector<D>& x) { return 1000.0 + 3.0 * x[0] - x[1]; });
  cloud.find();
  for (Index i = 0; i < cloud.points.count; ++i) {
    // In corners the shape tensor is regularised.
    int near = 0;
    for (const double c : cloud.points.at(i)) near += c < 0.2 || c > cloud.low - 0.2;
    if (near > 1) continue;
    EXPECT_NEAR(cloud.moments.diffusion[i], 0.0, 1e-9);
  }
  cloud.set(cloud.points.density, [](const Vector<D>& x) {
    return 1000.0 + 3.0 * x[0] - x[1] + 2.0 * x[0] * x[0] + 5.0 * x[1] * x[1];
  });
  cloud.find();
  cloud.for_inner(
      1, [&](Index i, const Vector<D>&) { EXPECT_NEAR(cloud.moments.diffusion[i], 14.0, 1e-8); });
}

TEST(Moments, OnlyCurvedDensityDiffuses2D) { expect_diffusion_of_curved_density_alone<2>(); }
TEST(Moments, OnlyCurvedDensityDiffuses3D) { expect_diffusion_of_curved_density_alone<3>(); }

struct Errors {
  double pressure = 0.0, divergence = 0.0;
};

/// Of smooth fields on points `spacing` apart, about the same place.
Errors errors(double spacing) {
  Cloud<2> cloud(static_cast<int>(std::lround(4.0 / spacing)), spacing);
  cloud.set(cloud.points.pressure,
            [](const Vector<2>& x) { return 1e4 * std::sin(2.0 * x[0]) * std::cos(x[1]); });
  cloud.find();
  Errors errors;
  const auto near_centre = [](const Vector<2>& x) {
    return std::abs(x[0] - 2.0) < 0.5 && std::abs(x[1] - 2.0) < 0.5;
  };
  cloud.for_inner(2, [&](Index i, const Vector<2>& x) {
    if (!near_centre(x)) return;
    const double exact = -2e4 * std::cos(2.0 * x[0]) * std::cos(x[1]);
    errors.pressure = std::max(errors.pressure,
                               std::abs(cloud.forces.force[0][i] / cloud.points.volume[i] - exact));
  });
  cloud.set(cloud.points.velocity[0],
            [](const Vector<2>& x) { return std::sin(2.0 * x[0]) * std::cos(x[1]); });
  cloud.set(cloud.points.velocity[1],
            [](const Vector<2>& x) { return std::sin(x[1] + 0.5 * x[0]); });
  cloud.find();
  cloud.for_inner(2, [&](Index i, const Vector<2>& x) {
    if (!near_centre(x)) return;
    const double exact = 2.0 * std::cos(2.0 * x[0]) * std::cos(x[1]) + std::cos(x[1] + 0.5 * x[0]);
    errors.divergence = std::max(errors.divergence, std::abs(cloud.moments.divergence[i] - exact));
  });
  return errors;
}

TEST(PairOperators, AreOfSecondOrderInALattice) {
  const Errors coarse = errors(0.1), fine = errors(0.05);
  EXPECT_GT(coarse.pressure, 1.0);
  EXPECT_GT(std::log2(coarse.pressure / fine.pressure), 1.9);
  EXPECT_GT(coarse.divergence, 1e-4);
  EXPECT_GT(std::log2(coarse.divergence / fine.divergence), 1.9);
}

template <int D>
void expect_lattice_trace(double horizon) {
  constexpr double spacing = 0.1;
  const GaussianInfluence influence(horizon);
  const int reach = static_cast<int>(horizon / spacing) + 2;
  std::array<int, D> counts, first;
  counts.fill(2 * reach + 1);
  first.fill(-reach);
  const Points<D> lattice = box_lattice<D>(counts, spacing, first);
  double trace = 0.0;
  for (Index i = 0; i < lattice.size(); ++i) {
    double square = 0.0;
    for (const double c : lattice.at(i)) square += (c - 0.05) * (c - 0.05);
    trace += influence(square) * square * lattice.volume[i];
  }
  EXPECT_NEAR(lattice_trace<D>(spacing, horizon, influence), trace, 1e-13 * trace);
}

TEST(LatticeTrace, IsThatOfALattice) {
  for (const double horizon : {0.15, 0.25, 0.31}) {
    expect_lattice_trace<2>(horizon);
    expect_lattice_trace<3>(horizon);
  }
}

/// Integrals of r^2 exp(-(r / 0.4)^2) within a horizon of 1.
TEST(LatticeSums, ComeToTheirIntegrals) {
  const double h = 0.4, s = 1.0 / (h * h);
  const double disc = std::numbers::pi * std::pow(h, 4) * (1.0 - (1.0 + s) * std::exp(-s));
  EXPECT_NEAR(lattice_trace<2>(0.02, 1.0, GaussianInfluence(1.0)), disc, 2e-4 * disc);
  const double tail = 1.0 / h;
  const double ball = 4.0 * std::numbers::pi * std::pow(h, 5) *
                      (3.0 / 8.0 * std::sqrt(std::numbers::pi) * std::erf(tail) -
                       (0.5 * std::pow(tail, 3) + 0.75 * tail) * std::exp(-s));
  EXPECT_NEAR(lattice_trace<3>(0.04, 1.0, GaussianInfluence(1.0)), ball, 2e-3 * ball);
}

}  // namespace
}  // namespace perifrac
