#include "core/body/highest_corner.hpp"

#include <algorithm>

namespace perifrac {

template <int D>
Vector<D> highest_corner(const Body<D>& body, const Vector<D>& gravity) {
  Vector<D> corner;
  for (int a = 0; a < D; ++a) {
    const auto [low, high] = std::ranges::minmax(body.points().position[a]);
    corner[a] = gravity[a] > 0.0 ? low : high;
  }
  for (const Face& face : body.faces()) {
    if (face.curved()) continue;
    if ((face.direction < 0) == (gravity[face.axis] > 0.0)) corner[face.axis] = face.coordinate;
  }
  return corner;
}

template Vector<2> highest_corner<2>(const Body<2>&, const Vector<2>&);
template Vector<3> highest_corner<3>(const Body<3>&, const Vector<3>&);

}  // namespace perifrac
