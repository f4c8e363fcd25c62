#include "modules/solid/fracture/crack_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

using Complex = std::complex<double>;

/// Beyond this the line of a crack is bent so far that an even pressure has a K_II [rad].
constexpr double straight = 0.1;

/// What is farther away matters no more than as a factor of all jumps. Near to the tip facets are
/// taken in pieces, and jumps are compared [spacings].
constexpr double known_within = 40.0, near_tip = 6.0;
constexpr int piece_count = 4;

/// Half an element from a tip an endless crack opens by K sqrt(size / (4 pi)) 8 / E'; constant
/// elements of one size by this more.
constexpr double last_element = 1.253;

/// A stress that hardly moves the faces near the tip is not looked for in their jumps. What it does
/// has to stand out of the rest by this factor to be half believed in.
constexpr double telling = 0.03, doubt = 3.0;

struct Element {
  Complex middle;
  Complex along;  ///< the normal of its facet is to the left
  double half;
  Index facet;
};

Complex complex(const Vector<2>& x) { return {x[0], x[1]}; }

std::vector<Element> elements_of(const CutBody<2>& body, const CrackTip& tip,
                                 std::span<const Index> crack) {
  std::vector<Element> result;
  for (const Index f : crack) {
    const CrackFacet<2>& facet = body.facets()[f];
    const double away = norm(middle<2>(facet) - tip.place) / body.spacing();
    if (away > known_within) continue;
    const Complex begin = complex(facet[0]), side = complex(facet[1]) - begin;
    const Complex along = complex(body.jumps()[f].normal) * Complex(0.0, -1.0);
    const int count = away < near_tip ? piece_count : 1;
    for (int k = 0; k < count; ++k) {
      const Complex place = begin + side * ((k + 0.5) / count);
      result.push_back({place, along, 0.5 * std::abs(side) / count, f});
    }
  }
  return result;
}

/// Normal stress and, as imaginary part, shear stress on element `at`, of a jump of `source` along
/// it (1) or its normal (i) of 8 / E' metres, by Muskhelishvili's potentials [Pa].
Complex traction(const Element& at, const Element& source, const Complex& jump) {
  const Complex z = (at.middle - source.middle) / source.along, turn = at.along / source.along;
  const double a = source.half;
  const Complex strength = jump / Complex(0.0, M_PI);
  const Complex ahead = 1.0 / (z - a), back = 1.0 / (z + a);
  const Complex phi = strength * (ahead - back);
  const Complex slope = -strength * (ahead * ahead - back * back);
  const Complex psi =
      std::conj(strength) * (ahead - back) + strength * a * (ahead * ahead + back * back);
  return 2.0 * phi.real() + turn * turn * (std::conj(z) * slope + psi);
}

/// Openings, below them slips, of all elements, by tensions along x and y and a shear far away, in
/// columns [m], E' = 8 Pa.
Eigen::MatrixXd answers(const std::vector<Element>& elements) {
  const auto count = static_cast<Eigen::Index>(elements.size());
  Eigen::MatrixXd stress(2 * count, 2 * count), load(2 * count, 3);
  for (Eigen::Index m = 0; m < count; ++m) {
    for (Eigen::Index n = 0; n < count; ++n) {
      const Complex open = traction(elements[m], elements[n], {0.0, 1.0});
      const Complex slide = traction(elements[m], elements[n], {1.0, 0.0});
      stress(m, n) = open.real();
      stress(m + count, n) = open.imag();
      stress(m, n + count) = slide.real();
      stress(m + count, n + count) = slide.imag();
    }
    const Complex square = elements[m].along * elements[m].along;
    const std::array<Complex, 3> far = {0.5 - 0.5 * square, 0.5 + 0.5 * square,
                                        Complex(0.0, 1.0) * square};
    for (int k = 0; k < 3; ++k) {
      load(m, k) = -far[k].real();
      load(m + count, k) = -far[k].imag();
    }
  }
  return stress.partialPivLu().solve(load);
}

/// Columns as answers(): K_I and K_II, by the jump of the element at the tip.
Eigen::Matrix<double, 2, 3> intensities_of(const std::vector<Element>& elements,
                                           const Eigen::MatrixXd& found, const CrackTip& tip) {
  const auto count = static_cast<Eigen::Index>(elements.size());
  const Complex place = complex(tip.place), ahead = complex(tip.direction);
  Eigen::Index last = -1;
  for (Eigen::Index m = 0; m < count; ++m) {
    if (elements[m].facet != tip.facet) continue;
    const bool is_nearer =
        last < 0 || std::abs(elements[m].middle - place) < std::abs(elements[last].middle - place);
    if (is_nearer) last = m;
  }
  const Element& end = elements[last];
  // From the face on the right of the tip to that on its left.
  const double from_right = (end.along * std::conj(ahead)).real() > 0.0 ? 1.0 : -1.0;
  const Complex in_tip =
      from_right * end.along * std::conj(ahead) * std::sqrt(2.0 * M_PI / end.half) / last_element;
  Eigen::Matrix<double, 2, 3> result;
  for (int k = 0; k < 3; ++k) {
    const Complex own = in_tip * Complex(found(last + count, k), found(last, k));
    result.col(k) << own.imag(), own.real();
  }
  return result;
}

