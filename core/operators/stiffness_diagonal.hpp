#pragma once

#include <vector>

#include "core/base/for_each_point.hpp"
#include "core/base/law_by_region.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/shape_tensor.hpp"

namespace perifrac {

/// The diagonal of the stiffness of LinearExactOperator, R blocks of points: that of an intact
/// body, exact but for bonds to ghosts, whose half is taken from their real end. For scaling, not
/// for sums: `law` at(i), as there.
template <int D, class LawAt>
std::vector<double> stiffness_diagonal(const Family<D>& family, LawAt&& law_of) {
  using Law = std::decay_t<decltype(law_of(Index{}))>;
  constexpr int R = Law::components;
  const FamilyMoments<D> moments = family_moments(family);
  const Index points = family.point_count;
  const auto inverse_shape_times = [&](Index i, const Vector<D>& xi) {
    Vector<D> q{};
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) q[a] += moments.inverse_shape[a * D + b][i] * xi[b];
    }
    return q;
  };
  // e_r (x) q : C : e_r (x) q
  const auto along = [&](const Law& law, int r, const Vector<D>& q) {
    Tensor<R, D> gradient{};
    for (int b = 0; b < D; ++b) gradient[r * D + b] = q[b];
    const Tensor<R, D> stress = law.stress(gradient);
    double sum = 0.0;
    for (int b = 0; b < D; ++b) sum += q[b] * stress[r * D + b];
    return sum;
  };
  std::vector<double> diagonal(static_cast<std::size_t>(R) * points, 0.0);
  for_each_point(points, [&](Index i) {
    const Law& own_law = law_of(i);
    const double own_stiffness = own_law.stabilisation() / moments.weighted_volume[i];
    const auto pull =
        sum_over_bonds<D>(family, i, [](Index, const Vector<D>& xi, double w) { return w * xi; });
    const auto sum = sum_over_bonds<R + 1>(family, i, [&](Index j, const Vector<D>& xi, double w) {
      const Index real = j < points ? j : i;
      const Law& law = law_of(real);
      const double s = law.stabilisation() / moments.weighted_volume[real];
      // What point j's energy says of point i: its bond back weighs w V_i / V_j, its sum has V_j.
      const double back = w * family.volume[i] / family.volume[real];
      const Vector<D> q = inverse_shape_times(real, xi);
      double square = 0.0;
      for (int a = 0; a < D; ++a) square += q[a] * xi[a];
      std::array<double, R + 1> t;
      for (int r = 0; r < R; ++r) {
        t[r] = family.volume[real] * (back * back * (along(law, r, q) - s * square) + s * back);
      }
      t[R] = w;
      return t;
    });
    const Vector<D> q = inverse_shape_times(i, pull);
    double square = 0.0;
    for (int a = 0; a < D; ++a) square += q[a] * pull[a];
    for (int r = 0; r < R; ++r) {
      diagonal[static_cast<std::size_t>(r) * points + i] =
          sum[r] + family.volume[i] * (along(own_law, r, q) + own_stiffness * (sum[R] - square));
    }
  });
  return diagonal;
}

}  // namespace perifrac
