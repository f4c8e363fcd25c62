#include "app/warnings/mean_dissipation.hpp"

#include "app/warnings/least_squares_gradient.hpp"

namespace perifrac {

template <int D>
double mean_dissipation(const Positions<D>& places, std::span<const double> velocity,
                        double reach) {
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
  double sum = 0.0;
  for (Index i = 0; i < count; ++i) {
    LeastSquaresGradient<D> gradient;
    for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
      const Index j = near.other[k];
      gradient.add(place_at(j) - place_at(i), velocity_at(j) - velocity_at(i));
    }
    const auto rate = gradient.matrix();
    sum += 0.5 * (rate + rate.transpose()).squaredNorm();
  }
  return sum / count;
}

template double mean_dissipation<2>(const Positions<2>&, std::span<const double>, double);
template double mean_dissipation<3>(const Positions<3>&, std::span<const double>, double);

}  // namespace perifrac
