#pragma once

#include "core/geometry/jitter.hpp"
#include "core/geometry/space_filling_curve.hpp"
#include "core/geometry/voronoi.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac::test {

enum class Volumes { lattice, voronoi };
enum class Weights { plain, projected };

/// A jittered box as a scene makes it.
template <int D>
std::shared_ptr<const Body<D>> irregular_box(const std::array<int, D>& counts, double spacing,
                                             unsigned seed, Volumes volumes = Volumes::voronoi,
                                             Weights weights = Weights::projected,
                                             double jitter = 0.2) {
  Points<D> points = box_lattice<D>(counts, spacing);
  sort_along_curve(points, spacing);
  jitter_points<D>(points, jitter * spacing, seed);
  Vector<D> low{}, high;
  for (int a = 0; a < D; ++a) high[a] = counts[a] * spacing;
  if (volumes == Volumes::voronoi) set_voronoi_volumes<D>(points, low, high, spacing);
  const auto body = std::make_shared<Body<D>>(std::move(points), box_faces<D>(counts, spacing),
                                              spacing, 2.5 * spacing, InfluenceFunction::gaussian);
  body->set_irregular(weights == Weights::projected);
  return body;
}

}  // namespace perifrac::test
