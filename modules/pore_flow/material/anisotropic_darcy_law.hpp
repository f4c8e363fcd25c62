#pragma once

#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// Darcy flow with a symmetric, positive semidefinite mobility [m^2/(Pa s)].
template <int D>
struct AnisotropicDarcyLaw {
  static constexpr int components = 1;

  Tensor<D, D> mobility;

  /// Also of packets of gradients.
  template <class Number>
  std::array<Number, D> stress(const std::array<Number, D>& gradient) const {
    std::array<Number, D> result{};
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) result[a] += mobility[a * D + b] * gradient[b];
    }
    return result;
  }

  double mean_mobility() const { return trace(mobility) / D; }

  /// As for an isotropic mobility of the same mean. One number cannot cancel the leading error
  /// along all axes: second order inside.
  double stabilisation() const { return 4.0 * D / 3.0 * mean_mobility(); }

  /// Of the bonds of a family that does not span space (bond_flow.hpp).
  double bonds_alone() const { return D * mean_mobility(); }

  AnisotropicDarcyLaw times(double factor) const {
    AnisotropicDarcyLaw result = *this;
    for (double& entry : result.mobility) entry *= factor;
    return result;
  }
};

/// The same by region, times a factor that changes from point to point and in time.
template <int D>
struct ScaledDarcyLaw {
  static constexpr int components = 1;

  LawByRegion<AnisotropicDarcyLaw<D>> law;
  std::vector<double> factor;

  AnisotropicDarcyLaw<D> at(Index i) const { return law.at(i).times(factor[i]); }

  std::array<Packet, D> stress(PointPacket points, const std::array<Packet, D>& gradient) const {
    std::array<Packet, D> result = law.stress(points, gradient);
    for (Packet& component : result) component *= value_at(factor.data(), points);
    return result;
  }
};

}  // namespace perifrac
