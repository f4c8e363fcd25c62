#include "app/warnings/small_strains.hpp"

#include <algorithm>
#include <vector>

#include "app/warnings/least_squares_gradient.hpp"
#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

template <int D>
using StrainMatrix = typename LeastSquaresGradient<D>::Matrix;

template <int D>
using Column = typename LeastSquaresGradient<D>::Column;

template <int D>
class Displaced {
 public:
  Displaced(const Body<D>& body, std::span<const double> displacement)
      : points_(body.points()), u_(displacement) {}

  Column<D> bond(Index i, Index j) const {
    return Column<D>::NullaryExpr(
        [&](Eigen::Index a) { return points_.position[a][j] - points_.position[a][i]; });
  }
  Column<D> moved_apart(Index i, Index j) const {
    return Column<D>::NullaryExpr([&](Eigen::Index a) {
      const std::size_t first = a * points_.volume.size();
      return u_[first + j] - u_[first + i];
    });
  }

 private:
  const Points<D>& points_;
  std::span<const double> u_;
};

template <int D>
StrainMatrix<D> gradient_at(const Family<D>& family, Index i, const Displaced<D>& displaced) {
  LeastSquaresGradient<D> gradient;
  for (const auto& [j, weight] : family.bonds(i)) {
    if (j >= family.point_count) continue;  // what a ghost does follows from the others
    gradient.add(displaced.bond(i, j), displaced.moved_apart(i, j), weight);
  }
  return gradient.matrix();
}

bool moves_as_one(std::span<const double> displacement, std::size_t points, double negligible) {
  for (std::size_t first = 0; first < displacement.size(); first += points) {
    const auto [low, high] = std::ranges::minmax(displacement.subspan(first, points));
    if (high - low > negligible) return false;
  }
  return true;
}

}  // namespace

template <int D>
LargestStrain largest_strain(const Body<D>& body, std::span<const double> displacement,
                             double negligible) {
  LargestStrain largest;
  const auto families = body.families();
  const auto count = static_cast<std::size_t>(body.points().size());
  if (families.empty() || moves_as_one(displacement, count, negligible)) return largest;
  std::vector<bool> torn(count, false);
  for (const BrokenBond& bond : body.bond_state().broken()) torn[bond.i] = torn[bond.j] = true;
  const Displaced<D> displaced(body, displacement);
  for (Index i = 0; i < body.points().size(); ++i) {
    if (torn[i]) continue;
    const StrainMatrix<D> gradient = gradient_at(*families.front(), i, displaced);
    const StrainMatrix<D> strain = 0.5 * (gradient + gradient.transpose());
    const StrainMatrix<D> spin = 0.5 * (gradient - gradient.transpose());
    const double rotation = std::sqrt(0.5) * spin.norm();
    // The norm is above each principal strain; the costly ones only where it counts.
    if (strain.norm() > largest.strain) {
      const double size = symmetric_spectrum(strain).values.cwiseAbs().maxCoeff();
      if (size > largest.strain) largest.strain = size, largest.strained = i;
    }
    if (rotation > largest.rotation) largest.rotation = rotation, largest.rotated = i;
  }
  return largest;
}

template LargestStrain largest_strain(const Body<2>&, std::span<const double>, double);
template LargestStrain largest_strain(const Body<3>&, std::span<const double>, double);

}  // namespace perifrac
