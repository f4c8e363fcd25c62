#include "modules/solid/equilibrium/cracked_equilibrium.hpp"

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/solvers/complementarity.hpp"
#include "core/solvers/not_converged.hpp"

namespace perifrac {

template <int D>
CrackedEquilibrium<D>::CrackedEquilibrium(CrackedBody<D>& cracked, CrackedLoad<D>& load,
                                          FluidInCracks& fluid, CrackFriction* friction,
                                          std::optional<InitialStress<D>> initial_stress)
    : cracked_(cracked),
      load_(load),
      fluid_(fluid),
      friction_(friction),
      initial_stress_(std::move(initial_stress)) {}

template <int D>
void CrackedEquilibrium<D>::start(double t) {
  t_ = t;
  load_is_current_ = !load_.is_steady();
  unknowns_.assign(cracked_.free_unknowns().rows(), 0.0);
  unknowns_are_current_ = true;
  derived_ = false;
  const std::size_t facets = cracked_.facets().size();
  const auto none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(facets));
  faces_ = {none, none, std::vector<bool>(facets, false)};
  if constexpr (D == 2) {
    if (friction_ != nullptr) friction_->start(cracked_);
  }
  if (is_wet()) cracked_.ready_slope();
}

template <int D>
void CrackedEquilibrium<D>::solve(double t) {
  t_ = t;
  load_is_current_ = load_is_current_ && load_.is_steady();
  take_load();
  try {
    if (is_wet()) cracked_.ready_slope();
    if constexpr (D == 2) {
      if (friction_ != nullptr) faces_ = friction_->faces(cracked_, pressure_in_cracks(), t_);
    }
    if (friction_ == nullptr) faces_ = cracked_.faces(pressure_in_cracks());
  } catch (const NoContact& error) {
    throw NumericalError("crack_opening", "the faces of the cracks", t_, error.what());
  } catch (const NotConverged& error) {
    throw NumericalError("displacement", "the whole body", t_, error.what());
  }
  unknowns_are_current_ = false;
}

/// A load that a restored state brings is found when it is asked for: most windows bring another.
template <int D>
void CrackedEquilibrium<D>::take_load() {
  if (!load_is_current_) cracked_.set_load(cracked_.free_unknowns().transpose() * load_.force(t_));
  load_is_current_ = true;
}

template <int D>
Eigen::VectorXd CrackedEquilibrium<D>::pressure_in_cracks() {
  const auto count = static_cast<Eigen::Index>(cracked_.facets().size());
  if (!is_wet()) return Eigen::VectorXd::Zero(count);
  return view(fluid_.pressure());
}

template <int D>
Eigen::VectorXd CrackedEquilibrium<D>::free_opening() {
  take_load();
  Eigen::VectorXd opening = cracked_.free_opening(pressure_in_cracks(), faces_.pressure);
  if constexpr (D == 2) {
    if (friction_ != nullptr) opening += friction_->opening_by(cracked_, faces_.shear);
  }
  return opening;
}

template <int D>
std::span<double> CrackedEquilibrium<D>::unknowns() {
  if (unknowns_are_current_) return unknowns_;
  take_load();
  view(unknowns_) = load_.prescribed(t_) + cracked_.unknowns(faces_.pressure, faces_.shear);
  unknowns_are_current_ = true;
  derived_ = false;
  return unknowns_;
}

/// Those named of an array of all, which the next call may write to again. All are found where the
/// books ask for them anyway; else never taken from all, though these may be known: another way
/// rounds otherwise, and who looks on would decide it.
template <int D>
std::span<const double> CrackedEquilibrium<D>::unknowns(const UnknownNames& names) {
  if (!load_.is_steady()) return unknowns();
  const std::vector<Index> named = names();
  take_load();
  some_unknowns_.resize(unknowns_.size());
  cracked_.find_unknowns(faces_.pressure, named, some_unknowns_, faces_.shear);
  return some_unknowns_;
}

template <int D>
void CrackedEquilibrium<D>::derive() {
  unknowns();
  if (derived_) return;
  std::vector<double> force(unknowns_.size());
  dilatation_.resize(load_.points().size());
  cracked_.elastic().apply(unknowns_, {}, force, dilatation_);
  if (!load_.is_steady()) strain_energy_ = 0.5 * view(unknowns_).dot(view(force));
  derived_ = true;
}

template <int D>
std::span<double> CrackedEquilibrium<D>::dilatation() {
  derive();
  return dilatation_;
}

template <int D>
double CrackedEquilibrium<D>::elastic_energy() {
  derive();
  const double sheared = friction_ != nullptr ? friction_->elastic_energy() : 0.0;
  return strain_energy_ + sheared + cracked_.pressed_energies(faces_.pressure).elastic +
         cracked_.held(unknowns_, faces_.pressure, faces_.shear).elastic;
}

template <int D>
std::span<double> CrackedEquilibrium<D>::effective_stress() {
  unknowns();
  const Points<D>& points = load_.points();
  const std::size_t count = points.volume.size();
  const std::span<const double> at_rest = load_.pore_stress_at_rest();
  effective_stress_.resize(D * D * count);
  cracked_.elastic().stress(unknowns_, effective_stress_);
  for (Index i = 0; i < points.size() && initial_stress_; ++i) {
    const Vector<D> there = initial_stress_->at(points.at(i));
    for (std::size_t a = 0; a < D; ++a) {
      double& stress = effective_stress_[(a * D + a) * count + i];
      stress += there[a];
      if (!at_rest.empty()) stress += at_rest[i];
    }
  }
  return effective_stress_;
}

template <int D>
CrackState<D> CrackedEquilibrium<D>::state() {
  return crack_state<D>(
      t_, fluid_, faces_.opening, faces_.pressure, faces_.shear, faces_.slip,
      load_.added_pore_stress(), [this](const UnknownNames& named) { return unknowns(named); },
      [this] { return cracked_.jumps_under(faces_.pressure, faces_.shear); }, {}, 0.0);
}

template <int D>
void CrackedEquilibrium<D>::visit_state(StateVisitor& visitor) {
  std::vector<std::int64_t> closed(faces_.closed.begin(), faces_.closed.end());
  visitor.visit("crack_opening", faces_.opening);
  visitor.visit("face_pressure", faces_.pressure);
  visitor.visit("closed_faces", closed);
  faces_.closed.assign(closed.begin(), closed.end());
  cracked_.visit_state(visitor, load_.is_steady());
  if (friction_ == nullptr) return;
  visitor.visit("face_shear", faces_.shear);
  friction_->visit_state(visitor);
}

template <int D>
void CrackedEquilibrium<D>::on_restored(double t, std::span<const double> displacement) {
  t_ = t;
  cracked_.follow_bonds();
  cracked_.on_restored();
  derived_ = false;
  unknowns_are_current_ = !displacement.empty();
  load_is_current_ = false;
  if (!displacement.empty()) unknowns_.assign(displacement.begin(), displacement.end());
}

template class CrackedEquilibrium<2>;
template class CrackedEquilibrium<3>;

}  // namespace perifrac
