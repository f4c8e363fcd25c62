#include "modules/solid/quasi_static_solid.hpp"

#include <algorithm>
#include <limits>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/profile/profile.hpp"
#include "core/solvers/not_converged.hpp"
#include "modules/solid/boundary/rigid_motion.hpp"
#include "modules/solid/equilibrium/newton_solver.hpp"
#include "modules/solid/material/nonlinear_response.hpp"
#include "modules/solid/memory_ports.hpp"
#include "modules/solid/whole_solid.hpp"

namespace perifrac {

namespace {

/// The first unknown that a free one moves.
Index first_row(const Eigen::SparseMatrix<double>& free_unknowns, Index column) {
  return static_cast<Index>(
      Eigen::SparseMatrix<double>::InnerIterator(free_unknowns, column).row());
}

}  // namespace

template <int D>
QuasiStaticSolid<D>::QuasiStaticSolid(std::shared_ptr<const Body<D>> body,
                                      std::shared_ptr<ElasticOperator<D>> elastic,
                                      const SolidBoundary<D>& boundary, const SolverChoice& choice)
    : body_(std::move(body)), elastic_(std::move(elastic)), memory_(with_memory(*elastic_)) {
  const ProfileScope profiled("assembly");
  const auto mirror = boundary.mirror_condition(*body_->family(boundary.mirrored()));
  const Eigen::SparseMatrix<double> free_unknowns = boundary.free_unknowns(mirror);
  solver_ = make_stiffness_solver<D>(*body_, elastic_, boundary, free_unknowns, choice);
  if (elastic_->nonlinear() != nullptr) {
    solver_ = std::make_unique<NewtonSolver<D>>(elastic_, std::move(solver_));
  }
  for (const auto& [face, column] : boundary.plates(mirror)) {
    plates_.emplace_back(face, first_row(free_unknowns, column));
  }
  std::vector<bool> is_free(free_unknowns.rows(), false);
  for (Eigen::Index k = 0; k < free_unknowns.nonZeros(); ++k) {
    is_free[free_unknowns.innerIndexPtr()[k]] = true;
  }
  for (Index k = 0; k < elastic_->size(); ++k) {
    if (!is_free[k]) held_.push_back(k);
  }
  prescribed_ = boundary.prescribed(mirror);
  load_ = boundary.loads(
      mirror, [this](const Eigen::VectorXd& stress) { return elastic_->force_of_stress(stress); });
  for (Index i = 0; i < body_->points().size(); ++i) {
    slope_.push_back(elastic_->pore_sign() / elastic_->drained_bulk_modulus(i));
  }
  free_motion_ = find_free_motion(free_unknowns);
  make_ports();
}

template <int D>
std::string QuasiStaticSolid<D>::find_free_motion(
    const Eigen::SparseMatrix<double>& free_unknowns) const {
  std::vector<double> unknowns(elastic_->size()), force(elastic_->size());
  return rigid_motion_without_energy<D>(
      body_->points(),
      [&](const Eigen::VectorXd& free) -> Eigen::VectorXd {
        view(unknowns) = free_unknowns * free;
        elastic_->apply_stiffness(unknowns, force);
        return free_unknowns.transpose() * view(force);
      },
      free_unknowns, static_cast<Eigen::Index>(plates_.size()));
}

template <int D>
void QuasiStaticSolid<D>::make_ports() {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = body_->points().size();
  ports_.in(
      {"pore_stress", "Pa"}, [this, count] { pore_stress_.resize(count); },
      [this, points] {
        return PortView{points, pore_stress_};
      });
  ports_.in(
      InterfaceForce::port(D), [this, count] { interface_.connect(D * count); },
      [this, points] {
        return PortView{points, interface_.impulse()};
      });
  ports_.out({.name = "displacement", .unit = "m", .components = D}, [this, points, count] {
    return PortView{points, std::span(unknowns_).first(D * count)};
  });
  ports_.out({.name = "dilatation", .unit = "1", .negligible = negligible_strain}, [this, points] {
    return PortView{points, dilatation_, {}, slope_};
  });
  ports_.found({.name = "effective_stress", .unit = "Pa", .components = D * D}, *points,
               [this](std::vector<double>& stress) { find_effective_stress(stress); });
  ports_.total(total_port("elastic_energy", "J", PortRole::energy_stored, D), whole_solid,
               [this] { return elastic_energy_; });
  ports_.total(total_port("external_work", "J", PortRole::energy_gained, D), whole_solid,
               [this] { return external_work_; });
  if (memory_ != nullptr) add_memory_ports(*memory_, *points, D, ports_);
  for (const auto& [face, unknown] : plates_) {
    ports_.total({face + "_plate_displacement", "m"}, whole_solid,
                 [this, unknown = unknown] { return unknowns_[unknown]; });
  }
}

template <int D>
void QuasiStaticSolid<D>::find_effective_stress(std::vector<double>& stress) const {
  stress.resize(D * D * body_->points().volume.size());
  elastic_->stress(unknowns_, stress);
  for (std::size_t i = 0; i < pore_stress_at_rest_.size(); ++i) {
    for (std::size_t a = 0; a < D; ++a) {
      stress[(a * D + a) * pore_stress_at_rest_.size() + i] += pore_stress_at_rest_[i];
    }
  }
}

template <int D>
void QuasiStaticSolid<D>::initialize(double) {
  solver_->prepare();
  unknowns_.assign(elastic_->size(), 0.0);
  force_.assign(elastic_->size(), 0.0);
  external_work_ = 0.0;
  if (memory_ != nullptr) memory_->forget();
  derive_from_unknowns();
}

template <int D>
double QuasiStaticSolid<D>::stable_time_step() const {
  return std::numeric_limits<double>::infinity();
}

template <int D>
double QuasiStaticSolid<D>::advance(const TimeWindow& window) {
  const Eigen::VectorXd before = view(unknowns_);
  const Eigen::VectorXd force_before = view(force_);
  const Eigen::VectorXd pore = pore_force();
  Eigen::VectorXd load = pore;
  load += load_.at(window.end);
  interface_.begin(window);
  load.head(std::ssize(interface_.force())) += view(interface_.force());
  prescribe(window);
  Eigen::VectorXd unknowns = view(unknowns_);
  try {
    solver_->solve(load, view(inner_force_), unknowns);
  } catch (const NotConverged& error) {
    throw NumericalError("displacement", "the whole body", window.end, error.what());
  } catch (const NoEquilibrium& error) {
    throw NumericalError("displacement", "the whole body", window.end, error.what());
  }
  view(unknowns_) = unknowns;

  external_work_ -= work_at_rest();
  derive_from_unknowns();
  external_work_ += work_at_rest();
  view(force_) = view(inner_force_) - pore;
  external_work_ += 0.5 * (force_before + view(force_)).dot(view(unknowns_) - before);
  if (memory_ != nullptr) {  // it follows to where the next window starts
    memory_->follow(unknowns_, window.length());
    derive_from_unknowns();
  }
  return window.end;
}

/// What the solver starts from: the displacements that are prescribed at the window's end, and of
/// the others the last answer or, in a window of no length, which must not know of it, none.
template <int D>
void QuasiStaticSolid<D>::prescribe(const TimeWindow& window) {
  const Eigen::VectorXd prescribed = prescribed_.at(window.end);
  if (!solver_->goes_on() || window.length() == 0.0) {
    std::ranges::fill(unknowns_, 0.0);
    std::ranges::fill(inner_force_, 0.0);
  }
  bool moved = false;
  for (const Index k : held_) {
    moved = moved || unknowns_[k] != prescribed[k];
    unknowns_[k] = prescribed[k];
  }
  if (moved) elastic_->respond(unknowns_, inner_force_);
}

/// What the pore stress beyond that at rest does to all unknowns [N].
template <int D>
Eigen::VectorXd QuasiStaticSolid<D>::pore_force() const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(elastic_->size());
  if (pore_stress_.empty()) return force;
  Eigen::VectorXd stress = view(pore_stress_);
  if (!pore_stress_at_rest_.empty()) stress -= view(pore_stress_at_rest_);
  elastic_->add_pore_force(view(std::as_const(stress)), view(force));
  return force;
}

/// What bears the pore stress at rest from outside has done since the start, as the pores swelled.
template <int D>
double QuasiStaticSolid<D>::work_at_rest() const {
  if (pore_stress_at_rest_.empty()) return 0.0;
  return -view(pore_stress_at_rest_)
              .cwiseProduct(view(body_->points().volume))
              .dot(view(dilatation_));
}

template <int D>
void QuasiStaticSolid<D>::derive_from_unknowns() {
  dilatation_.resize(slope_.size());
  inner_force_.resize(unknowns_.size());
  elastic_->respond(unknowns_, inner_force_, dilatation_);
  elastic_energy_ = elastic_->energy(unknowns_, inner_force_);
}

template <int D>
void QuasiStaticSolid<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("displacement", unknowns_);
  visitor.visit("external_force", force_);
  visitor.visit("external_work", external_work_);
  if (memory_ != nullptr) memory_->visit_state(visitor);
  interface_.visit_state(visitor);
}

template <int D>
void QuasiStaticSolid<D>::on_restored(double) {
  derive_from_unknowns();
}

template class QuasiStaticSolid<2>;
template class QuasiStaticSolid<3>;

}  // namespace perifrac
