#pragma once

#include <Eigen/Core>

#include "core/body/body.hpp"
#include "core/operators/nonlocal_gradient.hpp"

namespace perifrac {

/// The point load that a uniform unit traction in direction `component` (or a unit inflow, for a
/// scalar field) on a face does: the transpose of the nonlocal normal gradient, restricted to the
/// points near the face. In a body with that stress it balances the inner forces exactly, surfaces
/// and corners included, and its sum is the face's area.
///
/// `force_of` is the operator's force_of_stress(), `mirrored` and `without_layers` what its family
/// was asked for; the result has one value a point [m^(D-1)]. Beside a layer with bonds the load
/// goes on along the layer, which is under the same stress, and the sum is greater by its side.
/// Throws BodyError where the body is too thin to tell the face from the opposite one.
template <int D, int R>
Eigen::VectorXd face_load(const Body<D>& body, const ForceOfStress& force_of, FaceSet mirrored,
                          int face, int component, FaceSet without_layers = 0);

/// The same for the walls of all cut-outs that are boxes and normal to `axis`: the point load, in
/// direction `axis`, of a unit traction along their normals out of the body. A body under uniform
/// stress that holds at its faces and not in its cut-outs bears this times the stress, with the
/// sign turned. Throws BodyError where such a wall is too near to a face to tell them apart.
template <int D>
Eigen::VectorXd cutout_load(const Body<D>& body, const ForceOfStress& force_of, int axis);

/// The point loads, D blocks, of the tractions that a uniform stress along the axes [Pa] has on a
/// curved face, of a ball or a hole: in a body under that stress they balance the inner forces
/// exactly, and their sum over a whole one is zero. `mirrored` is what the family was asked for.
/// Throws BodyError where a plane face that is not among them is too near.
template <int D>
Eigen::VectorXd curved_load(const Body<D>& body, const ForceOfStress& force_of, FaceSet mirrored,
                            const Face& curved, const Vector<D>& stress);

}  // namespace perifrac
