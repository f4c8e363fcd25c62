#include "modules/fluid/sph/sph_moments.hpp"

#include "core/bonds/bond_traversal.hpp"
#include "modules/fluid/points/symmetric_tensor.hpp"

namespace perifrac {

namespace {

/// What neighbours add up to, in this order: divergence, squares of bonds, bonds; and fluid alone:
/// shape tensor, density differences times bonds.
template <int D>
struct DensitySums {
  static constexpr int divergence = 0;
  static constexpr int square = 1;
  static constexpr int bonds = 2;
  static constexpr int of_walls = bonds + D;
  static constexpr int shape = of_walls;
  static constexpr int slope = shape + symmetric_size<D>;
  static constexpr int size = slope + D;
};

/// What a bond y of this weight adds to the sums over fluid and walls alike.
template <int D>
void add_density_moments(const PacketVector<D>& y, const PacketVector<D>& relative,
                         const Packet& weight, auto& sum) {
  Packet along{}, square{};
  for (int a = 0; a < D; ++a) {
    along += y[a] * relative[a];
    square += y[a] * y[a];
    sum[DensitySums<D>::bonds + a] = weight * y[a];
  }
  sum[DensitySums<D>::divergence] = weight * along;
  sum[DensitySums<D>::square] = weight * square;
}

/// `velocity(a)` along each axis, less v.
template <int D>
PacketVector<D> relative_to(const Vector<D>& v, auto&& velocity) {
  PacketVector<D> relative;
  for (int a = 0; a < D; ++a) relative[a] = velocity(a) - v[a];
  return relative;
}

/// The gradient of the density among fluid points.
template <int D>
Vector<D> slope_of(const std::array<double, DensitySums<D>::size>& sum, double bulk) {
  SymmetricTensor<D> shape;
  std::copy_n(sum.begin() + DensitySums<D>::shape, symmetric_size<D>, shape.begin());
  const auto inverted = inverse<D>(regularised<D>(shape, bulk));
  Vector<D> slope{};
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      slope[a] += inverted[symmetric_index<D>(std::min(a, b), std::max(a, b))] *
                  sum[DensitySums<D>::slope + b];
    }
  }
  return slope;
}

}  // namespace

template <int D>
void SphMoments<D>::find_sums(const FluidPoints<D>& points, const NearWalls<D>& walls,
                              const FluidNeighbours<D>& neighbours,
                              const WendlandInfluence& influence, FluidValues<D>& values,
                              FluidMoments<D>& moments) {
  const double bulk = moments.bulk_trace / D;
  for (auto& along : slope_) along.resize(points.count);
  values.set(points.position, points.velocity, points.volume, points.density);
  for_each_shared_point(points.count, [&](Index i) {
    const Vector<D> x = points.at(i), v = vector_at(points.velocity, i);
    const double density = points.density[i];
    auto sum = sum_over_values<DensitySums<D>::size, D>(
        neighbours.fluid_of_fluid(), i, x, values, influence,
        [&](const auto& other, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * other[2 * D];
          const auto relative = relative_to<D>(v, [&](int a) { return other[D + a]; });
          std::array<Packet, DensitySums<D>::size> term;
          add_density_moments<D>(y, relative, weight, term);
          const Packet difference = weight * (other[2 * D + 1] - density);
          for (int a = 0; a < D; ++a) {
            for (int b = a; b < D; ++b) {
              term[DensitySums<D>::shape + symmetric_index<D>(a, b)] = weight * y[a] * y[b];
            }
            term[DensitySums<D>::slope + a] = difference * y[a];
          }
          return term;
        });
    set_at(slope_, i, slope_of<D>(sum, bulk));
    if (neighbours.walls_of_fluid().count(i) > 0) {
      const auto wall = sum_over_neighbours<DensitySums<D>::of_walls, D>(
          neighbours.walls_of_fluid(), i, x, walls.position, influence,
          [&](const Index* w, const PacketVector<D>& y, const Packet& omega) {
            const auto relative =
                relative_to<D>(v, [&](int a) { return gather(walls.velocity[a], w); });
            std::array<Packet, DensitySums<D>::of_walls> term;
            add_density_moments<D>(y, relative, omega * gather(walls.volume, w), term);
            return term;
          });
      for (int k = 0; k < DensitySums<D>::of_walls; ++k) sum[k] += wall[k];
    }
    moments.trace[i] = std::max(sum[DensitySums<D>::square], least_shape * moments.bulk_trace);
    moments.divergence[i] = sum[DensitySums<D>::divergence] / bulk;
    for (int a = 0; a < D; ++a) {
      for (int b = a; b < D; ++b) {
        moments.inverse_shape[symmetric_index<D>(a, b)][i] = a == b ? 1.0 / bulk : 0.0;
      }
      moments.crowding[a][i] = sum[DensitySums<D>::bonds + a] / bulk;
    }
  });
  for (auto& along : slope_) ranks::gather_shares(along, points.count);
}

template <int D>
void SphMoments<D>::find_diffusion(const FluidPoints<D>& points,
                                   const FluidNeighbours<D>& neighbours,
                                   const WendlandInfluence& influence, FluidValues<D>& values,
                                   FluidMoments<D>& moments) {
  for (auto& along : slope_) neighbours.images().copy(along, points.count);
  values.set(points.position, slope_, points.volume, points.density);
  for_each_shared_point(points.count, [&](Index i) {
    const double density = points.density[i];
    const Vector<D> slope = vector_at(slope_, i);
    const auto sum = sum_over_values<1, D>(
        neighbours.fluid_of_fluid(), i, points.at(i), values, influence,
        [&](const auto& other, const PacketVector<D>& y, const Packet& omega) {
          Packet difference = other[2 * D + 1] - density;
          for (int a = 0; a < D; ++a) difference -= 0.5 * (slope[a] + other[D + a]) * y[a];
          return std::array<Packet, 1>{omega * other[2 * D] * difference};
        });
    moments.diffusion[i] = 2.0 * D / moments.bulk_trace * sum[0];
  });
}

template <int D>
void SphMoments<D>::find(const FluidPoints<D>& points, const NearWalls<D>& walls,
                         const FluidNeighbours<D>& neighbours, const WendlandInfluence& influence,
                         FluidValues<D>& values, FluidMoments<D>& moments) {
  moments.resize(points.count);
  find_sums(points, walls, neighbours, influence, values, moments);
  find_diffusion(points, neighbours, influence, values, moments);
  moments.gather();
}

template class SphMoments<2>;
template class SphMoments<3>;

}  // namespace perifrac