/// Columns as answers(): mean jumps of the facets, along normal and tangent in turn.
Eigen::MatrixXd jumps_of(std::span<const Index> facets, const CutBody<2>& body,
                         const std::vector<Element>& elements, const Eigen::MatrixXd& found) {
  const auto count = static_cast<Eigen::Index>(elements.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(facets.size()), 3);
  for (Eigen::Index m = 0; m < count; ++m) {
    const Element& part = elements[m];
    const auto at = std::ranges::find(facets, part.facet);
    if (at == facets.end()) continue;
    const FaceJump<2>& face = body.jumps()[part.facet];
    const double share = 2.0 * part.half / face.area;
    const double same = (std::conj(complex(face.tangents[0])) * part.along).real();
    const Eigen::Index row = 2 * (at - facets.begin());
    result.row(row) += share * found.row(m);
    result.row(row + 1) += share * same * found.row(m + count);
  }
  return result;
}

/// The same of the body, on its lattice; empty where it does not say.
Eigen::MatrixXd jumps_of(std::span<const Index> facets, CutBody<2>& body,
                         std::span<const Index> loaded) {
  Eigen::MatrixXd result(2 * static_cast<Eigen::Index>(facets.size()), 3);
  for (int k = 0; k < 3; ++k) {
    std::vector<Vector<2>> tractions(body.jumps().size(), Vector<2>{});
    for (const Index f : loaded) {
      const Vector<2>& n = body.jumps()[f].normal;
      const std::array<Vector<2>, 3> on_face = {Vector<2>{n[0], 0.0}, Vector<2>{0.0, n[1]},
                                                Vector<2>{n[1], n[0]}};
      tractions[f] = {dot(n, on_face[k]), dot(body.jumps()[f].tangents[0], on_face[k])};
    }
    const std::vector<Vector<2>> jumps = body.jumps_by(tractions);
    if (jumps.empty()) return {};
    Eigen::Index row = 0;
    for (const Index f : facets) {
      result(row++, k) = jumps[f][0];
      result(row++, k) = jumps[f][1];
    }
  }
  return result;
}

}  // namespace

TipModes CrackShape::modes(const Eigen::Vector3d& stress) const {
  const Eigen::Vector2d both =
      scale * Eigen::Map<const Eigen::Matrix<double, 2, 3>>(intensities.data()) * stress;
  return {both[0], both[1]};
}

bool is_line(const CutBody<2>& body, const CrackTip& tip, std::span<const Index> crack) {
  return std::ranges::all_of(crack, [&](Index f) {
    return std::abs(cross(body.jumps()[f].tangents[0], tip.direction)) < straight;
  });
}

std::vector<Index> facets_near(const CutBody<2>& body, std::span<const Index> crack,
                               const Vector<2>& tip) {
  std::vector<Index> result;
  for (const Index f : crack) {
    const double away = norm(middle<2>(body.facets()[f]) - tip);
    if (away < near_tip * body.spacing()) result.push_back(f);
  }
  return result;
}

CrackShape crack_shape(CutBody<2>& body, const CrackTip& tip, std::span<const Index> crack,
                       std::span<const Index> loaded, std::vector<Index> facets,
                       double plane_strain_modulus) {
  const std::vector<Element> elements = elements_of(body, tip, crack);
  const Eigen::MatrixXd found = answers(elements);
  const Eigen::MatrixXd jumps = jumps_of(facets, body, loaded);
  if (jumps.size() == 0) return {};
  const Eigen::MatrixXd infinite =
      jumps_of(facets, body, elements, found) * 8.0 / plane_strain_modulus;
  const auto opened = [&](const Eigen::MatrixXd& by) {
    return by(Eigen::seqN(0, std::ssize(facets), 2), Eigen::seqN(0, 2)).sum();
  };
  const double scale = opened(jumps) / opened(infinite);
  const Eigen::Matrix<double, 2, 3> intensities = intensities_of(elements, found, tip);
  CrackShape shape{.facets = std::move(facets), .jumps = {}, .intensities = {}, .scale = scale};
  shape.jumps.assign(jumps.reshaped().begin(), jumps.reshaped().end());
  shape.intensities.assign(intensities.reshaped().begin(), intensities.reshaped().end());
  return shape;
}

Eigen::Vector3d stress_of(const CrackShape& begin, const CrackShape& end, double share,
                          std::span<const Vector<2>> jumps, const Vector<2>& relief,
                          double pressure) {
  const auto rows = 2 * std::ssize(begin.facets);
  const auto by_stress = [&](const CrackShape& shape) {
    return Eigen::Map<const Eigen::MatrixX3d>(shape.jumps.data(), rows, 3);
  };
  const Eigen::MatrixX3d by_each = (1.0 - share) * by_stress(begin) + share * by_stress(end);
  const Eigen::Vector3d known(relief[0] + pressure, relief[1] + pressure, 0.0);
  Eigen::VectorXd left = -by_each * known;
  for (Eigen::Index k = 0; k < rows; ++k) left[k] += jumps[begin.facets[k / 2]][k % 2];
  const Eigen::JacobiSVD<Eigen::MatrixXd> parts(by_each, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd seen = parts.matrixU().transpose() * left;
  const double noise = (left - parts.matrixU() * seen).squaredNorm() /
                       static_cast<double>(std::max<Eigen::Index>(1, rows - seen.size()));
  Eigen::Vector3d stress = known;
  for (Eigen::Index k = 0; k < seen.size(); ++k) {
    const double size = parts.singularValues()[k], square = seen[k] * seen[k];
    if (!(size > telling * parts.singularValues()[0]) || !(square > 0.0)) continue;
    const double believed = square / (square + doubt * doubt * noise);
    stress += believed * seen[k] / size * parts.matrixV().col(k);
  }
  return stress;
}

}  // namespace perifrac
