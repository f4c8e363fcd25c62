#include "modules/solid/equilibrium/stiffness_multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/errors.hpp"
#include "core/base/law_by_region.hpp"
#include "core/operators/stiffness_diagonal.hpp"
#include "core/profile/profile.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"

namespace perifrac {

namespace {

/// Few enough for a factor that costs nothing beside the rest.
constexpr Index coarsest_points = 400;

/// Moduli are told apart to this.
constexpr double modulus_step = 0.05;

template <int D>
using Laws = LawByRegion<IsotropicElasticity<D>>;

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
std::shared_ptr<ElasticOperator<D>> make_elastic(std::shared_ptr<const Family<D>> family,
                                                 const MirrorCondition<D, D>& mirror,
                                                 Laws<D> laws) {
  const auto make = [&](auto law) -> std::shared_ptr<ElasticOperator<D>> {
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
  std::shared_ptr<const Family<D>> family;
  MirrorCondition<D, D> mirror;
  std::shared_ptr<ElasticOperator<D>> elastic;
};

template <int D>
std::optional<Coarser<D>> find_coarser(const LevelParts<D>& fine, const Vector<D>& corner,
                                       const SolidBoundary<D>& boundary) {
  try {
    CoarseBody<D> body = coarsen<D>(*fine.body, corner);
    if (2 * body.body->points().size() > fine.body->points().size()) return {};
    auto family = body.body->family(boundary.mirrored());
    const MirrorCondition<D, D> mirror = boundary.mirror_condition(*family);
    auto elastic = make_elastic<D>(family, mirror, few_laws(mean_laws(fine, body)));
    return Coarser<D>{std::move(body), std::move(family), mirror, std::move(elastic)};
  } catch (const BodyError&) {
    return {};
  }
}

}  // namespace

template <int D>
std::string StiffnessMultigrid<D>::obstacle(const Body<D>& body,
                                            const Eigen::SparseMatrix<double>& free_unknowns) {
  if (body.irregular()) return "its points are no lattice";
  if (free_unknowns.nonZeros() != free_unknowns.cols()) {
    return "a rigid plate moves the points of a layer";
  }
  return {};
}

template <int D>
StiffnessMultigrid<D>::StiffnessMultigrid(const Body<D>& body,
                                          std::shared_ptr<ElasticOperator<D>> elastic,
                                          const SolidBoundary<D>& boundary,
                                          const Eigen::SparseMatrix<double>& free_unknowns) {
  const ProfileScope profiled("multigrid");
  LevelParts<D> parts{&body, std::vector<bool>(elastic->size(), true), {}};
  for (Eigen::Index k = 0; k < free_unknowns.nonZeros(); ++k) {
    parts.held[free_unknowns.innerIndexPtr()[k]] = false;
  }
  for (Index i = 0; i < body.points().size(); ++i) parts.laws.push_back(elastic->law(i));

  const Vector<D> corner = low_corner(body);
  std::shared_ptr<const Family<D>> family = body.family(boundary.mirrored());
  std::vector<std::unique_ptr<StiffnessLevel<D>>> levels;
  std::vector<std::shared_ptr<const Body<D>>> bodies;
  for (;;) {
    levels.push_back(std::make_unique<StiffnessLevel<D>>(
        elastic, parts.held, inverse_diagonal(*family, parts, *elastic)));
    if (parts.body->points().size() <= coarsest_points) break;
    std::optional<Coarser<D>> coarser = find_coarser<D>(parts, corner, boundary);
    if (!coarser) break;
    levels.back()->set_way(CoarseInterpolation<D>(parts.body->points(), coarser->body,
                                                  *coarser->family, coarser->mirror));
    parts = {coarser->body.body.get(), held_on(coarser->body, parts.held),
             mean_laws(parts, coarser->body)};
    bodies.push_back(coarser->body.body);
    family = coarser->family;
    elastic = coarser->elastic;
  }
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) levels[k]->set_coarser(*levels[k + 1]);
  finest_ = levels.front().get();
  const Eigen::SparseMatrix<double> coarsest = levels.back()->assemble();
  std::vector<std::unique_ptr<MultigridLevel>> all;
  for (auto& level : levels) all.push_back(std::move(level));
  multigrid_.emplace(std::move(all), coarsest);
}

template <int D>
int StiffnessMultigrid<D>::correct(Eigen::VectorXd& residual, Eigen::VectorXd& u,
                                   double tolerance) {
  finest_->hold(residual);
  return multigrid_->correct(residual, u, tolerance);
}

template class StiffnessMultigrid<2>;
template class StiffnessMultigrid<3>;

}  // namespace perifrac
