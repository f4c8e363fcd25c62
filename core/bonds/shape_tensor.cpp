#include "core/bonds/shape_tensor.hpp"

#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

// Ratio of the smallest to the largest eigenvalue of a shape tensor below which its inverse
// carries no accuracy: the bonds lie in a line or a plane.
constexpr double flat_family = 1e-6;

constexpr double thin_family = 0.05;

template <int D>
[[noreturn]] void refuse_flat_family(const Family<D>& family, Index i) {
  const Vector<D> x = vector_at(family.position, i);
  throw BodyError(fmt::format("the {} bonds of the point at ({:.6g}) m do not span {}D space",
                              family.bond_count(i), fmt::join(x, ", "), D),
                  "a body at least two points thick and a horizon of about 2.5 spacings");
}

/// One routine, never inlined: what a family's moments are must not depend, in the last digit, on
/// whether they were made with all others or anew after bonds broke and mended.
template <int D>
[[gnu::noinline]] Tensor<D, D> inverse_of(const Tensor<D, D>& shape) {
  using Matrix = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  const Matrix inverse = Eigen::Map<const Matrix>(shape.data()).inverse();
  Tensor<D, D> result;
  for (int k = 0; k < D * D; ++k) result[k] = inverse(k / D, k % D);
  return result;
}

/// m_i, infinite where no bond is left.
template <int D>
double trace_of(const Tensor<D, D>& shape) {
  double trace = 0.0;
  for (int a = 0; a < D; ++a) trace += shape[a * D + a];
  return trace > 0.0 ? trace : std::numeric_limits<double>::infinity();
}

template <int D>
void set_inverse(const Tensor<D, D>& shape, Index i, FamilyMoments<D>& moments) {
  const Tensor<D, D> inverse = inverse_of<D>(shape);
  for (int k = 0; k < D * D; ++k) moments.inverse_shape[k][i] = inverse[k];
}

}  // namespace

template <int D>
[[gnu::noinline]] Tensor<D, D> shape_tensor_at(const Family<D>& family, Index i) {
  return sum_over_bonds<D * D>(family, i, [](Index, const Vector<D>& xi, double w) {
    std::array<double, D * D> product;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) product[a * D + b] = w * xi[a] * xi[b];
    }
    return product;
  });
}

template <int D>
Tensor<D, D> inverse_shape_at(const Family<D>& family, Index i) {
  return inverse_of<D>(shape_tensor_at(family, i));
}

template <int D>
double weighted_volume(const Family<D>& family, Index i) {
  return trace_of<D>(shape_tensor_at(family, i));
}

template <int D>
FamilyMoments<D> family_moments(const Family<D>& family) {
  using Matrix = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  FamilyMoments<D> moments;
  for (auto& entry : moments.inverse_shape) entry.resize(family.point_count);
  moments.weighted_volume.resize(family.point_count, std::numeric_limits<double>::infinity());
  for (Index i = 0; i < family.point_count; ++i) {
    if (family.bond_count(i) == 0) continue;
    const auto sum = shape_tensor_at(family, i);
    const Eigen::Matrix<double, D, D> shape = Eigen::Map<const Matrix>(sum.data());
    const auto values = symmetric_spectrum(shape).values;
    if (!(values[0] > flat_family * values[D - 1])) {
      refuse_flat_family(family, i);
    }
    set_inverse<D>(sum, i, moments);
    moments.weighted_volume[i] = trace_of<D>(sum);
  }
  return moments;
}

template <int D>
bool is_thin(const Family<D>& family, Index i) {
  using Matrix = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  const auto sum = shape_tensor_at(family, i);
  const Eigen::Matrix<double, D, D> shape = Eigen::Map<const Matrix>(sum.data());
  const auto values = symmetric_spectrum(shape).values;
  return !(values[0] > thin_family * values[D - 1]);
}

template <int D>
bool set_moments(const Family<D>& family, Index i, FamilyMoments<D>& moments) {
  const bool thin = is_thin(family, i);
  const Tensor<D, D> shape = shape_tensor_at(family, i);
  if (thin) {
    for (auto& entry : moments.inverse_shape) entry[i] = 0.0;
  } else {
    set_inverse<D>(shape, i, moments);
  }
  moments.weighted_volume[i] = trace_of<D>(shape);
  return thin;
}

template struct FamilyMoments<2>;
template struct FamilyMoments<3>;
template Tensor<2, 2> shape_tensor_at<2>(const Family<2>&, Index);
template Tensor<3, 3> shape_tensor_at<3>(const Family<3>&, Index);
template Tensor<2, 2> inverse_shape_at<2>(const Family<2>&, Index);
template Tensor<3, 3> inverse_shape_at<3>(const Family<3>&, Index);
template double weighted_volume<2>(const Family<2>&, Index);
template double weighted_volume<3>(const Family<3>&, Index);
template FamilyMoments<2> family_moments<2>(const Family<2>&);
template FamilyMoments<3> family_moments<3>(const Family<3>&);
template bool set_moments<2>(const Family<2>&, Index, FamilyMoments<2>&);
template bool set_moments<3>(const Family<3>&, Index, FamilyMoments<3>&);
template bool is_thin<2>(const Family<2>&, Index);
template bool is_thin<3>(const Family<3>&, Index);

}  // namespace perifrac
