#include "modules/pore_flow/boundary/pore_gravity.hpp"

#include <bit>

namespace perifrac {

template <int D>
PoreGravity<D>::PoreGravity(const Body<D>& body, const Vector<D>& gravity, double density)
    : body_(&body), weight_(body, gravity, density) {}

template <int D>
double PoreGravity<D>::at_face(int face) const {
  Vector<D> x = weight_.top();
  const Face& plane = body_->faces()[face];  // of a curved one only where nothing has weight
  if (!plane.curved()) x[plane.axis] = plane.coordinate;
  return at(x);
}

template <int D>
bool PoreGravity<D>::crosses(int face) const {
  for (int a = 0; a < D; ++a) {
    if (a != body_->faces()[face].axis && weight_.per_volume()[a] != 0.0) return false;
  }
  return true;
}

template <int D>
Eigen::VectorXd PoreGravity<D>::values(const MirrorCondition<D, 1>& mirror, FaceSet layers) const {
  const Points<D>& points = body_->points();
  int layer_value = mirror.face_value_count();
  Eigen::VectorXd result(points.size() + layer_value + std::popcount(layers));
  for (Index i = 0; i < points.size(); ++i) result[i] = at(points.at(i));
  for (int f = 0; f < std::ssize(body_->faces()); ++f) {
    const int value = contains(layers, f) ? layer_value++ : mirror.face_value(f, 0);
    if (value >= 0) result[points.size() + value] = at_face(f);
  }
  return result;
}

template class PoreGravity<2>;
template class PoreGravity<3>;

}  // namespace perifrac
