#include "modules/solid/equilibrium/stiffness_multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/errors.hpp"
#include "core/base/law_by_region.hpp"
#include "core/bonds/bond_state.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/operators/stiffness_diagonal.hpp"
#include "core/profile/profile.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"

namespace perifrac {

namespace {

/// Few enough for a factor that costs nothing beside the rest.
constexpr Index coarsest_points = 400;

/// Of the coarsest stiffness, where cracks have cut it: what holds pieces that come loose there.
constexpr double loose_part = 1e-4;

/// Moduli are told apart to this.
constexpr double modulus_step = 0.05;

template <int D>
using Laws = LawByRegion<IsotropicElasticity<D>>;

/// The diagonal knows how stiff rock is against changes of volume, not how soft it is beside that
/// against all others: those are damped by steps in proportion to the root of the ratio. So a
/// solve takes some 50 iterations at most up to a Poisson's ratio of 0.4999, and two steps do up to
/// 0.35.
template <int D>
int smoothing_steps(const std::vector<IsotropicElasticity<D>>& by_point) {
  double largest = 0.0;
  for (const IsotropicElasticity<D>& law : by_point) {
    largest = std::max(largest, law.lame_lambda / law.shear_modulus);
  }
  return 2 + std::min(38, static_cast<int>(0.65 * std::sqrt(largest)));
}

/// Where body, conditions and moduli of one level are kept while the next is made.
template <int D>
struct LevelParts {
  const Body<D>* body;
  std::vector<bool> held;
  std::vector<IsotropicElasticity<D>> laws;  ///< by point
};

/// The means over the points that a coarse one stands for.
template <int D>
std::vector<IsotropicElasticity<D>> mean_laws(const LevelParts<D>& fine,
                                              const CoarseBody<D>& coarse) {
  const Points<D>& points = coarse.body->points();
  std::vector<IsotropicElasticity<D>> laws(points.size(), {0.0, 0.0});
  for (std::size_t i = 0; i < fine.laws.size(); ++i) {
    const Index c = coarse.coarse_of[i];
    const double share = fine.body->points().volume[i] / points.volume[c];
    laws[c].lame_lambda += share * fine.laws[i].lame_lambda;
    laws[c].shear_modulus += share * fine.laws[i].shear_modulus;
  }
  return laws;
}

/// As few laws as tell the points apart to `modulus_step`, or to more where these are too many.
template <int D>
Laws<D> few_laws(const std::vector<IsotropicElasticity<D>>& by_point) {
  for (double step = modulus_step;; step *= 2.0) {
    Laws<D> result{{}, std::vector<std::uint8_t>(by_point.size())};
    std::map<std::pair<long, long>, std::size_t> known;
    for (std::size_t i = 0; i < by_point.size() && known.size() <= 256; ++i) {
      const IsotropicElasticity<D>& law = by_point[i];
      const std::pair key{std::lround(std::log(law.shear_modulus) / step),
                          std::lround(std::log(law.drained_bulk_modulus()) / step)};
      const auto [place, is_new] = known.try_emplace(key, result.laws.size());
      if (is_new) result.laws.push_back(law);
      result.law_of_point[i] = static_cast<std::uint8_t>(place->second);
    }
    if (known.size() <= 256) return result;
  }
}

template <int D>
std::shared_ptr<BreakableElasticity<D>> make_elastic(std::shared_ptr<const Family<D>> family,
                                                     const MirrorCondition<D, D>& mirror,
                                                     Laws<D> laws) {
  const auto make = [&](auto law) -> std::shared_ptr<BreakableElasticity<D>> {
    return std::make_shared<LinearExactElasticity<D, decltype(law)>>(
        LinearExactOperator<D, decltype(law)>(std::move(family), mirror, std::move(law)));
  };
  if (laws.laws.size() == 1) return make(laws.laws.front());
  return make(std::move(laws));
}

/// Most of what a coarse unknown stands for is held; or, where next to nothing is, any of it: pins.
template <int D>
std::vector<bool> held_on(const CoarseBody<D>& coarse, const std::vector<bool>& fine) {
  const std::size_t points = coarse.coarse_of.size(), coarse_points = coarse.cell_of.size();
  std::vector<int> held(D * coarse_points, 0), all(D * coarse_points, 0);
  int sum = 0;
  for (std::size_t a = 0; a < D; ++a) {
    for (std::size_t i = 0; i < points; ++i) {
      const std::size_t k = a * coarse_points + coarse.coarse_of[i];
      ++all[k];
      held[k] += fine[a * points + i] ? 1 : 0;
      sum += fine[a * points + i] ? 1 : 0;
    }
  }
  const bool pinned = sum <= D * (D + 1) / 2;
  std::vector<bool> result;
  for (std::size_t k = 0; k < held.size(); ++k) {
    result.push_back(pinned ? held[k] > 0 : 2 * held[k] > all[k]);
  }
  result.insert(result.end(), fine.begin() + static_cast<std::ptrdiff_t>(D * points), fine.end());
  return result;
}

/// What plates' unknowns weigh is asked of the operator, as each has bonds to a whole face.
template <int D>
Eigen::VectorXd inverse_diagonal(const Family<D>& family, const LevelParts<D>& parts,
                                 ElasticOperator<D>& elastic) {
  const std::vector<double> diagonal = stiffness_diagonal<D>(
      family, [&](Index i) -> const IsotropicElasticity<D>& { return parts.laws[i]; });
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(elastic.size());
  for (std::size_t k = 0; k < parts.held.size(); ++k) {
    if (parts.held[k]) continue;
    if (k < diagonal.size()) {
      inverse[static_cast<Eigen::Index>(k)] = 1.0 / diagonal[k];
      continue;
    }
    std::vector<double> unit(parts.held.size(), 0.0), force(parts.held.size());
    unit[k] = 1.0;
    elastic.apply_stiffness(unit, force);
    inverse[static_cast<Eigen::Index>(k)] = 1.0 / force[k];
  }
  return inverse;
}

/// The next coarser body, its bonds, and the way to it; nothing where it would be too thin.
template <int D>
struct Coarser {
  CoarseBody<D> body;
  std::shared_ptr<Family<D>> family;
  MirrorCondition<D, D> mirror;
  std::shared_ptr<BreakableElasticity<D>> elastic;
};

template <int D>
std::optional<Coarser<D>> find_coarser(const LevelParts<D>& fine, const Vector<D>& corner,
                                       const SolidBoundary<D>& boundary) {
  try {
    CoarseBody<D> body = coarsen<D>(*fine.body, corner);
    if (2 * body.body->points().size() > fine.body->points().size()) return {};
    auto family = std::make_shared<Family<D>>(*body.body->family(boundary.mirrored()));
    const MirrorCondition<D, D> mirror = boundary.mirror_condition(*family);
    auto elastic = make_elastic<D>(family, mirror, few_laws(mean_laws(fine, body)));
    return Coarser<D>{std::move(body), std::move(family), mirror, std::move(elastic)};
  } catch (const BodyError&) {
    return {};
  }
}

}  // namespace

template <int D>
std::string StiffnessMultigrid<D>::obstacle(const Eigen::SparseMatrix<double>& free_unknowns) {
  if (free_unknowns.nonZeros() != free_unknowns.cols()) {
    return "a rigid plate moves the points of a layer";
  }
  return {};
}

template <int D>
StiffnessMultigrid<D>::StiffnessMultigrid(const Body<D>& body,
                                          std::shared_ptr<ElasticOperator<D>> elastic,
                                          const SolidBoundary<D>& boundary,
                                          const Eigen::SparseMatrix<double>& free_unknowns)
    : body_(body) {
  const ProfileScope profiled("multigrid");
  LevelParts<D> parts{&body, std::vector<bool>(elastic->size(), true), {}};
  for (Eigen::Index k = 0; k < free_unknowns.nonZeros(); ++k) {
    parts.held[free_unknowns.innerIndexPtr()[k]] = false;
  }
  for (Index i = 0; i < body.points().size(); ++i) parts.laws.push_back(elastic->law(i));

  const int steps = smoothing_steps<D>(parts.laws);
  const Vector<D> corner = low_corner(body);
  std::shared_ptr<const Family<D>> family = body.family(boundary.mirrored());
  std::vector<std::unique_ptr<MultigridLevel>> all;
  for (;;) {
    auto level = std::make_unique<StiffnessLevel<D>>(elastic, parts.held,
                                                     inverse_diagonal(*family, parts, *elastic));
    levels_.push_back(level.get());
    all.push_back(std::move(level));
    if (parts.body->points().size() <= coarsest_points) break;
    std::optional<Coarser<D>> coarser = find_coarser<D>(parts, corner, boundary);
    if (!coarser) break;
    levels_.back()->set_way(CoarseInterpolation<D>(parts.body->points(), coarser->body,
                                                   *coarser->family, coarser->mirror));
    parts = {coarser->body.body.get(), held_on(coarser->body, parts.held),
             mean_laws(parts, coarser->body)};
    coarse_.push_back({coarser->body.body, coarser->family, coarser->elastic});
    family = coarser->family;
    elastic = coarser->elastic;
  }
  for (std::size_t k = 0; k + 1 < levels_.size(); ++k) levels_[k]->set_coarser(*levels_[k + 1]);
  multigrid_.emplace(std::move(all), levels_.back()->assemble(), steps);
}

template <int D>
void StiffnessMultigrid<D>::cut(const CrackFacet<D>& facet) {
  const Points<D>* fine = &body_.points();
  for (std::size_t k = 0; k < coarse_.size(); ++k) {
    Coarse& coarse = coarse_[k];
    const double reach = 1.001 * coarse.body->horizon();
    levels_[k]->cut_way(facet, *fine, *coarse.family, reach);
    fine = &coarse.body->points();
    const auto bonds = bonds_cut_by<D>(facet, *coarse.family, reach);
    for (const auto& [i, j] : bonds) silence(*coarse.family, i, j);
    coarse.elastic->update(ends_of(bonds));
    if (k + 1 == coarse_.size()) coarsest_is_old_ = coarsest_is_old_ || !bonds.empty();
  }
  if (coarse_.empty()) coarsest_is_old_ = true;
}

/// What its coarse bonds hold no more, finer ones may: a little of the diagonal does.
template <int D>
void StiffnessMultigrid<D>::factor_coarsest() {
  Eigen::SparseMatrix<double> coarsest = levels_.back()->assemble();
  const double some = loose_part * coarsest.diagonal().mean();
  for (Eigen::Index k = 0; k < coarsest.cols() && !coarse_.empty(); ++k) {
    coarsest.coeffRef(k, k) += some;
  }
  multigrid_->take_coarsest(coarsest);
  coarsest_is_old_ = false;
}

template <int D>
int StiffnessMultigrid<D>::correct(Eigen::VectorXd& residual, Eigen::VectorXd& u,
                                   double tolerance) {
  if (coarsest_is_old_) factor_coarsest();
  levels_.front()->hold(residual);
  return multigrid_->correct(residual, u, tolerance);
}

template class StiffnessMultigrid<2>;
template class StiffnessMultigrid<3>;

}  // namespace perifrac
