#include "modules/solid/fracture/loose_piece.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

/// Of what a point costs: below this a motion costs nothing. One that a single point resists costs
/// about 1 / (points of the piece), one that nothing does what rounding leaves.
constexpr double nothing = 1e-11;

/// Walks along bonds from a point that is not yet met; `use` says of each point met whether to go
/// on.
template <int D, class Use>
void walk(const Family<D>& family, Index first, std::vector<bool>& is_met, Use&& use) {
  std::vector<Index> met{first};
  is_met[first] = true;
  for (std::size_t k = 0; k < met.size(); ++k) {
    const Index i = met[k];
    if (!use(i)) return;
    for (const auto& [j, weight] : family.bonds(i)) {
      if (j >= family.point_count || weight == 0.0 || is_met[j]) continue;
      is_met[j] = true;
      met.push_back(j);
    }
  }
}

template <int D>
std::vector<std::vector<Index>> find_pieces(const Family<D>& family) {
  std::vector<std::vector<Index>> pieces;
  std::vector<bool> is_met(family.point_count, false);
  for (Index i = 0; i < family.point_count; ++i) {
    if (is_met[i]) continue;
    auto& piece = pieces.emplace_back();
    walk<D>(family, i, is_met, [&](Index point) {
      piece.push_back(point);
      return true;
    });
    std::ranges::sort(piece);
  }
  return pieces;
}

/// Rigid motions of pieces, and plates, as columns of what is solved for; each of unit length.
struct Motions {
  std::vector<Eigen::VectorXd> columns;
  std::vector<Index> piece;  ///< by column; -1: a plate's

  void add(const Eigen::VectorXd& motion, Index of) {
    const double size = motion.norm();
    if (!(size > 0.0)) return;  // held altogether
    columns.push_back(motion / size);
    piece.push_back(of);
  }
};

/// Unknowns that plates move are theirs, not the points'.
Eigen::VectorXd without_plates(Eigen::VectorXd motion, std::span<const int> plates) {
  for (const int plate : plates) motion[plate] = 0.0;
  return motion;
}

std::vector<int> find_plates(const Eigen::SparseMatrix<double>& free_unknowns, Index of_points) {
  std::vector<int> plates;
  for (int column = 0; column < free_unknowns.cols(); ++column) {
    const auto first = Eigen::SparseMatrix<double>::InnerIterator(free_unknowns, column);
    const bool is_shared = free_unknowns.col(column).nonZeros() > 1;
    if (is_shared || (first && first.row() >= of_points)) plates.push_back(column);
  }
  return plates;
}

template <int D>
void add_rigid_motions(const Family<D>& family, std::span<const Index> points, Index number,
                       const Eigen::SparseMatrix<double>& free_unknowns,
                       std::span<const int> plates, Motions& motions) {
  const Index n = family.point_count;
  Vector<D> mean{};
  for (int a = 0; a < D; ++a) {
    for (const Index i : points)
      mean[a] += family.position[a][i] / static_cast<double>(points.size());
  }
  const auto add = [&](auto&& move) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(free_unknowns.rows());
    for (const Index i : points) move(i, all);
    motions.add(without_plates(free_unknowns.transpose() * all, plates), number);
  };
  for (int a = 0; a < D; ++a) {
    add([&](Index i, Eigen::VectorXd& all) { all[a * n + i] = 1.0; });
    for (int b = a + 1; b < D; ++b) {
      add([&](Index i, Eigen::VectorXd& all) {
        all[a * n + i] = mean[b] - family.position[b][i];
        all[b * n + i] = family.position[a][i] - mean[a];
      });
    }
  }
}

template <int D>
Eigen::MatrixXd energies(BreakableElasticity<D>& elastic, const Motions& motions,
                         const Eigen::SparseMatrix<double>& free_unknowns, Index point_count) {
  const auto count = std::ssize(motions.columns);
  Eigen::MatrixXd energy(count, count);
  std::vector<double> force(free_unknowns.rows()), scratch(point_count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const Eigen::VectorXd u = free_unknowns * motions.columns[c];
    elastic.apply_small({u.data(), static_cast<std::size_t>(u.size())}, {}, force, scratch);
    const Eigen::VectorXd answer = free_unknowns.transpose() * Eigen::Map<const Eigen::VectorXd>(
                                                                   force.data(), std::ssize(force));
    for (Eigen::Index r = 0; r < count; ++r) energy(r, c) = motions.columns[r].dot(answer);
  }
  return 0.5 * (energy + energy.transpose());
}

}  // namespace

