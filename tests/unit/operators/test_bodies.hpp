#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/body/body.hpp"
#include "core/body/bonded_layer.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/space_filling_curve.hpp"
#include "core/operators/nonlocal_gradient.hpp"

namespace perifrac::test {

enum class Cloud { lattice, jittered };

/// A box of counts * spacing. Jittered: every coordinate is moved by up to 20 % of the spacing and
/// every volume changed by up to 10 %.
template <int D>
Points<D> box_points(const std::array<int, D>& counts, double spacing, Cloud cloud) {
  Points<D> points = box_lattice<D>(counts, spacing);
  if (cloud == Cloud::lattice) return points;
  sort_along_curve(points, spacing);
  std::mt19937 bits(7);
  std::uniform_real_distribution<double> shift(-1.0, 1.0);
  for (Index i = 0; i < points.size(); ++i) {
    for (int a = 0; a < D; ++a) points.position[a][i] += 0.2 * spacing * shift(bits);
    points.volume[i] *= 1.0 + 0.1 * shift(bits);
  }
  return points;
}

template <int D>
std::vector<Face> box_faces(const std::array<int, D>& counts, double spacing) {
  std::vector<Face> faces;
  const auto names = face_names<D>();
  for (int a = 0; a < D; ++a) {
    faces.push_back({names[2 * a], a, -1, 0.0});
    faces.push_back({names[2 * a + 1], a, +1, counts[a] * spacing});
  }
  return faces;
}

template <int D>
std::shared_ptr<const Body<D>> box_body(const std::array<int, D>& counts, double spacing,
                                        Cloud cloud = Cloud::lattice, double horizon_ratio = 2.5,
                                        InfluenceFunction influence = InfluenceFunction::gaussian) {
  return std::make_shared<const Body<D>>(box_points<D>(counts, spacing, cloud),
                                         box_faces<D>(counts, spacing), spacing,
                                         horizon_ratio * spacing, influence);
}

/// Of an operator or a material.
template <class Operator>
ForceOfStress force_of(const Operator& op) {
  return [&op](const Eigen::VectorXd& stress) { return op.force_of_stress(stress); };
}

/// From a matrix that makes gradients.
inline ForceOfStress force_by(const Eigen::SparseMatrix<double>& gradient) {
  return [gradient](const Eigen::VectorXd& stress) -> Eigen::VectorXd {
    return gradient.transpose() * stress;
  };
}

/// A box on a lattice with bonded layers behind the faces in `layered`.
template <int D>
std::shared_ptr<const Body<D>> layered_body(const std::array<int, D>& counts, double spacing,
                                            FaceSet layered, double horizon_ratio = 2.5) {
  const int rows = layer_rows(horizon_ratio, 1.0);
  std::array<int, D> first{}, all = counts;
  for (int a = 0; a < D; ++a) {
    if (contains(layered, 2 * a)) first[a] = -rows;
    all[a] += contains(layered, 2 * a + 1) ? rows - first[a] : -first[a];
  }
  const auto faces = box_faces<D>(counts, spacing);
  auto body = std::make_shared<Body<D>>(box_lattice<D>(all, spacing, first), faces, spacing,
                                        horizon_ratio * spacing, InfluenceFunction::gaussian);
  body->set_layers(points_behind<D>(faces, layered, body->points()));
  return body;
}

template <int D>
std::shared_ptr<const Body<D>> ball_body(double radius, double spacing, bool octant = false) {
  return std::make_shared<const Body<D>>(ball_lattice<D>(radius, spacing, octant),
                                         ball_faces<D>(radius, octant), spacing, 2.5 * spacing,
                                         InfluenceFunction::gaussian);
}

/// The same count along every axis.
template <int D>
std::array<int, D> cube(int count) {
  std::array<int, D> counts;
  counts.fill(count);
  return counts;
}

inline std::vector<double> random_values(std::size_t size, unsigned seed = 1) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<double> values(size);
  for (double& v : values) v = value(bits);
  return values;
}

inline double largest(std::span<const double> values) {
  double result = 0.0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

inline double largest(const Eigen::VectorXd& values) {
  return largest(std::span(values.data(), static_cast<std::size_t>(values.size())));
}

inline Eigen::Map<const Eigen::VectorXd> as_eigen(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace perifrac::test
