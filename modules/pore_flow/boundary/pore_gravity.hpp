#pragma once

#include <Eigen/Core>

#include "core/body/body.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// What pore fluid gains by its height, -rho_0 g.x [Pa], zero at the highest corner of the body.
/// Pressure plus it drives the flow.
template <int D>
class PoreGravity {
 public:
  /// `gravity`: acceleration [m/s^2]; `density` of the fluid at zero pressure [kg/m^3].
  PoreGravity(const Body<D>& body, const Vector<D>& gravity, double density);

  double at(const Vector<D>& x) const;
  /// At the highest place of a face, where its pressure is prescribed.
  double at_face(int face) const;
  /// A uniform pressure on the face is at rest.
  bool crosses(int face) const;

  /// Of points, then of the mirror's face values, then of the faces in `layers`.
  Eigen::VectorXd values(const MirrorCondition<D, 1>& mirror, FaceSet layers = 0) const;

 private:
  const Body<D>* body_;
  Vector<D> weight_;  ///< rho_0 g [N/m^3]
  Vector<D> top_;     ///< highest corner [m]
};

/// The gravity of a scene, zero where it names none.
template <int D>
Vector<D> read_gravity(const Section& section);

}  // namespace perifrac
