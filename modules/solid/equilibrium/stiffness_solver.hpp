#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// How the equilibrium of an intact body is found.
struct SolverChoice {
  enum class Kind { automatic, direct, multigrid };
  Kind kind = Kind::automatic;
  double tolerance = 1e-9;        ///< multigrid: force left over, to the body's forces
  double crack_tolerance = 1e-4;  ///< the same of a body with cracks
};

/// From so many points on a lattice `automatic` takes multigrid: it is the faster one, its first
/// solve included, and stays so over some hundred windows.
constexpr double points_worth_multigrid(int dimension) { return dimension == 2 ? 2e4 : 2e3; }

/// In 3D it takes multigrid also where so many numbers are assembled, the squares of what each
/// point's stiffness has as rows: where horizons are long few points make a factor of a stiffness
/// that is full.
constexpr double numbers_worth_multigrid = 6e8;

/// Why a body is worth multigrid: many points, or many bonds; nothing where it is not.
template <int D>
std::string worth_of_multigrid(const Family<D>& family, double points_worth);

/// The keys of `linear_solver`.
KeyTable linear_solver_keys();
SolverChoice read_solver_choice(const Section& section);

/// Solves for the displacements of a body in equilibrium.
template <int D>
class StiffnessSolver {
 public:
  virtual ~StiffnessSolver() = default;

  /// To be called once, of a body that is held. Throws NotPositiveDefinite, std::bad_alloc.
  virtual void prepare() = 0;
  /// How it goes over the bonds, and why.
  virtual std::string path() const = 0;
  /// It is the faster, the nearer `unknowns` are to the answer.
  virtual bool goes_on() const = 0;
  /// Lets the free unknowns answer `load` [N], of all unknowns; those that are held stay.
  /// `inner`: the stiffness times `unknowns`, before. Throws NotConverged.
  virtual void solve(const Eigen::VectorXd& load, const Eigen::VectorXd& inner,
                     Eigen::VectorXd& unknowns) = 0;
};

/// `free_unknowns` as of SolidBoundary; body and boundary must stay until it is prepared. Throws
/// BodyError where the choice cannot solve for the body.
template <int D>
std::unique_ptr<StiffnessSolver<D>> make_stiffness_solver(
    const Body<D>& body, std::shared_ptr<ElasticOperator<D>> elastic,
    const SolidBoundary<D>& boundary, Eigen::SparseMatrix<double> free_unknowns,
    const SolverChoice& choice);

}  // namespace perifrac
