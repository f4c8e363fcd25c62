#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "core/body/body.hpp"
#include "core/solvers/multigrid.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/equilibrium/stiffness_level.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"

namespace perifrac {

/// The equilibrium of a body by multigrid: no matrix, no factor but that of some
/// hundred points. Coarse levels are bodies of their own with points twice as far apart
/// (coarse_body.hpp), the linear-exact operator on them, the same conditions at the faces, and
/// moduli that are the means of what a point stands for. Cracks cut the bonds of all levels, and
/// the ways between them.
template <int D>
class StiffnessMultigrid {
 public:
  /// `free_unknowns` as of SolidBoundary.
  StiffnessMultigrid(const Body<D>& body, std::shared_ptr<ElasticOperator<D>> elastic,
                     const SolidBoundary<D>& boundary,
                     const Eigen::SparseMatrix<double>& free_unknowns);

  /// Why a body cannot be solved so, in words; empty where it can.
  static std::string obstacle(const Eigen::SparseMatrix<double>& free_unknowns);

  /// Adds to u what takes the force that is left over on the free unknowns, `residual` of all, to
  /// `tolerance` [N]. Returns the iterations that took. Throws NotConverged.
  int correct(Eigen::VectorXd& residual, Eigen::VectorXd& u, double tolerance);

  /// A crack has cut the body's own bonds along a facet: cuts those of coarse levels.
  void cut(const CrackFacet<D>& facet);
  /// After many cuts: how stiff the levels are now.
  void find_largest() { multigrid_->find_largest(); }

  /// Sets what is held to 0.
  void hold(Eigen::VectorXd& u) const { levels_.front()->hold(u); }

 private:
  /// What a level below the finest is made of.
  struct Coarse {
    std::shared_ptr<const Body<D>> body;
    std::shared_ptr<Family<D>> family;
    std::shared_ptr<BreakableElasticity<D>> elastic;
  };

  void factor_coarsest();

  const Body<D>& body_;
  std::vector<Coarse> coarse_;
  std::vector<StiffnessLevel<D>*> levels_;
  bool coarsest_is_old_ = false;  ///< cracks have cut it since it was factored
  std::optional<Multigrid> multigrid_;
};

}  // namespace perifrac
