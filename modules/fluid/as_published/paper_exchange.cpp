#include "modules/fluid/as_published/paper_exchange.hpp"

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "modules/fluid/exchange/pair_exchange.hpp"
#include "modules/fluid/points/symmetric_tensor.hpp"

namespace perifrac {

namespace {

template <int D>
SymmetricTensor<D> weighted_square(const Vector<D>& y, double weight) {
  SymmetricTensor<D> result;
  for (int a = 0; a < D; ++a) {
    for (int b = a; b < D; ++b) result[symmetric_index<D>(a, b)] = weight * y[a] * y[b];
  }
  return result;
}

template <int D>
Vector<D> times(const SymmetricTensor<D>& m, const Vector<D>& v) {
  Vector<D> result{};
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      result[a] += m[symmetric_index<D>(std::min(a, b), std::max(a, b))] * v[b];
    }
  }
  return result;
}

template <int D>
SymmetricTensor<D> tensor_at(const std::array<std::vector<double>, symmetric_size<D>>& tensor,
                             Index i) {
  SymmetricTensor<D> result;
  for (int k = 0; k < symmetric_size<D>; ++k) result[k] = tensor[k][i];
  return result;
}

template <int D>
void resize(std::array<std::vector<double>, D>& flux, Index count) {
  for (auto& values : flux) values.assign(count, 0.0);
}

/// omega (q_j - q_i).(M_i^-1 y) V_j, the term of the divergence of q at i.
template <int D>
double divergence(const std::array<std::vector<double>, D>& q_own, Index i,
                  const std::array<std::vector<double>, D>& q_other, Index j,
                  const Vector<D>& direction, double weight) {
  return weight * dot(vector_at(q_other, j) - vector_at(q_own, i), direction);
}

}  // namespace

template <int D>
PaperExchange<D>::PaperExchange(const Body<D>& body, const WallCloud<D>& cloud,
                                const Period<D>& period, double horizon,
                                const PairInfluence& influence)
    : solid_(body, cloud, {}, period, horizon) {
  for (auto& values : solid_shape_) values.resize(cloud.size());
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) {
    const auto shape = sum_over_neighbours<symmetric_size<D>, D>(
        solid_.near, w, body.points().at(cloud.owner[w]), solid_.position, influence,
        [&](Index j, const Vector<D>& y, double omega) {
          return weighted_square<D>(y, omega * solid_.volume[j]);
        });
    for (int k = 0; k < symmetric_size<D>; ++k) solid_shape_[k][w] = shape[k];
  }
}

/// Eq 25. Rigid walls have no pressure of their own to drive a flux.
template <int D>
void PaperExchange<D>::find_fluid_flux(const FluidStep<D>& step, const PoreInput& pores, double t,
                                       const NearWalls<D>& walls) {
  const FluidPoints<D>& points = step.points;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  resize<D>(fluid_flux_, points.count);
  for_each_point(points.count, [&](Index i) {
    if (near.offset[i] == near.offset[i + 1]) return;
    double mobility = 0.0, weights = 0.0;
    auto gradient = sum_over_neighbours<D, D>(near, i, points.at(i), walls.position, step.influence,
                                              [&](Index w, Vector<D> y, double omega) {
                                                const Index wall = walls.wall[w];
                                                if (step.cloud.is_rigid(wall)) return Vector<D>{};
                                                const Index j = step.cloud.owner[wall];
                                                const double weight = omega * solid_.volume[j];
                                                mobility += weight * pores.mobility[j];
                                                weights += weight;
                                                const double fall =
                                                    head<D>(step, pores, t, walls, i, w, y);
                                                return -weight * fall * y;
                                              });
    if (weights == 0.0) return;
    const auto of_fluid = sum_over_neighbours<D, D>(
        step.neighbours.fluid_of_fluid(), i, points.at(i), points.position, step.influence,
        [&](Index j, Vector<D> y, double omega) {
          double rise = points.pressure[j] - points.pressure[i];
          for (int a = 0; a < D; ++a) rise -= step.fluid.density * step.gravity[a] * y[a];
          return omega * points.volume[j] * rise * y;
        });
    gradient += of_fluid;
    const Vector<D> q = times<D>(tensor_at<D>(step.moments.inverse_shape, i), gradient);
    set_at(fluid_flux_, i, -mobility / weights * q);
  });
  for (auto& values : fluid_flux_) step.neighbours.images().copy(values, points.count);
}

