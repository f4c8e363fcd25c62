#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "core/bonds/bond_state.hpp"
#include "modules/solid/material/corotational_elasticity.hpp"
#include "tests/unit/solid/moving_solid.hpp"

namespace perifrac::test {

template <int D>
using Square = Eigen::Matrix<double, D, D>;

/// About a skew axis in 3D.
template <int D>
Square<D> rotation(double angle) {
  if constexpr (D == 2) {
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  } else {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, -2.0, 0.5).normalized())
        .toRotationMatrix();
  }
}

template <int D>
Eigen::Matrix<double, D, 1> at(std::span<const double> blocks, Index i) {
  const std::size_t points = blocks.size() / D;
  Eigen::Matrix<double, D, 1> result;
  for (int a = 0; a < D; ++a) result[a] = blocks[a * points + i];
  return result;
}

template <int D>
Eigen::Matrix<double, D, 1> place(const Body<D>& body, Index i) {
  Eigen::Matrix<double, D, 1> x;
  for (int a = 0; a < D; ++a) x[a] = body.points().position[a][i];
  return x;
}

/// The displacements that take every point x to move(x).
template <int D, class Move>
std::vector<double> moved(const Body<D>& body, Move&& move) {
  const std::size_t points = body.points().size();
  std::vector<double> u(D * points);
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::Matrix<double, D, 1> x = place(body, static_cast<Index>(i)), to = move(x);
    for (int a = 0; a < D; ++a) u[a * points + i] = to[a] - x[a];
  }
  return u;
}

/// A body of corotational rock, all faces free but those that `boundary` holds, on a family of its
/// own.
template <int D>
struct Turning {
  using Law = IsotropicElasticity<D>;
  std::shared_ptr<Family<D>> family;
  std::shared_ptr<CorotationalElasticity<D, Law>> elastic;

  Turning(const Body<D>& body, const SolidBoundary<D>& boundary)
      : family(std::make_shared<Family<D>>(*body.family(boundary.mirrored()))) {
    elastic = std::make_shared<CorotationalElasticity<D, Law>>(
        LinearExactOperator<D, Law>(family, boundary.mirror_condition(*family), Law{lambda, mu}));
  }
  /// Breaks all bonds between i and points for which `beyond` is true.
  template <class Beyond>
  void cut(Index i, Beyond&& beyond) {
    std::vector<Index> ends = {i};
    for (const auto& bond : family->bonds(i)) {
      const Index j = bond.other;
      if (j < family->point_count && beyond(j)) ends.push_back(j);
    }
    for (std::size_t k = 1; k < ends.size(); ++k) silence(*family, i, ends[k]);
    elastic->update(ends);
  }
  std::vector<double> force(std::span<const double> u) {
    std::vector<double> result(elastic->size());
    elastic->apply(u, {}, result, {});
    return result;
  }
  std::vector<double> small_force(std::span<const double> u) {
    std::vector<double> result(elastic->size());
    elastic->apply_small(u, {}, result, {});
    return result;
  }
};

inline double size(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

inline double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

/// The corotational body in motion.
template <int D>
struct Spinning : Moving<D> {
  using Moving<D>::Moving;
  void start() {
    this->module = std::make_unique<DynamicSolid<D>>(
        this->body, Turning<D>(*this->body, this->boundary).elastic, this->boundary, density,
        this->damping, this->safety);
    this->module->initialize(0.0);
  }
  /// Goes on from these displacements and velocities, D blocks each.
  void set(const std::vector<double>& displacement, const std::vector<double>& velocity) {
    struct Set final : StateVisitor {
      const std::vector<double>*u, *v;
      void real(const std::string& name, std::vector<double>& values) override {
        if (name == "displacement") std::ranges::copy(*u, values.begin());
        if (name == "velocity") std::ranges::copy(*v, values.begin());
        if (name == "acceleration") values.clear();
      }
      void integer(const std::string&, std::vector<std::int64_t>&) override {}
    } set;
    set.u = &displacement;
    set.v = &velocity;
    this->module->visit_state(set);
    this->module->on_restored(this->time);
  }
  double energy() { return this->value("kinetic_energy") + this->value("elastic_energy"); }
};

}  // namespace perifrac::test
