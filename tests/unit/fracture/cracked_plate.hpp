#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "modules/solid/fracture/condensed_body.hpp"
#include "modules/solid/fracture/energy_release.hpp"
#include "tests/unit/fracture/crystal_crack.hpp"
#include "tests/unit/fracture/exact_crack.hpp"
#include "tests/unit/fracture/rock.hpp"
#include "tests/unit/operators/irregular_body.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac::test {

/// Along the diagonal of a lattice [rad].
inline constexpr double quarter = M_PI / 4.0;

/// A square plate of n * n points at spacing 1 around the origin of a crack, with E' = 1. Points in
/// the outer rows move as they are told, which stands for the plate going on for ever: so many that
/// those inside have no bonds to points with cut families, where those matter.
struct CrackedPlate {
  int outer_rows;

  int n;
  double poisson_ratio;
  std::shared_ptr<const Body<2>> body;
  std::shared_ptr<Family<2>> family;
  SolidBoundary<2> boundary;
  std::shared_ptr<BreakableElasticity<2>> elastic;
  BondState<2> bonds;
  std::vector<Index> told;
  std::unique_ptr<CondensedBody<2>> cracked;
  Eigen::VectorXd prescribed;

  double shear_modulus() const { return 0.5 * (1.0 - poisson_ratio); }
  Vector<2> middle() const { return {0.5 * n, 0.5 * n}; }
  Eigen::Index free_count() const { return free_.cols(); }  ///< unknowns that are solved for

  CrackedPlate(int count, std::vector<CrackFacet<2>> seeds, double poisson = 0.25,
               std::shared_ptr<const Body<2>> shape = nullptr,
               std::optional<InitialStress<2>> initial_stress = {}, Rock rock = Rock::linear_exact)
      : outer_rows(rock == Rock::lps ? 5 : 3),
        n(count),
        poisson_ratio(poisson),
        body(shape ? shape : box_body<2>({n, n}, 1.0)),
        family(std::make_shared<Family<2>>(*body->family(0))),
        boundary(*body) {
    const double mu = shear_modulus();
    const IsotropicElasticity<2> law{2.0 * mu * poisson / (1.0 - 2.0 * poisson), mu};
    const auto mirror = boundary.mirror_condition(*family);
    elastic = breakable<2>(rock, family, mirror, law);
    std::vector<Eigen::Triplet<double>> ones;
    const Index points = family->point_count;
    const auto is_told = [&](Index i) {
      const Vector<2> x = body->points().at(i);
      const double inside = std::min({x[0], x[1], n - x[0], n - x[1]});
      return inside < outer_rows;
    };
    int column = 0;
    for (Index k = 0; k < 2 * points; ++k) {
      if (!is_told(k % points)) ones.emplace_back(k, column++, 1.0);
    }
    for (Index i = 0; i < points; ++i) {
      if (is_told(i)) told.push_back(i);
    }
    Eigen::SparseMatrix<double> free(2 * points, column);
    free.setFromTriplets(ones.begin(), ones.end());
    free_ = free;
    cracked = std::make_unique<CondensedBody<2>>(family, 1.0, elastic, free, bonds, initial_stress,
                                                 std::move(seeds));
    cracked->start();
    prescribed = Eigen::VectorXd::Zero(2 * points);
  }

