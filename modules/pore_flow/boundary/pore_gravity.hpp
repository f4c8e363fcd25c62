#pragma once

#include <Eigen/Core>

#include "core/body/fluid_weight.hpp"
#include "core/bonds/mirror_condition.hpp"

namespace perifrac {

/// The weight of pore fluid, on points and faces.
template <int D>
class PoreGravity {
 public:
  /// `gravity`: acceleration [m/s^2]; `density` of the fluid at zero pressure [kg/m^3].
  PoreGravity(const Body<D>& body, const Vector<D>& gravity, double density);

  double at(const Vector<D>& x) const { return weight_.at(x); }
  /// At the highest place of a face, where its pressure is prescribed.
  double at_face(int face) const;
  /// A uniform pressure on the face is at rest.
  bool crosses(int face) const;

  /// Of points, then of the mirror's face values, then of the faces in `layers`.
  Eigen::VectorXd values(const MirrorCondition<D, 1>& mirror, FaceSet layers = 0) const;

 private:
  const Body<D>* body_;
  FluidWeight<D> weight_;
};

}  // namespace perifrac
