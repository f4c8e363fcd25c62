#include "modules/solid/equilibrium/cracked_solver.hpp"

#include "core/base/errors.hpp"
#include "modules/solid/equilibrium/iterated_body.hpp"
#include "modules/solid/equilibrium/stiffness_multigrid.hpp"
#include "modules/solid/fracture/condensed_body.hpp"

namespace perifrac {

template <int D>
std::unique_ptr<CrackedBody<D>> make_cracked_body(
    const Body<D>& body, const SolidBoundary<D>& boundary, std::shared_ptr<Family<D>> family,
    std::shared_ptr<BreakableElasticity<D>> elastic, BondState<D>& bonds,
    std::optional<InitialStress<D>> initial_stress, const std::vector<CrackFacet<D>>& seeds,
    bool has_friction, const SolverChoice& choice) {
  using Kind = SolverChoice::Kind;
  Eigen::SparseMatrix<double> free = boundary.free_unknowns(boundary.mirror_condition(*family));
  std::string obstacle = StiffnessMultigrid<D>::obstacle(free);
  if (has_friction) obstacle = "friction asks for the whole compliance of its cracks";
  if (choice.kind == Kind::multigrid && !obstacle.empty()) {
    throw BodyError("multigrid cannot solve for this body: " + obstacle,
                    "solid.linear_solver.type: direct or automatic");
  }
  const std::string worth = worth_of_multigrid(*family, points_worth_iteration(D));
  if (choice.kind == Kind::multigrid ||
      (choice.kind == Kind::automatic && !worth.empty() && obstacle.empty())) {
    return std::make_unique<IteratedBody<D>>(
        body, boundary, std::move(family), std::move(elastic), std::move(free), bonds,
        std::move(initial_stress), seeds, choice.crack_tolerance,
        choice.kind == Kind::multigrid ? "as the scene says" : worth);
  }
  const std::string why = choice.kind == Kind::direct ? "as the scene says"
                          : !worth.empty()            ? obstacle
                                                      : "few points";
  return std::make_unique<CondensedBody<D>>(std::move(family), body.spacing(), std::move(elastic),
                                            std::move(free), bonds, std::move(initial_stress),
                                            seeds, why);
}

template std::unique_ptr<CrackedBody<2>> make_cracked_body<2>(
    const Body<2>&, const SolidBoundary<2>&, std::shared_ptr<Family<2>>,
    std::shared_ptr<BreakableElasticity<2>>, BondState<2>&, std::optional<InitialStress<2>>,
    const std::vector<CrackFacet<2>>&, bool, const SolverChoice&);
template std::unique_ptr<CrackedBody<3>> make_cracked_body<3>(
    const Body<3>&, const SolidBoundary<3>&, std::shared_ptr<Family<3>>,
    std::shared_ptr<BreakableElasticity<3>>, BondState<3>&, std::optional<InitialStress<3>>,
    const std::vector<CrackFacet<3>>&, bool, const SolverChoice&);

}  // namespace perifrac
