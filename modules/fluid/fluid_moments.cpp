#include "modules/fluid/fluid_moments.hpp"

#include "core/operators/bond_traversal.hpp"
#include "modules/fluid/symmetric_tensor.hpp"

namespace perifrac {

namespace {

/// Where fluid points lie on one side only, or are few, the shape tensor is lifted to this part of
/// that of an endless lattice in its weakest direction.
constexpr double least_shape = 0.4;

template <int D>
SymmetricTensor<D> regularised(SymmetricTensor<D> shape, double bulk) {
  if (least_eigenvalue_bound<D>(shape) >= least_shape * bulk) return shape;
  const double missing = least_shape * bulk - least_eigenvalue<D>(shape);
  if (missing <= 0.0) return shape;
  for (int a = 0; a < D; ++a) shape[symmetric_index<D>(a, a)] += missing;
  return shape;
}

}  // namespace

template <int D>
double lattice_trace(double spacing, double horizon) {
  const GaussianInfluence influence(horizon);
  const int reach = static_cast<int>(horizon / spacing) + 1;
  double sum = 0.0;
  std::array<int, 3> k{};
  const int depth = D == 3 ? reach : 0;
  for (k[0] = -reach; k[0] <= reach; ++k[0]) {
    for (k[1] = -reach; k[1] <= reach; ++k[1]) {
      for (k[2] = -depth; k[2] <= depth; ++k[2]) {
        const double square = (k[0] * k[0] + k[1] * k[1] + k[2] * k[2]) * spacing * spacing;
        sum += influence(square) * square;
      }
    }
  }
  return sum * std::pow(spacing, D);
}

template <int D>
void find_moments(const FluidPoints<D>& points, const NearWalls<D>& walls,
                  const FluidNeighbours<D>& neighbours, const FluidProperties& fluid,
                  const GaussianInfluence& influence, const Vector<D>& gravity,
                  FluidMoments<D>& moments) {
  constexpr int shape_size = symmetric_size<D>;
  constexpr int size = shape_size + D * D;
  const double bulk = moments.bulk_trace / D;
  const double at_rest = fluid.density * fluid.density / fluid.bulk_modulus;
  for (auto& values : moments.inverse_shape) values.resize(points.count);
  moments.trace.resize(points.count);
  moments.divergence.resize(points.count);
  moments.diffusion.resize(points.count);

  // What all neighbours add: to the shape tensor, and to the velocity gradient before it is shaped.
  const auto moments_of = [](const PacketVector<D>& y, const PacketVector<D>& relative,
                             const Packet& weight, Packet* sum) {
    for (int a = 0; a < D; ++a) {
      const Packet weighted = weight * y[a];
      for (int b = a; b < D; ++b) sum[symmetric_index<D>(a, b)] = weighted * y[b];
      for (int b = 0; b < D; ++b) sum[shape_size + b * D + a] = weighted * relative[b];
    }
  };

  for_each_point(points.count, [&](Index i) {
    const Vector<D> x = points.at(i);
    Vector<D> v;
    for (int a = 0; a < D; ++a) v[a] = points.velocity[a][i];
    const double density = points.density[i];
    auto sum = sum_over_neighbours<size + 1, D>(
        neighbours.fluid_of_fluid(), i, x, points.position, influence,
        [&](const Index* j, const PacketVector<D>& y, const Packet& omega) {
          const Packet weight = omega * gather(points.volume, j);
          PacketVector<D> relative;
          Packet excess = gather(points.density, j) - density;
          for (int a = 0; a < D; ++a) {
            relative[a] = gather(points.velocity[a], j) - v[a];
            excess -= at_rest * gravity[a] * y[a];
          }
          std::array<Packet, size + 1> term;
          moments_of(y, relative, weight, term.data());
          term[size] = weight * excess;
          return term;
        });
    if (neighbours.walls_of_fluid().count(i) > 0) {
      const auto wall = sum_over_neighbours<size, D>(
          neighbours.walls_of_fluid(), i, x, walls.position, influence,
          [&](const Index* w, const PacketVector<D>& y, const Packet& omega) {
            PacketVector<D> relative;
            for (int a = 0; a < D; ++a) relative[a] = gather(walls.velocity[a], w) - v[a];
            std::array<Packet, size> term;
            moments_of(y, relative, omega * gather(walls.volume, w), term.data());
            return term;
          });
      for (int k = 0; k < size; ++k) sum[k] += wall[k];
    }
    SymmetricTensor<D> shape;
    std::copy_n(sum.begin(), shape_size, shape.begin());
    moments.trace[i] = trace<D>(shape);
    const SymmetricTensor<D> inverted = inverse<D>(regularised<D>(shape, bulk));
    double divergence = 0.0;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) {
        divergence += sum[shape_size + a * D + b] *
                      inverted[symmetric_index<D>(std::min(a, b), std::max(a, b))];
      }
    }
    for (int k = 0; k < shape_size; ++k) moments.inverse_shape[k][i] = inverted[k];
    moments.divergence[i] = divergence;
    moments.diffusion[i] = 2.0 * D / moments.bulk_trace * sum[size];
  });
}

template double lattice_trace<2>(double, double);
template double lattice_trace<3>(double, double);
template void find_moments<2>(const FluidPoints<2>&, const NearWalls<2>&, const FluidNeighbours<2>&,
                              const FluidProperties&, const GaussianInfluence&, const Vector<2>&,
                              FluidMoments<2>&);
template void find_moments<3>(const FluidPoints<3>&, const NearWalls<3>&, const FluidNeighbours<3>&,
                              const FluidProperties&, const GaussianInfluence&, const Vector<3>&,
                              FluidMoments<3>&);

}  // namespace perifrac
