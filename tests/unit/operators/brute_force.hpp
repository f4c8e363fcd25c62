#pragma once

#include <vector>

#include <Eigen/Dense>

#include "core/base/points.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/influence_function.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac::test {

/// A point or one of its images, found without the library: every point is mirrored at every
/// combination of mirrored faces, one an axis, and at the sphere.
template <int D>
struct Node {
  Vector<D> x;
  Index source;
  FaceSet faces;
  double volume;
};

template <int D>
std::vector<Node<D>> all_images(const Points<D>& points, std::span<const Face> faces,
                                FaceSet mirrored) {
  std::vector<Node<D>> nodes;
  for (Index i = 0; i < points.size(); ++i) {
    nodes.push_back({points.at(i), i, 0, points.volume[i]});
  }
  for (int a = -1; a < D; ++a) {
    const std::vector<Node<D>> before = nodes;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (faces[f].axis != a || !contains(mirrored, f)) continue;
      for (Node<D> node : before) {
        if (a >= 0) {
          node.x[a] = 2.0 * faces[f].coordinate - node.x[a];
        } else {
          const double r = Eigen::Map<const Eigen::Matrix<double, D, 1>>(node.x.data()).norm();
          const double stretch = 2.0 * faces[f].coordinate / r - 1.0;
          for (double& x : node.x) x *= stretch;
          node.volume *= std::pow(stretch, D - 1);
        }
        node.faces |= face_bit(f);
        nodes.push_back(node);
      }
    }
  }
  return nodes;
}

template <int D>
double distance(const Vector<D>& x, const Vector<D>& y) {
  double r2 = 0.0;
  for (int a = 0; a < D; ++a) r2 += (y[a] - x[a]) * (y[a] - x[a]);
  return std::sqrt(r2);
}

/// Which (face, component) pairs are odd, and about what value.
template <int D, int R>
struct OddFaces {
  struct Pair {
    int face;
    int component;
  };
  std::vector<Pair> pairs;  ///< in the order of their face values

  /// u at a node: 2 U - u behind one odd face, u behind two.
  double value(const Node<D>& node, int component, Index points, std::span<const double> u) const {
    double sum = 0.0;
    int crossed = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (pairs[k].component != component || !contains(node.faces, pairs[k].face)) continue;
      sum += u[static_cast<std::size_t>(R) * points + k];
      ++crossed;
    }
    const double own = u[static_cast<std::size_t>(component) * points + node.source];
    return crossed % 2 == 0 ? own : 2.0 * sum / crossed - own;
  }

  MirrorCondition<D, R> mirror_condition(const Family<D>& family) const {
    MirrorCondition<D, R> mirror(family);
    for (const Pair& pair : pairs) mirror.set_odd(pair.face, pair.component);
    return mirror;
  }
};

/// The energy of LinearExactOperator by its definition, over all pairs of points and images.
template <int D, int R, class Law>
double brute_force_energy(const Points<D>& points, const std::vector<Node<D>>& nodes,
                          const OddFaces<D, R>& odd, const Law& law, double horizon,
                          std::span<const double> u) {
  using Shape = Eigen::Matrix<double, D, D>;
  using Gradient = Eigen::Matrix<double, R, D>;
  using Field = Eigen::Matrix<double, R, 1>;
  using Bond = Eigen::Matrix<double, D, 1>;
  double energy = 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    struct Member {
      Bond xi;
      Field difference;
      double weight;
    };
    std::vector<Member> family;
    const Vector<D> x = points.at(i);
    for (const Node<D>& node : nodes) {
      const double r = distance<D>(x, node.x);
      if (r == 0.0 || r > horizon * (1.0 + 1e-9)) continue;
      Member member;
      for (int a = 0; a < D; ++a) member.xi[a] = node.x[a] - x[a];
      for (int c = 0; c < R; ++c) {
        member.difference[c] = odd.value(node, c, points.size(), u) -
                               u[static_cast<std::size_t>(c) * points.size() + i];
      }
      const double s = r / (0.4 * horizon);
      member.weight = std::exp(-s * s) * node.volume;
      family.push_back(member);
    }
    Shape shape = Shape::Zero();
    Gradient moment = Gradient::Zero();
    for (const Member& m : family) {
      shape += m.weight * m.xi * m.xi.transpose();
      moment += m.weight * m.difference * m.xi.transpose();
    }
    const Gradient f = moment * shape.inverse();
    Tensor<R, D> gradient;
    for (int c = 0; c < R; ++c) {
      for (int b = 0; b < D; ++b) gradient[c * D + b] = f(c, b);
    }
    const Tensor<R, D> stress = law.stress(gradient);
    double density = 0.0;
    for (int k = 0; k < R * D; ++k) density += 0.5 * stress[k] * gradient[k];
    for (const Member& m : family) {
      density += 0.5 * law.stabilisation() / shape.trace() * m.weight *
                 (m.difference - f * m.xi).squaredNorm();
    }
    energy += points.volume[i] * density;
  }
  return energy;
}

}  // namespace perifrac::test
