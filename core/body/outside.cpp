#include "core/body/outside.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

/// Of a spacing: a crack that begins on a face may be written with few digits.
constexpr double tolerance = 1e-2;

}  // namespace

template <int D>
int face_before(const Body<D>& body, const Vector<D>& x) {
  const double slack = tolerance * body.spacing();
  for (std::size_t f = 0; f < body.faces().size(); ++f) {
    const auto& [name, axis, direction, coordinate] = body.faces()[f];
    if (axis < 0) {
      double square = 0.0;
      for (const double c : x) square += c * c;
      if (std::sqrt(square) > coordinate + slack) return static_cast<int>(f);
      continue;
    }
    double reach = direction * coordinate;
    for (const Index i : body.layer(static_cast<int>(f))) {
      reach = std::max(reach, direction * body.points().position[axis][i] + 0.5 * body.spacing());
    }
    if (direction * x[axis] > reach + slack) return static_cast<int>(f);
  }
  return -1;
}

template int face_before<2>(const Body<2>&, const Vector<2>&);
template int face_before<3>(const Body<3>&, const Vector<3>&);

}  // namespace perifrac
