#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/base/points.hpp"
#include "modules/solid/fracture/fluid_in_cracks.hpp"

namespace perifrac {

/// Mass times acceleration of a point [N], in 2D per metre; empty: the body is at rest.
template <int D>
using PointInertia = std::function<Vector<D>(Index)>;

/// Says which displacements are asked for; not called where all are known.
using UnknownNames = std::function<std::vector<Index>()>;

/// What tips need to know of the body at the end of a window.
template <int D>
struct CrackState {
  double t;                         ///< [s]
  const Eigen::VectorXd& opening;   ///< of every facet [m]
  const Eigen::VectorXd& pressure;  ///< on the faces, that of contact included [Pa]
  /// Of the fluid at every facet, 0 where it is dry [Pa s]; empty where no fluid is simulated.
  std::span<const double> viscosity;
  /// Carter's coefficient of one side, likewise [m/s^0.5]; empty where nothing leaks by it.
  std::span<const double> leak_off;
  /// What pressure fluid at rest has at every facet by its weight, up to a constant [Pa]; empty
  /// where it has none.
  std::span<const double> fluid_weight{};
  /// Of all points [Pa]; empty where no pore flow is simulated.
  std::span<const double> pore_stress;
  /// All displacements, of which those named count: they are found when they are asked for.
  std::function<std::span<const double>(const UnknownNames& named)> unknowns;
  /// Mean jumps across all facets along their normal and tangents [m], when they are asked for.
  std::function<std::vector<Vector<D>>()> jumps;
  PointInertia<D> inertia{};
  std::span<const double> shear{};  ///< of friction on every facet [Pa]; empty: there is none
  std::span<const double> slip{};   ///< likewise [m]
  double pause = 0.0;               ///< a tip stays where it came to for at least so long [s]

  bool has_fluid() const { return !viscosity.empty(); }
};

/// The same of a body whose fluid in cracks is `fluid`; nothing has a default, so that no solid
/// forgets what another tells.
template <int D>
CrackState<D> crack_state(
    double t, const FluidInCracks& fluid, const Eigen::VectorXd& opening,
    const Eigen::VectorXd& pressure, std::span<const double> shear, std::span<const double> slip,
    std::span<const double> pore_stress,
    std::function<std::span<const double>(const UnknownNames& named)> unknowns,
    std::function<std::vector<Vector<D>>()> jumps, PointInertia<D> inertia, double pause) {
  return {t,
          opening,
          pressure,
          fluid.viscosity(),
          fluid.leak_off(),
          fluid.weight(),
          pore_stress,
          std::move(unknowns),
          std::move(jumps),
          std::move(inertia),
          shear,
          slip,
          pause};
}

/// A tip is ready from here on: it goes on within this of its criterion.
inline constexpr double ready = 0.995;

}  // namespace perifrac
