#include "core/body/outside.hpp"

#include <algorithm>

namespace perifrac {

namespace {

/// Of a spacing: a crack that begins on a face may be written with few digits.
constexpr double tolerance = 1e-2;

}  // namespace

template <int D>
int face_before(const Body<D>& body, const Vector<D>& x) {
  const double slack = tolerance * body.spacing();
  for (std::size_t f = 0; f < body.faces().size(); ++f) {
    const Face& face = body.faces()[f];
    double reach = face.direction * face.coordinate;
    for (const Index i : body.layer(static_cast<int>(f))) {
      const double x_of = body.points().position[face.axis][i];
      reach = std::max(reach, face.direction * x_of + 0.5 * body.spacing());
    }
    if (face.direction * face.place(x) > reach + slack) return static_cast<int>(f);
  }
  return -1;
}

template int face_before<2>(const Body<2>&, const Vector<2>&);
template int face_before<3>(const Body<3>&, const Vector<3>&);

}  // namespace perifrac
