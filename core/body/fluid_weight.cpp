#include "core/body/fluid_weight.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/body/highest_corner.hpp"

namespace perifrac {

template <int D>
Vector<D> read_gravity(const Section& section) {
  Vector<D> gravity{};
  if (section.scene().has("gravity")) {
    std::ranges::copy(section.scene().numbers("gravity"), gravity.begin());
  }
  return gravity;
}

template <int D>
FluidWeight<D>::FluidWeight(const Body<D>& body, const Vector<D>& gravity, double density)
    : per_volume_(density * gravity), top_(highest_corner<D>(body, gravity)) {}

template <int D>
double FluidWeight<D>::at(const Vector<D>& x) const {
  return dot(per_volume_, top_ - x);
}

template class FluidWeight<2>;
template class FluidWeight<3>;
template Vector<2> read_gravity<2>(const Section&);
template Vector<3> read_gravity<3>(const Section&);

}  // namespace perifrac
