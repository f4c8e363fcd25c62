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
[[gnu::noinline]] void set_inverse(const std::array<double, D * D>& sum, Index i,
                                   FamilyMoments<D>& moments) {
  using Matrix = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  const Matrix inverse = Eigen::Map<const Matrix>(sum.data()).inverse();
  for (int k = 0; k < D * D; ++k) moments.inverse_shape[k][i] = inverse(k / D, k % D);
}

}  // namespace

template <int D>
[[gnu::noinline]] std::array<double, D * D> shape_tensor_at(const Family<D>& family, Index i) {
  return sum_over_bonds<D * D>(family, i, [](Index, const Vector<D>& xi, double w) {
    std::array<double, D * D> product;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b) product[a * D + b] = w * xi[a] * xi[b];
    }
    return product;
  });
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
    moments.weighted_volume[i] = shape.trace();
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
  using Matrix = Eigen::Matrix<double, D, D, Eigen::RowMajor>;
  const bool thin = is_thin(family, i);
  const auto sum = shape_tensor_at(family, i);
  const Eigen::Matrix<double, D, D> shape = Eigen::Map<const Matrix>(sum.data());
  if (thin) {
    for (auto& entry : moments.inverse_shape) entry[i] = 0.0;
  } else {
    set_inverse<D>(sum, i, moments);
  }
  const double m = shape.trace();
  moments.weighted_volume[i] = m > 0.0 ? m : std::numeric_limits<double>::infinity();
  return thin;
}

template struct FamilyMoments<2>;
template struct FamilyMoments<3>;
template std::array<double, 4> shape_tensor_at<2>(const Family<2>&, Index);
template std::array<double, 9> shape_tensor_at<3>(const Family<3>&, Index);
template FamilyMoments<2> family_moments<2>(const Family<2>&);
template FamilyMoments<3> family_moments<3>(const Family<3>&);
template bool set_moments<2>(const Family<2>&, Index, FamilyMoments<2>&);
template bool set_moments<3>(const Family<3>&, Index, FamilyMoments<3>&);
template bool is_thin<2>(const Family<2>&, Index);
template bool is_thin<3>(const Family<3>&, Index);

}  // namespace perifrac