/// Eqs 28 and 30.
template <int D>
void PaperExchange<D>::find_body_flux(const FluidStep<D>& step, const PoreInput& pores, double t,
                                      const NearWalls<D>& walls) {
  const FluidPoints<D>& points = step.points;
  resize<D>(body_flux_, walls.count);
  for (auto& values : body_inverse_) values.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    const Index wall = walls.wall[w];
    if (step.cloud.is_rigid(wall)) return;
    const Index j = step.cloud.owner[wall];
    const auto of_body = sum_over_neighbours<D, D>(
        solid_.near, wall, step.cloud.at(wall), solid_.position, step.influence,
        [&](Index other, Vector<D> y, double omega) {
          double rise = pores.at(solid_.source[other], t) - pores.at(j, t);
          for (int a = 0; a < D; ++a) rise -= step.fluid.density * step.gravity[a] * y[a];
          return omega * solid_.volume[other] * rise * y;
        });
    const auto of_fluid = sum_over_neighbours<D + symmetric_size<D>, D>(
        step.neighbours.fluid_of_walls(), w, walls.at(w), points.position, step.influence,
        [&](Index i, const Vector<D>& y, double omega) {
          const double weight = omega * points.volume[i];
          Vector<D> back;
          for (int a = 0; a < D; ++a) back[a] = -y[a];
          const double rise = head<D>(step, pores, t, walls, i, w, back);
          std::array<double, D + symmetric_size<D>> term;
          for (int a = 0; a < D; ++a) term[a] = weight * rise * y[a];
          std::ranges::copy(weighted_square<D>(y, weight), term.begin() + D);
          return term;
        });
    SymmetricTensor<D> shape = tensor_at<D>(solid_shape_, wall);
    for (int k = 0; k < symmetric_size<D>; ++k) shape[k] += of_fluid[D + k];
    const SymmetricTensor<D> inverted = inverse<D>(shape);
    Vector<D> gradient;
    for (int a = 0; a < D; ++a) gradient[a] = of_body[a] + of_fluid[a];
    const Vector<D> q = times<D>(inverted, gradient);
    set_at(body_flux_, w, -pores.mobility[j] * q);
    for (int k = 0; k < symmetric_size<D>; ++k) body_inverse_[k][w] = inverted[k];
  });
  for (auto& values : body_flux_) step.neighbours.wall_images().copy(values, walls.count);
}

/// Eqs 26, 27 and the second term of Eq 31.
template <int D>
void PaperExchange<D>::find(const FluidStep<D>& step, const PoreInput& pores, double t,
                            double /*length*/, NearWalls<D>& walls, std::vector<double>& rate) {
  find_fluid_flux(step, pores, t, walls);
  find_body_flux(step, pores, t, walls);
  const FluidPoints<D>& points = step.points;
  for_each_point(points.count, [&](Index i) {
    const SymmetricTensor<D> inverted = tensor_at<D>(step.moments.inverse_shape, i);
    rate[i] =
        -points.mass[i] * sum_over_neighbours<1, D>(
                              step.neighbours.walls_of_fluid(), i, points.at(i), walls.position,
                              step.influence, [&](Index w, const Vector<D>& y, double omega) {
                                const Index wall = walls.wall[w];
                                if (step.cloud.is_rigid(wall)) return std::array{0.0};
                                const double weight = omega * solid_.volume[step.cloud.owner[wall]];
                                return std::array{divergence<D>(fluid_flux_, i, body_flux_, w,
                                                                times<D>(inverted, y), weight)};
                              })[0];
  });
  for_each_point(walls.count, [&](Index w) {
    const Index wall = walls.wall[w];
    if (step.cloud.is_rigid(wall)) return;
    const SymmetricTensor<D> inverted = tensor_at<D>(body_inverse_, w);
    walls.mass_rate[w] =
        -step.fluid.density * solid_.volume[step.cloud.owner[wall]] *
        sum_over_neighbours<1, D>(
            step.neighbours.fluid_of_walls(), w, walls.at(w), points.position, step.influence,
            [&](Index i, const Vector<D>& y, double omega) {
              return std::array{divergence<D>(body_flux_, w, fluid_flux_, i, times<D>(inverted, y),
                                              omega * points.volume[i])};
            })[0];
  });
}

template class PaperExchange<2>;
template class PaperExchange<3>;

}  // namespace perifrac
