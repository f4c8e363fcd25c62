#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac::test {

/// A system with everything that can stand in its matrix.
template <int D>
struct NewtonSetting {
  explicit NewtonSetting(int edge = 6, FlowScheme scheme = FlowScheme::conservative)
      : body(body_with_layer_on_top<D>(cube<D>(edge), 3.0 / edge)),
        slope(random_values(body->points().volume.size(), 5)),
        zero(slope.size(), 0.0),
        system(make(scheme)) {
    for (double& s : slope) s = 0.2 * (1.0 + 0.5 * s);  // per point
    system.set_dilatation({zero, zero, slope, 0.0});
  }

  DarcySystem<D> make(FlowScheme scheme) {
    PoreBoundary<D> boundary(*body);
    boundary.pressure(0, 0.4);
    boundary.pressure(3, -0.2);
    boundary.pressure(2 * D - 1, 0.3);  // of the layer
    boundary.source(3, 0.7);
    return darcy_system<D>(*body, boundary, some_rock, scheme);
  }

  /// What is left out of J are the energies, which follow the flow.
  std::size_t followed() const { return system.size() - 2; }

  /// r - (I - gamma J) solution.
  std::vector<double> residual(std::span<const double> r, std::span<const double> solution,
                               double gamma) {
    const std::vector<double> y(system.size(), 0.0);
    std::vector<double> left(system.size());
    system.jacobian_times(0.0, y, solution, left);
    for (std::size_t k = 0; k < followed(); ++k) {
      left[k] = r[k] - solution[k] + gamma * left[k];
    }
    std::fill(left.begin() + static_cast<std::ptrdiff_t>(followed()), left.end(), 0.0);
    return left;
  }

  /// Volume at the points less what came in through the faces.
  double kept_volume(std::span<const double> y) const {
    double sum = 0.0;
    for (Index i = 0; i < system.points(); ++i) sum += system.volume()[i] * y[i];
    for (std::size_t k = system.points(); k < followed(); ++k) sum -= y[k];
    return sum;
  }

  std::shared_ptr<const Body<D>> body;
  std::vector<double> slope, zero;
  DarcySystem<D> system;
};

}  // namespace perifrac::test
