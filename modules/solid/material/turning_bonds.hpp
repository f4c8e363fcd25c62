#pragma once

#include <span>
#include <vector>

#include "core/base/small_vector.hpp"
#include "core/operators/node_unknowns.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// The energy of one point as bond_energy_stiffness() has it, with the extension
/// e = |xi + du| - |xi| of its bonds, however far they turn. Each bond's force lies along it, so
/// that it has no moment.
template <int D>
class TurningBonds {
 public:
  TurningBonds(const Family<D>& family, const MirrorCondition<D, D>& mirror,
               const IsotropicElasticity<D>& law, Index i)
      : bulk_(family.volume[i] * law.drained_bulk_modulus()),
        shear_(family.volume[i] * D * (D + 2) * law.shear_modulus) {
    for (const auto& [j, weight] : family.bonds(i)) {
      if (weight == 0.0) continue;
      Bond bond{};
      bond.weight = weight;
      bond.xi = vector_at(family.position, j) - vector_at(family.position, i);
      for (int a = 0; a < D; ++a) {
        bond.parting[a] = node_unknowns(family, mirror, j, a);
        bond.parting[a].add(a * family.point_count + i, -1.0);
      }
      bond.length = norm(bond.xi);
      weighted_volume_ += bond.weight * squared_norm(bond.xi);
      bonds_.push_back(bond);
    }
  }

  double energy(std::span<const double> u) const {
    if (bonds_.empty()) return 0.0;
    const double theta = dilatation(u);
    double rest = 0.0;
    for (const Bond& bond : bonds_) {
      const double deviation = extension(bond, now(bond, u)) - theta * bond.length / D;
      rest += bond.weight * deviation * deviation;
    }
    return 0.5 * (bulk_ * theta * theta + shear_ / weighted_volume_ * rest);
  }

  /// Adds the derivative of energy() to `force`.
  void add_force(std::span<const double> u, std::span<double> force) const {
    if (bonds_.empty()) return;
    const double theta = dilatation(u);
    for (const Bond& bond : bonds_) {
      const Vector<D> y = now(bond, u);
      const double extended = extension(bond, y), length = bond.length + extended;
      if (!(length > 0.0)) continue;  // its ends met: it pulls nowhere
      const double pull =
          bond.weight / weighted_volume_ *
          (bulk_ * D * theta * bond.length + shear_ * (extended - theta * bond.length / D));
      for (int a = 0; a < D; ++a) {
        const Combination& parting = bond.parting[a];
        for (int k = 0; k < parting.count; ++k) {
          force[parting.terms[k].unknown] += parting.terms[k].coefficient * pull * y[a] / length;
        }
      }
    }
  }

 private:
  struct Bond {
    std::array<Combination, D> parting;  ///< du
    Vector<D> xi;
    double length;
    double weight;
  };

  static Vector<D> now(const Bond& bond, std::span<const double> u) {
    Vector<D> y = bond.xi;
    for (int a = 0; a < D; ++a) {
      const Combination& parting = bond.parting[a];
      for (int k = 0; k < parting.count; ++k) {
        y[a] += parting.terms[k].coefficient * u[parting.terms[k].unknown];
      }
    }
    return y;
  }

  /// |y| - |xi|, with no loss of digits where y is near xi.
  static double extension(const Bond& bond, const Vector<D>& y) {
    return dot(y - bond.xi, y + bond.xi) / (norm(y) + bond.length);
  }

  double dilatation(std::span<const double> u) const {
    double sum = 0.0;
    for (const Bond& bond : bonds_) {
      sum += bond.weight * bond.length * extension(bond, now(bond, u));
    }
    return D / weighted_volume_ * sum;
  }

  std::vector<Bond> bonds_;
  double bulk_;   ///< V k [J/m^(3-D)]
  double shear_;  ///< V D (D + 2) mu
  double weighted_volume_ = 0.0;
};

}  // namespace perifrac