template <int D>
bool are_joined(const Family<D>& family, std::span<const std::pair<Index, Index>> broken) {
  std::vector<bool> is_wanted(family.point_count, false), is_met(family.point_count, false);
  Index left = 0;
  for (const auto& [i, j] : broken) {
    for (const Index end : {i, j}) {
      if (!is_wanted[end]) ++left;
      is_wanted[end] = true;
    }
  }
  if (broken.empty()) return true;
  walk<D>(family, broken.front().first, is_met, [&](Index i) {
    if (is_wanted[i]) --left;
    return left > 0;
  });
  return left == 0;
}

template <int D>
std::vector<std::vector<Index>> find_loose_pieces(
    BreakableElasticity<D>& elastic, const Family<D>& family,
    const Eigen::SparseMatrix<double>& free_unknowns) {
  std::vector<std::vector<Index>> pieces = find_pieces(family);
  if (pieces.size() == 1) return {};  // which is the whole body's affair
  const std::vector<int> plates = find_plates(free_unknowns, D * family.point_count);
  Motions motions;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    add_rigid_motions<D>(family, pieces[k], static_cast<Index>(k), free_unknowns, plates, motions);
  }
  for (const int plate : plates) {
    motions.add(Eigen::VectorXd::Unit(free_unknowns.cols(), plate), -1);
  }
  const Eigen::MatrixXd energy = energies(elastic, motions, free_unknowns, family.point_count);
  const SymmetricSpectrum spectrum = symmetric_spectrum(energy);
  // What it takes to move a point beside its neighbours [N/m], in 2D per metre.
  const double typical = elastic.law(0).stabilisation() * std::pow(family.volume[0], (D - 2.0) / D);
  std::vector<double> share(pieces.size(), 0.0);
  for (Eigen::Index v = 0; v < spectrum.values.size(); ++v) {
    if (spectrum.values[v] > nothing * typical) break;
    for (std::size_t c = 0; c < motions.piece.size(); ++c) {
      const double part = spectrum.vectors(static_cast<Eigen::Index>(c), v);
      if (motions.piece[c] >= 0) share[motions.piece[c]] += part * part;
    }
  }
  std::vector<std::vector<Index>> loose;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (share[k] > 1e-6) loose.push_back(std::move(pieces[k]));
  }
  return loose;
}

template <int D>
std::string describe_piece(const Family<D>& family, std::span<const Index> piece) {
  Vector<D> low, high;
  for (int a = 0; a < D; ++a) {
    const auto along = [&](Index i) { return family.position[a][i]; };
    low[a] = along(*std::ranges::min_element(piece, {}, along));
    high[a] = along(*std::ranges::max_element(piece, {}, along));
  }
  if (piece.size() == 1)
    return fmt::format("a piece of one point, at ({:.6g}) m", fmt::join(low, ", "));
  return fmt::format("a piece of {} points, from ({:.6g}) to ({:.6g}) m", piece.size(),
                     fmt::join(low, ", "), fmt::join(high, ", "));
}

template bool are_joined<2>(const Family<2>&, std::span<const std::pair<Index, Index>>);
template bool are_joined<3>(const Family<3>&, std::span<const std::pair<Index, Index>>);
template std::vector<std::vector<Index>> find_loose_pieces<2>(BreakableElasticity<2>&,
                                                              const Family<2>&,
                                                              const Eigen::SparseMatrix<double>&);
template std::vector<std::vector<Index>> find_loose_pieces<3>(BreakableElasticity<3>&,
                                                              const Family<3>&,
                                                              const Eigen::SparseMatrix<double>&);
template std::string describe_piece<2>(const Family<2>&, std::span<const Index>);
template std::string describe_piece<3>(const Family<3>&, std::span<const Index>);

}  // namespace perifrac
