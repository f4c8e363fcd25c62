#include "modules/solid/equilibrium/stiffness_solver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/solvers/reduced_matrix.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/equilibrium/stiffness_multigrid.hpp"

namespace perifrac {

KeyTable linear_solver_keys() {
  return {
      {.path = "linear_solver.type",
       .type = KeyType::word,
       .fallback = "automatic",
       .words = {"automatic", "direct", "multigrid"},
       .meaning = "quasi_static: direct factors the stiffness once, in 3D at a price beyond some "
                  "two thousand points and in 2D beyond a hundred thousand; multigrid takes time "
                  "and memory in proportion to the points; automatic chooses by "
                  "their number, in 3D by that of their bonds too. Beside friction "
                  "between faces: direct."},
      {.path = "linear_solver.tolerance",
       .range = "[1e-13, 1e-2]",
       .fallback = "1e-9",
       .meaning = "multigrid: force that is left over, to the forces on the body."},
      {.path = "linear_solver.crack_tolerance",
       .range = "[1e-12, 1e-2]",
       .fallback = "1e-4",
       .meaning = "The same of a body with cracks, beside what the coupling's iterations leave."}};
}

template <int D>
std::string worth_of_multigrid(const Family<D>& family, double points_worth) {
  if (family.point_count >= points_worth) return "many points";
  double numbers = 0.0;
  for (Index i = 0; i < family.point_count; ++i) {
    const double rows = D * (family.bond_count(i) + 1.0);
    numbers += rows * rows;
  }
  return D == 3 && numbers >= numbers_worth_multigrid ? "many bonds" : "";
}

template std::string worth_of_multigrid<2>(const Family<2>&, double);
template std::string worth_of_multigrid<3>(const Family<3>&, double);

SolverChoice read_solver_choice(const Section& section) {
  const std::string type = section.word("linear_solver.type");
  using Kind = SolverChoice::Kind;
  return {.kind = type == "direct"      ? Kind::direct
                  : type == "multigrid" ? Kind::multigrid
                                        : Kind::automatic,
          .tolerance = section.number("linear_solver.tolerance"),
          .crack_tolerance = section.number("linear_solver.crack_tolerance")};
}

namespace {

/// By a factor, which each solve passes through once.
template <int D>
class DirectStiffness final : public StiffnessSolver<D> {
 public:
  /// `why` it is not multigrid.
  DirectStiffness(std::shared_ptr<ElasticOperator<D>> elastic, Eigen::SparseMatrix<double> free,
                  std::string why)
      : elastic_(std::move(elastic)), free_(std::move(free)), why_(std::move(why)) {}

  void prepare() override { factor_.factor(reduced(elastic_->assemble(), free_)); }

  std::string path() const override { return "a factor of the stiffness: " + why_; }
  bool goes_on() const override { return false; }

  void solve(const Eigen::VectorXd& load, const Eigen::VectorXd& inner,
             Eigen::VectorXd& unknowns) override {
    Eigen::VectorXd change(free_.cols());
    factor_.solve(free_.transpose() * (load - inner), change);
    unknowns += free_ * change;
  }

 private:
  std::shared_ptr<ElasticOperator<D>> elastic_;
  Eigen::SparseMatrix<double> free_;
  std::string why_;
  SparseCholesky factor_;
};

template <int D>
class IteratedStiffness final : public StiffnessSolver<D> {
 public:
  IteratedStiffness(const Body<D>& body, std::shared_ptr<ElasticOperator<D>> elastic,
                    const SolidBoundary<D>& boundary, Eigen::SparseMatrix<double> free,
                    double tolerance)
      : body_(body),
        boundary_(boundary),
        elastic_(std::move(elastic)),
        free_(std::move(free)),
        tolerance_(tolerance) {}

  void prepare() override { multigrid_.emplace(body_, elastic_, boundary_, free_); }

  std::string path() const override { return "multigrid, " + elastic_->path(); }
  bool goes_on() const override { return true; }

  /// Until what is left over is small beside the forces, reactions among them, as they are then:
  /// before the body answers a face that has moved they are much larger.
  void solve(const Eigen::VectorXd& load, const Eigen::VectorXd& inner,
             Eigen::VectorXd& unknowns) override {
    Eigen::VectorXd force = inner;
    for (int round = 0; round < most_rounds; ++round) {
      Eigen::VectorXd residual = load - force;
      multigrid_->hold(residual);
      const double target = tolerance_ * std::max(load.norm(), force.norm());
      if (residual.norm() <= target) return;
      multigrid_->correct(residual, unknowns, 0.5 * target);
      elastic_->apply_stiffness(view(std::as_const(unknowns)), view(force));
    }
  }

 private:
  static constexpr int most_rounds = 5;

  const Body<D>& body_;
  SolidBoundary<D> boundary_;
  std::shared_ptr<ElasticOperator<D>> elastic_;
  Eigen::SparseMatrix<double> free_;
  double tolerance_;
  std::optional<StiffnessMultigrid<D>> multigrid_;
};

}  // namespace

template <int D>
std::unique_ptr<StiffnessSolver<D>> make_stiffness_solver(
    const Body<D>& body, std::shared_ptr<ElasticOperator<D>> elastic,
    const SolidBoundary<D>& boundary, Eigen::SparseMatrix<double> free_unknowns,
    const SolverChoice& choice) {
  using Kind = SolverChoice::Kind;
  const std::string obstacle = StiffnessMultigrid<D>::obstacle(free_unknowns);
  if (choice.kind == Kind::multigrid && !obstacle.empty()) {
    throw BodyError("multigrid cannot solve for this body: " + obstacle,
                    "solid.linear_solver.type: direct or automatic");
  }
  const bool is_large =
      !worth_of_multigrid(*body.family(boundary.mirrored()), points_worth_multigrid(D)).empty();
  if (choice.kind == Kind::multigrid ||
      (choice.kind == Kind::automatic && is_large && obstacle.empty())) {
    return std::make_unique<IteratedStiffness<D>>(body, std::move(elastic), boundary,
                                                  std::move(free_unknowns), choice.tolerance);
  }
  const std::string why = choice.kind == Kind::direct ? "as the scene says"
                          : is_large                  ? obstacle
                                                      : "few points";
  return std::make_unique<DirectStiffness<D>>(std::move(elastic), std::move(free_unknowns), why);
}

template std::unique_ptr<StiffnessSolver<2>> make_stiffness_solver(
    const Body<2>&, std::shared_ptr<ElasticOperator<2>>, const SolidBoundary<2>&,
    Eigen::SparseMatrix<double>, const SolverChoice&);
template std::unique_ptr<StiffnessSolver<3>> make_stiffness_solver(
    const Body<3>&, std::shared_ptr<ElasticOperator<3>>, const SolidBoundary<3>&,
    Eigen::SparseMatrix<double>, const SolverChoice&);

}  // namespace perifrac
