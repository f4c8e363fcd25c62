#include "modules/solid/quasi_static_solid.hpp"

#include <limits>

#include <Eigen/Dense>

#include "core/base/eigen_view.hpp"
#include "core/profile/profile.hpp"
#include "modules/solid/boundary/rigid_motion.hpp"
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
                                      const SolidBoundary<D>& boundary)
    : body_(std::move(body)), elastic_(std::move(elastic)) {
  const ProfileScope profiled("assembly");
  const auto mirror = boundary.mirror_condition(*body_->family(boundary.mirrored()));
  stiffness_ = elastic_->assemble();
  dilatation_of_ = elastic_->dilatation_matrix();
  free_unknowns_ = boundary.free_unknowns(mirror);
  for (const auto& [face, column] : boundary.plates(mirror)) {
    plates_.emplace_back(face, first_row(free_unknowns_, column));
  }
  prescribed_ = boundary.prescribed(mirror);
  const Eigen::SparseMatrix<double> equations = free_unknowns_.transpose();
  load_ = ScheduledVector(equations.rows());
  load_.add(equations, boundary.loads(mirror, elastic_->transposed_gradient()));
  load_.add(-equations * stiffness_, prescribed_);
  for (Index i = 0; i < body_->points().size(); ++i) {
    slope_.push_back(elastic_->pore_sign() / elastic_->drained_bulk_modulus(i));
  }
  make_ports();
}

template <int D>
Eigen::SparseMatrix<double> QuasiStaticSolid<D>::free_stiffness() const {
  return free_unknowns_.transpose() * stiffness_ * free_unknowns_;
}

template <int D>
std::string QuasiStaticSolid<D>::free_motion() const {
  return rigid_motion_without_energy<D>(body_->points(), free_stiffness(), free_unknowns_,
                                        plates_.size());
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
  factor_.factor(free_stiffness());
  unknowns_.assign(stiffness_.rows(), 0.0);
  force_.assign(stiffness_.rows(), 0.0);
  external_work_ = 0.0;
  derive_from_unknowns();
}

template <int D>
double QuasiStaticSolid<D>::stable_time_step() const {
  return std::numeric_limits<double>::infinity();
}

template <int D>
double QuasiStaticSolid<D>::advance(const TimeWindow& window) {
  const Eigen::VectorXd pore = pore_force();
  Eigen::VectorXd load(free_unknowns_.cols()), solution(free_unknowns_.cols());
  load_.at(window.end, load);
  interface_.begin(window);
  if (interface_.is_linked()) load += free_unknowns_.transpose() * interface_force();
  factor_.solve(load + free_unknowns_.transpose() * pore, solution);

  const Eigen::VectorXd before = view(unknowns_);
  const Eigen::VectorXd force_before = view(force_);
  Eigen::VectorXd prescribed(before.size());
  prescribed_.at(window.end, prescribed);
  view(unknowns_) = prescribed + free_unknowns_ * solution;
  view(force_) = stiffness_ * view(unknowns_) - pore;
  external_work_ += 0.5 * (force_before + view(force_)).dot(view(unknowns_) - before);
  external_work_ -= work_at_rest();
  derive_from_unknowns();
  external_work_ += work_at_rest();
  return window.end;
}

/// What the pore stress beyond that at rest does to all unknowns: the transpose of what makes
/// dilatation of them.
template <int D>
Eigen::VectorXd QuasiStaticSolid<D>::pore_force() const {
  if (pore_stress_.empty()) return Eigen::VectorXd::Zero(stiffness_.rows());
  Eigen::VectorXd stress = view(pore_stress_);
  if (!pore_stress_at_rest_.empty()) stress -= view(pore_stress_at_rest_);
  return elastic_->pore_sign() * dilatation_of_.transpose() *
         view(body_->points().volume).cwiseProduct(stress);
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
Eigen::VectorXd QuasiStaticSolid<D>::interface_force() const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(stiffness_.rows());
  force.head(interface_.force().size()) = view(interface_.force());
  return force;
}

template <int D>
void QuasiStaticSolid<D>::derive_from_unknowns() {
  dilatation_.resize(body_->points().volume.size());
  view(dilatation_) = dilatation_of_ * view(unknowns_);
  elastic_energy_ = 0.5 * view(unknowns_).dot(stiffness_ * view(unknowns_));
}

template <int D>
void QuasiStaticSolid<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("displacement", unknowns_);
  visitor.visit("external_force", force_);
  visitor.visit("external_work", external_work_);
  interface_.visit_state(visitor);
}

template <int D>
void QuasiStaticSolid<D>::on_restored(double) {
  derive_from_unknowns();
}

template class QuasiStaticSolid<2>;
template class QuasiStaticSolid<3>;

}  // namespace perifrac
