#include "modules/solid/fracture/opening_kernel.hpp"

#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

/// How much stiffer a lattice is than an even opening where one facet opens and the next does not,
/// of E' over the facet's side: so that a facet opens by its own pressure about as far as one does
/// there.
template <int D>
constexpr double short_wave = D == 2 ? 0.1 : 0.5;

/// A facet that opens evenly: its middle, its normal and sides, and half of their lengths.
template <int D>
struct Source {
  Vector<D> middle;
  std::array<Vector<D>, D> axes;
  std::array<double, D - 1> half;
};

template <int D>
Source<D> source(const CrackFacet<D>& facet) {
  Source<D> result{middle<D>(facet), frame<D>(facet), {}};
  result.half[0] = 0.5 * norm(facet[1] - facet[0]);
  if constexpr (D == 3) {
    result.half[1] = 0.5 * norm(facet[3] - facet[0]);
    // The frame's tangents need not run along both sides of a facet that is no rectangle.
    result.axes[1] = (facet[1] - facet[0]) / (2.0 * result.half[0]);
    result.axes[2] = (facet[3] - facet[0]) / (2.0 * result.half[1]);
  }
  return result;
}

template <int D>
Source<D> image(Source<D> of, const SymmetryPlane& plane) {
  of.middle[plane.axis] = 2.0 * plane.coordinate - of.middle[plane.axis];
  for (Vector<D>& axis : of.axes) axis[plane.axis] = -axis[plane.axis];
  return of;
}

/// The pressure at a place on a plane of this normal that an opening of 1 there goes with, over
/// E' / (4 pi) [1/m].
double pressure(const Source<2>& from, const Vector<2>& at, const Vector<2>& normal) {
  const Vector<2> off = at - from.middle;
  const double x = dot(off, from.axes[1]), y = dot(off, from.axes[0]), a = from.half[0];
  const double left = x + a, right = x - a;
  const double l2 = left * left + y * y, r2 = right * right + y * y;
  const double yy = left / l2 - right / r2;
  const double xyy = (y * y - left * left) / (l2 * l2) - (y * y - right * right) / (r2 * r2);
  const double yyy = -2.0 * left * y / (l2 * l2) + 2.0 * right * y / (r2 * r2);
  const double nx = dot(normal, from.axes[1]), ny = dot(normal, from.axes[0]);
  return nx * nx * (yy + y * yyy) - 2.0 * nx * ny * y * xyy + ny * ny * (yy - y * yyy);
}

/// The same; nothing out of the source's plane.
double pressure(const Source<3>& from, const Vector<3>& at, const Vector<3>& normal) {
  const Vector<3> off = at - from.middle;
  const double a = from.half[0], b = from.half[1];
  const bool in_plane =
      std::abs(dot(off, from.axes[0])) < 0.1 * a && std::abs(dot(normal, from.axes[0])) > 0.99;
  if (!in_plane) return 0.0;
  const double x = dot(off, from.axes[1]), y = dot(off, from.axes[2]);
  const auto corner = [](double u, double v) { return std::hypot(u, v) / (u * v); };
  return 0.5 * (corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b) +
                corner(x - a, y - b));
}

/// A facet and its images at the planes, one at an axis at most.
template <int D>
std::vector<Source<D>> with_images(const CrackFacet<D>& facet,
                                   std::span<const SymmetryPlane> planes) {
  std::vector<Source<D>> sources{source<D>(facet)};
  for (int axis = 0; axis < D; ++axis) {
    const std::size_t known = sources.size();
    for (const SymmetryPlane& plane : planes) {
      if (plane.axis != axis) continue;
      for (std::size_t k = 0; k < known; ++k) sources.push_back(image<D>(sources[k], plane));
    }
  }
  return sources;
}

}  // namespace

template <int D>
Eigen::MatrixXd pressure_by_opening(std::span<const CrackFacet<D>> facets,
                                    std::span<const double> modulus,
                                    std::span<const SymmetryPlane> planes) {
  const auto count = static_cast<Eigen::Index>(facets.size());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(count, count);
  std::vector<Source<D>> targets;
  for (const CrackFacet<D>& facet : facets) targets.push_back(source<D>(facet));
  for (Eigen::Index g = 0; g < count; ++g) {
    for (const Source<D>& from : with_images<D>(facets[g], planes)) {
      for (Eigen::Index f = 0; f < count; ++f) {
        stiffness(f, g) += std::sqrt(modulus[f] * modulus[g]) / (4.0 * M_PI) *
                           pressure(from, targets[f].middle, targets[f].axes[0]);
      }
    }
  }
  for (Eigen::Index f = 0; f < count; ++f) {
    stiffness(f, f) += short_wave<D> * modulus[f] / (2.0 * targets[f].half[0]);
  }
  return 0.5 * (stiffness + Eigen::MatrixXd(stiffness.transpose()));
}

template Eigen::MatrixXd pressure_by_opening<2>(std::span<const CrackFacet<2>>,
                                                std::span<const double>,
                                                std::span<const SymmetryPlane>);
template Eigen::MatrixXd pressure_by_opening<3>(std::span<const CrackFacet<3>>,
                                                std::span<const double>,
                                                std::span<const SymmetryPlane>);

}  // namespace perifrac
