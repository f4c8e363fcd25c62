#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "core/state/snapshot.hpp"
#include "modules/solid/quasi_static_solid.hpp"
#include "tests/port_named.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac::test {

inline constexpr double lambda = 3.0, mu = 2.0;

/// A quasi-static solid that a test puts together: a body, then a boundary, then start().
template <int D>
struct Solid {
  std::shared_ptr<const Body<D>> body;
  SolidBoundary<D> boundary;
  std::unique_ptr<QuasiStaticSolid<D>> module{};
  double time = 0.0;

  explicit Solid(std::shared_ptr<const Body<D>> shape) : body(std::move(shape)), boundary(*body) {}
  explicit Solid(const std::array<int, D>& counts, double spacing = 0.5)
      : Solid(box_body<D>(counts, spacing)) {}

  Index points() const { return body->points().size(); }

  PortView port(const std::string& name) { return test::port_named(*module, name); }

  void start() {
    module = std::make_unique<QuasiStaticSolid<D>>(body, elastic<D>(*body, boundary, {lambda, mu}),
                                                   boundary);
    module->initialize(0.0);
  }

  void step(double length = 1.0) {
    module->advance({time, time + length});
    time += length;
  }

  /// External force on every unknown, reactions included.
  std::vector<double> external_force() {
    Snapshot state;
    state.save([&](StateVisitor& visitor) { module->visit_state(visitor); });
    return std::get<std::vector<double>>(state.fields().at("external_force"));
  }

  /// Largest difference from u_a = slope[a] x_a, over the largest displacement.
  double error(const Vector<D>& slope) {
    const auto u = port("displacement").value;
    double worst = 0.0;
    for (int a = 0; a < D; ++a) {
      for (Index i = 0; i < points(); ++i) {
        worst = std::max(worst,
                         std::abs(u[a * points() + i] - slope[a] * body->points().position[a][i]));
      }
    }
    return worst / largest(u);
  }

  Vector<D> stress(const Vector<D>& slope) const {
    Vector<D> result;
    const double dilatation = std::accumulate(slope.begin(), slope.end(), 0.0);
    for (int a = 0; a < D; ++a) result[a] = lambda * dilatation + 2.0 * mu * slope[a];
    return result;
  }

  double energy_of(const Vector<D>& slope) const {
    const Vector<D> s = stress(slope);
    double density = 0.0;
    for (int a = 0; a < D; ++a) density += 0.5 * s[a] * slope[a];
    return density *
           std::accumulate(body->points().volume.begin(), body->points().volume.end(), 0.0);
  }
};

}  // namespace perifrac::test
