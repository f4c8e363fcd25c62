#include "modules/pore_flow/boundary/pore_gravity.hpp"

#include <algorithm>
#include <bit>

#include "core/base/small_vector.hpp"
#include "core/body/highest_corner.hpp"

namespace perifrac {

template <int D>
PoreGravity<D>::PoreGravity(const Body<D>& body, const Vector<D>& gravity, double density)
    : body_(&body), weight_(density * gravity), top_(highest_corner<D>(body, gravity)) {}

template <int D>
double PoreGravity<D>::at(const Vector<D>& x) const {
  return dot(weight_, top_ - x);
}

template <int D>
double PoreGravity<D>::at_face(int face) const {
  Vector<D> x = top_;
  x[body_->faces()[face].axis] = body_->faces()[face].coordinate;
  return at(x);
}

template <int D>
bool PoreGravity<D>::crosses(int face) const {
  for (int a = 0; a < D; ++a) {
    if (a != body_->faces()[face].axis && weight_[a] != 0.0) return false;
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

template <int D>
Vector<D> read_gravity(const Section& section) {
  Vector<D> gravity{};
  if (section.scene().has("gravity")) {
    std::ranges::copy(section.scene().numbers("gravity"), gravity.begin());
  }
  return gravity;
}

template class PoreGravity<2>;
template class PoreGravity<3>;
template Vector<2> read_gravity<2>(const Section&);
template Vector<3> read_gravity<3>(const Section&);

}  // namespace perifrac
