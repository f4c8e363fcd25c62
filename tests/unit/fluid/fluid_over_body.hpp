#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "core/body/body.hpp"
#include "core/geometry/lattice.hpp"
#include "modules/fluid/exchange/exchange.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/semi_lagrangian/find_moments.hpp"
#include "modules/fluid/walls/rigid_wall.hpp"

namespace perifrac::test {

inline double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// `across` by `high` fluid points on as many points of a body, the surface at 0 of the last axis,
/// space repeating along the others; and all that an exchange is found from.
template <int D>
struct FluidOverBody {
  static constexpr int up = D - 1;

  FluidOverBody(int across, int high, double spacing, double jitter = 0.0)
      : scheme{.spacing = spacing,
               .horizon = 2.5 * spacing,
               .artificial_viscosity = 0.1,
               .density_diffusion = 0.5,
               .shifting = 0.0,
               .courant = 0.35},
        influence(GaussianInfluence(scheme.horizon)),
        neighbours(scheme.horizon, 0.25 * spacing, make_period(across * spacing)) {
    std::array<int, D> counts, first{};
    counts.fill(across);
    counts[up] = high;
    first[up] = -high;
    std::vector<Face> faces;
    for (int a = 0; a < D; ++a) {
      const double low = first[a] * spacing;
      faces.push_back({face_names<D>()[2 * a], a, -1, low});
      faces.push_back({face_names<D>()[2 * a + 1], a, +1, low + counts[a] * spacing});
    }
    body = std::make_unique<Body<D>>(box_lattice<D>(counts, spacing, first), faces, spacing,
                                     scheme.horizon, InfluenceFunction::gaussian);
    for (Index j = 0; j < body->points().size(); ++j) {
      for (int a = 0; a < D; ++a) {
        cloud.position[a].push_back(body->points().position[a][j]);
        cloud.normal[a].push_back(a == up ? 1.0 : 0.0);
      }
      cloud.depth.push_back(-body->points().position[up][j]);
      cloud.volume.push_back(body->points().volume[j]);
      cloud.slips.push_back(1);
      cloud.owner.push_back(j);
    }
    std::mt19937 bits(5);
    std::uniform_real_distribution<double> shift(-jitter, jitter);
    const Points<D> lattice = box_lattice<D>(counts, spacing);
    for (Index i = 0; i < lattice.size(); ++i) {
      Vector<D> x = lattice.at(i);
      for (double& coordinate : x) coordinate += shift(bits) * spacing;
      points.add(x, {}, fluid.density, fluid.density * lattice.volume[i]);
    }
    mobility.assign(body->points().size(), 1e-9);
    pressure.assign(body->points().size(), 0.0);
    rate.assign(body->points().size(), 0.0);
    slope.assign(body->points().size(), 0.0);
    mass.assign(body->points().size(), 0.0);
  }

  static Period<D> make_period(double width) {
    Period<D> period;
    for (int a = 0; a < up; ++a) period.ends[a] = {0.0, width};
    return period;
  }

  /// Gives the fluid's points the pressure p(x) and finds lists, images and moments.
  template <class Pressure>
  void prepare(Pressure&& p) {
    neighbours.find(points, cloud.position, walls);
    walls.volume.clear();
    for (const Index w : walls.wall) walls.volume.push_back(cloud.volume[w]);
    for (auto& values : walls.velocity) values.assign(walls.wall.size(), 0.0);
    points.volume.resize(points.count);
    points.pressure.resize(points.count);
    for (Index i = 0; i < points.count; ++i) {
      points.volume[i] = points.mass[i] / points.density[i];
      points.pressure[i] = p(points.at(i));
    }
    for (int a = 0; a < D; ++a) neighbours.images().copy(points.velocity[a], points.count);
    neighbours.images().copy(points.density, points.count);
    neighbours.images().copy(points.volume, points.count);
    neighbours.images().copy(points.pressure, points.count);
    moments.bulk_trace = lattice_trace<D>(scheme.spacing, scheme.horizon, influence);
    FluidValues<D> values;
    find_moments<D>(points, walls, neighbours, GaussianInfluence(scheme.horizon), values, moments);
    neighbours.images().copy(moments.trace, points.count);
  }

  /// What the fluid's points get per time in a step of this length [s].
  std::vector<double> find(Exchange<D>& exchange, double t = 0.0, double length = 1e-3) {
    std::vector<double> rate(points.count);
    walls.mass_rate.assign(walls.count, 0.0);
    for (auto& values : walls.momentum_rate) values.assign(walls.count, 0.0);
    exchange.find(step(), pores(), t, length, walls, rate);
    return rate;
  }

  FluidStep<D> step() const {
    return {points, cloud, neighbours, moments, fluid, scheme, influence, gravity, stress};
  }
  PoreInput pores() const { return {pressure, rate, slope, mobility, 0.0, mass}; }

  FluidProperties fluid{.density = 1000.0, .bulk_modulus = 2e7, .viscosity = 1e-3};
  FluidScheme scheme;
  Vector<D> gravity{};
  PairInfluence influence;
  std::unique_ptr<Body<D>> body;
  std::vector<RigidWall<D>> rigid;
  WallCloud<D> cloud;
  FluidPoints<D> points;
  FluidNeighbours<D> neighbours;
  NearWalls<D> walls;
  FluidMoments<D> moments;
  std::array<std::vector<double>, symmetric_size<D>> stress;
  std::vector<double> pressure, rate, slope, mobility, mass;  ///< of the pores
};

}  // namespace perifrac::test
