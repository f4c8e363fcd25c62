#include "app/warnings/viscous_fall.hpp"

#include <cmath>

#include "app/warnings/least_squares_gradient.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

template <int D>
double viscous_fall(const Positions<D>& places, std::span<const double> velocity, double reach) {
  using Column = typename LeastSquaresGradient<D>::Column;
  const auto count = static_cast<Index>(places[0].size());
  CellGrid<D> grid;
  grid.build(places, reach);
  Neighbours near;
  grid.find_others(count, reach, near);
  const auto place_at = [&](Index i) -> Column {
    return Column::NullaryExpr([&](Eigen::Index a) { return places[a][i]; });
  };
  const auto velocity_at = [&](Index i) -> Column {
    return Column::NullaryExpr([&](Eigen::Index a) { return velocity[a * count + i]; });
  };
  double squares = 0.0, speeds = 0.0;
  for (Index i = 0; i < count; ++i) {
    LeastSquaresGradient<D> gradient;
    for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
      const Index j = near.other[k];
      gradient.add(place_at(j) - place_at(i), velocity_at(j) - velocity_at(i));
    }
    const auto rate = gradient.matrix();
    squares += 0.5 * (rate + rate.transpose()).squaredNorm();
    speeds += velocity_at(i).norm();
  }
  return speeds > 0.0 ? squares / speeds : 0.0;
}

template double viscous_fall<2>(const Positions<2>&, std::span<const double>, double);
template double viscous_fall<3>(const Positions<3>&, std::span<const double>, double);

}  // namespace perifrac
