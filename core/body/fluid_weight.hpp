#pragma once

#include "core/body/body.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The gravity of a scene [m/s^2], zero where it names none.
template <int D>
Vector<D> read_gravity(const Section& section);

/// What fluid in a body gains by its height, -rho_0 g.x [Pa], zero at the highest corner of the
/// body. Pressure plus it drives the flow.
template <int D>
class FluidWeight {
 public:
  /// `gravity`: acceleration [m/s^2]; `density` of the fluid at zero pressure [kg/m^3].
  FluidWeight(const Body<D>& body, const Vector<D>& gravity, double density);

  double at(const Vector<D>& x) const;
  const Vector<D>& per_volume() const { return per_volume_; }  ///< rho_0 g [N/m^3]
  const Vector<D>& top() const { return top_; }                ///< highest corner [m]

 private:
  Vector<D> per_volume_;
  Vector<D> top_;
};

}  // namespace perifrac
