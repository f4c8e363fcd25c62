#include "core/body/read_point.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

struct Nearest {
  Index point;
  double distance;  ///< [m]
  bool is_inside;
};

template <int D>
Nearest find_nearest(const std::vector<double>& place, const Body<D>& body) {
  Vector<D> x;
  std::ranges::copy(place, x.begin());
  const Index point = body.nearest_point(x);
  const double distance = norm(body.points().at(point) - x);
  // A corner of the body is half a spacing along every axis from its point, or, where points are
  // no lattice, about one.
  const double cell = (body.irregular() ? 1.0 : 0.5) * std::sqrt(double{D}) * body.spacing();
  return {point, distance, distance <= cell * (1.0 + 1e-9)};
}

}  // namespace

template <int D>
bool is_inside(const Section& section, const std::string& path, const Body<D>& body) {
  return find_nearest(section.numbers(path), body).is_inside;
}

template <int D>
Index read_point(const Section& section, const std::string& path, const Body<D>& body) {
  const Nearest nearest = find_nearest(section.numbers(path), body);
  if (!nearest.is_inside) {
    section.fail(path,
                 fmt::format("lies {:.3g} m from the nearest point of the body", nearest.distance),
                 "a place inside the body");
  }
  return nearest.point;
}

template bool is_inside<2>(const Section&, const std::string&, const Body<2>&);
template bool is_inside<3>(const Section&, const std::string&, const Body<3>&);
template Index read_point<2>(const Section&, const std::string&, const Body<2>&);
template Index read_point<3>(const Section&, const std::string&, const Body<3>&);

}  // namespace perifrac
