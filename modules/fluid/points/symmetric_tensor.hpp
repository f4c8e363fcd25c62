#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/fluid/points/fluid_points.hpp"

namespace perifrac {

template <int D>
using SymmetricTensor = std::array<double, symmetric_size<D>>;

template <int D>
inline double trace(const SymmetricTensor<D>& m) {
  double sum = 0.0;
  for (int a = 0; a < D; ++a) sum += m[symmetric_index<D>(a, a)];
  return sum;
}

template <int D>
inline SymmetricTensor<D> inverse(const SymmetricTensor<D>& m) {
  if constexpr (D == 2) {
    const double scale = 1.0 / (m[0] * m[2] - m[1] * m[1]);
    return {m[2] * scale, -m[1] * scale, m[0] * scale};
  } else {
    const double xx = m[3] * m[5] - m[4] * m[4];
    const double xy = m[2] * m[4] - m[1] * m[5];
    const double xz = m[1] * m[4] - m[2] * m[3];
    const double scale = 1.0 / (m[0] * xx + m[1] * xy + m[2] * xz);
    return {xx * scale,
            xy * scale,
            xz * scale,
            (m[0] * m[5] - m[2] * m[2]) * scale,
            (m[1] * m[2] - m[0] * m[4]) * scale,
            (m[0] * m[3] - m[1] * m[1]) * scale};
  }
}

/// The smallest eigenvalue, in closed form.
template <int D>
inline double least_eigenvalue(const SymmetricTensor<D>& m) {
  if constexpr (D == 2) {
    const double middle = 0.5 * (m[0] + m[2]);
    return middle - std::hypot(0.5 * (m[0] - m[2]), m[1]);
  } else {
    const double middle = (m[0] + m[3] + m[5]) / 3.0;
    const double off = m[1] * m[1] + m[2] * m[2] + m[4] * m[4];
    const double xx = m[0] - middle, yy = m[3] - middle, zz = m[5] - middle;
    const double size = std::sqrt((xx * xx + yy * yy + zz * zz + 2.0 * off) / 6.0);
    if (size == 0.0) return middle;
    const double determinant = xx * (yy * zz - m[4] * m[4]) - m[1] * (m[1] * zz - m[4] * m[2]) +
                               m[2] * (m[1] * m[4] - yy * m[2]);
    const double cosine = std::clamp(0.5 * determinant / (size * size * size), -1.0, 1.0);
    constexpr double third_of_a_turn = 2.0943951023931953;
    return middle + 2.0 * size * std::cos(std::acos(cosine) / 3.0 + third_of_a_turn);
  }
}

/// A lower bound of the smallest eigenvalue (Gershgorin), cheap: most points need no more.
template <int D>
inline double least_eigenvalue_bound(const SymmetricTensor<D>& m) {
  if constexpr (D == 2) {
    return std::min(m[0], m[2]) - std::abs(m[1]);
  } else {
    const double xy = std::abs(m[1]), xz = std::abs(m[2]), yz = std::abs(m[4]);
    return std::min({m[0] - xy - xz, m[3] - xy - yz, m[5] - xz - yz});
  }
}

/// Where fluid points lie on one side only, or are few, the shape tensor is lifted to this part of
/// that of an endless lattice in its weakest direction, and its trace to this part.
inline constexpr double least_shape = 0.4;

/// The shape tensor, so lifted; `bulk` is the lattice's in every direction.
template <int D>
inline SymmetricTensor<D> regularised(SymmetricTensor<D> shape, double bulk) {
  if (least_eigenvalue_bound<D>(shape) >= least_shape * bulk) return shape;
  const double missing = least_shape * bulk - least_eigenvalue<D>(shape);
  if (missing <= 0.0) return shape;
  for (int a = 0; a < D; ++a) shape[symmetric_index<D>(a, a)] += missing;
  return shape;
}

}  // namespace perifrac
