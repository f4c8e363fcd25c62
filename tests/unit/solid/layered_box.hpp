#pragma once

#include <memory>
#include <vector>

#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac::test {

inline constexpr int layer_rows = 3;  // a horizon of 2.5 spacings, rounded up

/// A box of nominal counts * spacing from the origin with a bonded layer behind each face named.
template <int D>
std::shared_ptr<const Body<D>> layered_box(std::array<int, D> counts, double spacing,
                                           const std::vector<int>& layered) {
  std::vector<Face> faces = box_faces<D>(counts, spacing);
  for (const int f : layered) counts[f / 2] += layer_rows;
  Points<D> points = box_lattice<D>(counts, spacing);
  std::vector<std::vector<Index>> layers(2 * D);
  for (const int f : layered) {
    if (f % 2 == 1) continue;
    for (double& x : points.position[f / 2]) x -= layer_rows * spacing;
  }
  for (const int f : layered) {
    for (Index i = 0; i < points.size(); ++i) {
      const double beyond = points.position[f / 2][i] - faces[f].coordinate;
      if (faces[f].direction * beyond > 0.0) layers[f].push_back(i);
    }
  }
  auto body = std::make_shared<Body<D>>(std::move(points), std::move(faces), spacing, 2.5 * spacing,
                                        InfluenceFunction::gaussian);
  body->set_layers(std::move(layers));
  return body;
}

}  // namespace perifrac::test