  /// The equilibrium with the outer rows where the exact crack's plate has them, and its pressure.
  template <class Crack>
  Eigen::VectorXd solve(const Crack& exact) {
    const Index points = family->point_count;
    for (const Index i : told) {
      const Vector<2> u = exact.displacement(body->points().at(i));
      for (int a = 0; a < 2; ++a) prescribed[a * points + i] = u[a];
    }
    const std::vector<double> u(prescribed.begin(), prescribed.end());
    cracked->set_load(-free_.transpose() * inner_force(u, {}));
    pressure = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(cracked->jumps().size()),
                                         exact.pressure);
    return prescribed + cracked->unknowns(pressure);
  }

  /// The equilibrium with the outer rows at rest, under a pore stress of the points and a pressure
  /// in the crack.
  Eigen::VectorXd solve(std::span<const double> pore_stress, double face_pressure) {
    const std::vector<double> rest(prescribed.size(), 0.0);
    cracked->set_load(-free_.transpose() * inner_force(rest, {pore_stress}));
    pressure = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(cracked->jumps().size()),
                                         face_pressure);
    return cracked->unknowns(pressure);
  }

  /// Of that equilibrium, the loads' potential included.
  double potential_energy(std::span<const double> u, std::span<const double> pore_stress) {
    const Eigen::Map<const Eigen::VectorXd> move(u.data(), prescribed.size());
    const Eigen::VectorXd elastic_force = inner_force(u, {});
    const Eigen::VectorXd load = elastic_force - inner_force(u, {pore_stress});
    return 0.5 * move.dot(elastic_force) - move.dot(load) -
           move.dot(cracked->face_force(pressure, false));
  }

  /// What the plate is as a whole while it is intact: the mean stress of points with whole families
  /// where the outer rows move with a uniform strain. Leaves the load changed.
  PlaneStiffness effective_stiffness() {
    PlaneStiffness stiffness;
    const Index points = family->point_count;
    for (int column = 0; column < 3; ++column) {
      for (const Index i : told) {
        const Vector<2> x = body->points().at(i);
        prescribed[i] = column == 0 ? x[0] : column == 1 ? 0.0 : x[1];
        prescribed[points + i] = column == 1 ? x[1] : 0.0;
      }
      const std::vector<double> u(prescribed.begin(), prescribed.end());
      cracked->set_load(-free_.transpose() * inner_force(u, {}));
      const Eigen::VectorXd all = prescribed + cracked->unknowns(Eigen::VectorXd(0));
      std::vector<double> stress(4 * points);
      elastic->stress({all.data(), static_cast<std::size_t>(all.size())}, stress);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double volume = 0.0;
      for (Index i = 0; i < points; ++i) {
        const Vector<2> x = body->points().at(i);
        if (std::min({x[0], x[1], n - x[0], n - x[1]}) < outer_rows) continue;
        const auto at = [&](int k) { return stress[static_cast<std::size_t>(k) * points + i]; };
        sum += family->volume[i] * Eigen::Vector3d(at(0), at(3), 0.5 * (at(1) + at(2)));
        volume += family->volume[i];
      }
      stiffness.col(column) = sum / volume;
    }
    return 0.5 * (stiffness + stiffness.transpose());
  }

  Eigen::VectorXd pressure;

  /// The tip of a straight crack at its end (1) or its beginning (0).
  template <class Crack>
  CrackTip tip(const Crack& exact, int end) const {
    const double sign = end == 1 ? 1.0 : -1.0;
    const Vector<2> ahead = {sign * std::cos(exact.angle), sign * std::sin(exact.angle)};
    const Vector<2> place = {exact.centre[0] + exact.half_length * ahead[0],
                             exact.centre[1] + exact.half_length * ahead[1]};
    return {place, ahead, nearest_facet(place - 0.5 * ahead), nearest_facet(place - 1.5 * ahead)};
  }
  template <class Crack>
  TipLoad tip_load(const Crack& exact, int end, const Eigen::VectorXd& u) const {
    return EnergyRelease(*cracked, 1.0)
        .at(tip(exact, end), {u.data(), static_cast<std::size_t>(u.size())}, pressure);
  }

 private:
  Index nearest_facet(const Vector<2>& place) const {
    const std::span<const CrackFacet<2>> facets = cracked->facets();
    if (facets.empty()) return no_facet;
    const auto distance = [&](const CrackFacet<2>& facet) {
      return norm(0.5 * (facet[0] + facet[1]) - place);
    };
    return static_cast<Index>(std::ranges::min_element(facets, {}, distance) - facets.begin());
  }
  Eigen::VectorXd inner_force(std::span<const double> u, const PoreStress& pore) {
    Eigen::VectorXd force(prescribed.size());
    std::vector<double> theta(family->point_count);
    elastic->apply(u, pore, {force.data(), u.size()}, theta);
    return force;
  }

  Eigen::SparseMatrix<double> free_;
};

/// Facets of a straight crack of `count` spacings about a centre.
inline std::vector<CrackFacet<2>> straight_crack(const Vector<2>& centre, double angle, int count) {
  const auto at = [&](int k) {
    const double r = k - 0.5 * count;
    return Vector<2>{centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle)};
  };
  std::vector<CrackFacet<2>> facets;
  for (int k = 0; k < count; ++k) facets.push_back({at(k), at(k + 1)});
  return facets;
}

}  // namespace perifrac::test
