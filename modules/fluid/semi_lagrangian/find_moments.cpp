#include "modules/fluid/semi_lagrangian/find_moments.hpp"

#include "core/bonds/bond_traversal.hpp"
#include "modules/fluid/points/symmetric_tensor.hpp"

namespace perifrac {

namespace {

/// What neighbours add up to, in this order: shape tensor, bonds times velocity differences, bonds;
/// and fluid alone: density differences, the same times bonds.
template <int D>
struct Sums {
  static constexpr int velocity = symmetric_size<D>;
  static constexpr int bonds = velocity + D * D;
  static constexpr int of_walls = bonds + D;
  static constexpr int difference = of_walls;
  static constexpr int slope = difference + 1;
  static constexpr int size = slope + D;
  using Values = std::array<double, size>;

  static SymmetricTensor<D> shape(const Values& sum) {
    SymmetricTensor<D> shape;
    std::copy_n(sum.begin(), symmetric_size<D>, shape.begin());
    return shape;
  }
};

/// The density's differences beyond its slope, so that a surface does not make it diffuse.
template <int D>
double difference_beyond_slope(const typename Sums<D>::Values& sum,
                               const SymmetricTensor<D>& inverse_shape) {
  double result = sum[Sums<D>::difference];
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      result -= sum[Sums<D>::bonds + a] * sum[Sums<D>::slope + b] *
                inverse_shape[symmetric_index<D>(std::min(a, b), std::max(a, b))];
    }
  }
  return result;
}

/// What a bond y of this weight adds to the sums over fluid and walls alike.
template <int D>
void add_moments(const PacketVector<D>& y, const PacketVector<D>& relative, const Packet& weight,
                 auto& sum) {
  for (int a = 0; a < D; ++a) {
    const Packet bond = weight * y[a];
    for (int b = a; b < D; ++b) sum[symmetric_index<D>(a, b)] = bond * y[b];
    for (int b = 0; b < D; ++b) sum[Sums<D>::velocity + a * D + b] = bond * relative[b];
    sum[Sums<D>::bonds + a] = bond;
  }
}

template <int D>
double divergence(const auto& sum, const SymmetricTensor<D>& inverse_shape) {
  double result = 0.0;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      result += sum[Sums<D>::velocity + a * D + b] *
                inverse_shape[symmetric_index<D>(std::min(a, b), std::max(a, b))];
    }
  }
  return result;
}

}  // namespace

template <int D>
void find_moments(const FluidPoints<D>& points, const NearWalls<D>& walls,
                  const FluidNeighbours<D>& neighbours, const GaussianInfluence& influence,
                  FluidValues<D>& values, FluidMoments<D>& moments) {
  const double bulk = moments.bulk_trace / D;
  values.set(points.position, points.velocity, points.volume, points.density);
  moments.resize(points.count);
  for_each_shared_point(points.count, [&](Index i) {
    const Vector<D> x = points.at(i);
    Vector<D> v;
    for (int a = 0; a < D; ++a) v[a] = points.velocity[a][i];
    const double density = points.density[i];
    auto sum = sum_over_values<Sums<D>::size, D>(
        neighbours.fluid_of_fluid(), i, x, values, influence,
        [&](const auto& other, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * other[2 * D];
          PacketVector<D> relative;
          for (int a = 0; a < D; ++a) relative[a] = other[D + a] - v[a];
          std::array<Packet, Sums<D>::size> term;
          add_moments<D>(y, relative, weight, term);
          const Packet difference = weight * (other[2 * D + 1] - density);
          term[Sums<D>::difference] = difference;
          for (int a = 0; a < D; ++a) term[Sums<D>::slope + a] = difference * y[a];
          return term;
        });
    const auto fluid_inverse = inverse<D>(regularised<D>(Sums<D>::shape(sum), bulk));
    moments.diffusion[i] =
        2.0 * D / moments.bulk_trace * difference_beyond_slope<D>(sum, fluid_inverse);
    auto inverted = fluid_inverse;
    if (neighbours.walls_of_fluid().count(i) > 0) {
      const auto wall = sum_over_neighbours<Sums<D>::of_walls, D>(
          neighbours.walls_of_fluid(), i, x, walls.position, influence,
          [&](const Index* w, const PacketVector<D>& y, const Packet& omega) {
            PacketVector<D> relative;
            for (int a = 0; a < D; ++a) relative[a] = gather(walls.velocity[a], w) - v[a];
            std::array<Packet, Sums<D>::of_walls> term;
            add_moments<D>(y, relative, omega * gather(walls.volume, w), term);
            return term;
          });
      for (int k = 0; k < Sums<D>::of_walls; ++k) sum[k] += wall[k];
      inverted = inverse<D>(regularised<D>(Sums<D>::shape(sum), bulk));
    }
    moments.trace[i] = std::max(trace<D>(Sums<D>::shape(sum)), least_shape * moments.bulk_trace);
    moments.divergence[i] = divergence<D>(sum, inverted);
    for (int k = 0; k < symmetric_size<D>; ++k) moments.inverse_shape[k][i] = inverted[k];
    for (int a = 0; a < D; ++a) moments.crowding[a][i] = sum[Sums<D>::bonds + a] / bulk;
  });
  moments.gather();
}

template void find_moments<2>(const FluidPoints<2>&, const NearWalls<2>&, const FluidNeighbours<2>&,
                              const GaussianInfluence&, FluidValues<2>&, FluidMoments<2>&);
template void find_moments<3>(const FluidPoints<3>&, const NearWalls<3>&, const FluidNeighbours<3>&,
                              const GaussianInfluence&, FluidValues<3>&, FluidMoments<3>&);

}  // namespace perifrac
