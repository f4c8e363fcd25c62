#include "modules/solid/fracturing_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.hpp"
#include "core/solvers/complementarity.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/boundary/rigid_motion.hpp"
#include "modules/solid/fracture/loose_piece.hpp"

namespace perifrac {

namespace {

Eigen::Map<const Eigen::VectorXd> view(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

Eigen::Map<Eigen::VectorXd> view(std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

template <int D>
std::string FracturingSolid<D>::free_motion() {
  return rigid_motion_without_energy<D>(body_->points(), cracked_.free_stiffness(), free_unknowns_,
                                        plate_unknowns_.size());
}

/// The point that this one of what is solved for moves.
template <int D>
Index FracturingSolid<D>::point_of(Eigen::Index free) const {
  const Index unknown = Eigen::SparseMatrix<double>::InnerIterator(free_unknowns_, free).row();
  return unknown % body_->points().size();
}

template <int D>
std::string FracturingSolid<D>::place_of(Eigen::Index free) const {
  return describe_point(point_of(free), body_->points().at(point_of(free)));
}

template <int D>
BodyError FracturingSolid<D>::loose_piece(const std::string& piece) const {
  return {"its cracks leave " + piece,
          "cracks that leave every piece held by a face or by solid.pins, some points thick"};
}

template <int D>
void FracturingSolid<D>::initialize(double t) {
  window_end_ = last_growth_ = t;
  if (const auto loose = cracked_.loose_pieces(); !loose.empty()) {
    throw loose_piece(describe_piece<D>(cracked_.family(), loose.front()) +
                      ", which nothing holds");
  }
  try {
    cracked_.start();
  } catch (const NotPositiveDefinite& error) {
    throw loose_piece("a piece that is too thin to bear anything, at " + place_of(error.row()));
  }
  tips_.start(seeds_, t);
  load_is_current_ = !is_steady();
  unknowns_.assign(free_unknowns_.rows(), 0.0);
  unknowns_before_ = force_ = unknowns_;
  external_work_ = spent_energy_ = radiated_energy_ = 0.0;
  readiness_before_ = nucleus_before_ = 0.0;
  load_work_ = relief_work_ = elastic_energy_ = 0.0;
  has_begun_ = 0;
  const auto facets = static_cast<Eigen::Index>(seeds_.size());
  faces_ = {Eigen::VectorXd::Zero(facets), Eigen::VectorXd::Zero(facets),
            std::vector<bool>(seeds_.size(), false)};
  if constexpr (D == 2) {
    if (friction_) friction_->start(cracked_);
  }
  unknowns_are_current_ = true;
  derived_ = false;
}

template <int D>
double FracturingSolid<D>::stable_time_step() const {
  return std::numeric_limits<double>::infinity();
}

template <int D>
double FracturingSolid<D>::advance(const TimeWindow& window) {
  window_end_ = window.end;
  interface_.begin(window);
  solve_faces();
  return window.end;
}

/// The pore stress that loads the rock: what is beyond that of the body at rest.
template <int D>
std::span<const double> FracturingSolid<D>::added_pore_stress() {
  if (pore_stress_.empty() || pore_stress_at_rest_.empty()) return pore_stress_;
  added_pore_stress_.resize(pore_stress_.size());
  view(added_pore_stress_) = view(pore_stress_) - view(pore_stress_at_rest_);
  return added_pore_stress_;
}

/// What presses and pulls at the window's end on all that is solved for, the cracks' faces apart.
template <int D>
Eigen::VectorXd FracturingSolid<D>::find_load() {
  Eigen::VectorXd all = load_.at(window_end_);
  if (prescribes_) {
    const Eigen::VectorXd prescribed = prescribed_.at(window_end_);
    Eigen::VectorXd force(all.size());
    std::vector<double> scratch(body_->points().size());
    cracked_.elastic().apply({prescribed.data(), static_cast<std::size_t>(prescribed.size())}, {},
                             {force.data(), static_cast<std::size_t>(force.size())}, scratch);
    all -= force;
  }
  if (interface_.is_linked() && !interface_.force().empty()) {
    all.head(interface_.force().size()) += view(interface_.force());
  }
  if (!pore_stress_.empty()) {
    const std::vector<double> rest(all.size(), 0.0);
    std::vector<double> force(all.size()), scratch(body_->points().size());
    cracked_.elastic().apply(rest, {added_pore_stress()}, force, scratch);
    all -= view(force);
  }
  return free_unknowns_.transpose() * all;
}

/// The pressure of what is in the cracks; a new facet is dry.
template <int D>
Eigen::VectorXd FracturingSolid<D>::in_cracks() {
  const auto count = static_cast<Eigen::Index>(bonds_.facet_points().count);
  if (!wet()) return Eigen::VectorXd::Zero(count);
  crack_pressure_.resize(count, 0.0);
  return view(crack_pressure_);
}

/// A load that a restored state brings is found when it is asked for: most windows bring another.
template <int D>
void FracturingSolid<D>::take_load() {
  if (!load_is_current_) cracked_.set_load(find_load());
  load_is_current_ = true;
}

template <int D>
void FracturingSolid<D>::solve_faces() {
  load_is_current_ = load_is_current_ && is_steady();
  take_load();
  try {
    if constexpr (D == 2) {
      if (friction_) faces_ = friction_->faces(cracked_, in_cracks(), window_end_);
    }
    if (!friction_) faces_ = cracked_.faces(in_cracks());
  } catch (const NoContact& error) {
    throw NumericalError("crack_opening", "the faces of the cracks", window_end_, error.what());
  }
  unknowns_are_current_ = false;
}

template <int D>
void FracturingSolid<D>::find_unknowns() {
  if (unknowns_are_current_) return;
  take_load();
  view(unknowns_) = prescribed_.at(window_end_) + cracked_.unknowns(faces_.pressure, faces_.shear);
  unknowns_are_current_ = true;
  derived_ = false;
}

/// Those named of an array of all, which the next call may write to again. All are found where the
/// books ask for them anyway; else never taken from all, though these may be known: another way
/// rounds otherwise, and who looks on would decide it.
template <int D>
std::span<const double> FracturingSolid<D>::find_unknowns(const UnknownNames& names) {
  if (!is_steady()) {
    find_unknowns();
    return unknowns_;
  }
  const std::vector<Index> named = names();
  take_load();
  some_unknowns_.resize(unknowns_.size());
  cracked_.find_unknowns(faces_.pressure, named, some_unknowns_, faces_.shear);
  if (prescribes_) {
    const Eigen::VectorXd prescribed = prescribed_.at(window_end_);
    for (const Index unknown : named) some_unknowns_[unknown] += prescribed[unknown];
  }
  return some_unknowns_;
}

template <int D>
void FracturingSolid<D>::derive() {
  find_unknowns();
  if (derived_) return;
  std::vector<double> force(unknowns_.size());
  dilatation_.resize(body_->points().size());
  cracked_.elastic().apply(unknowns_, {}, force, dilatation_);
  if (!is_steady()) elastic_energy_ = 0.5 * view(unknowns_).dot(view(force));
  if (!is_steady() && friction_) elastic_energy_ += friction_->elastic_energy();
  derived_ = true;
}

/// Work since the last time; that of the fluid in the cracks is the fluid's, and contact does none.
/// What comes on at once at the start does half of it: a body in equilibrium has no kinetic energy.
template <int D>
void FracturingSolid<D>::book_work() {
  if constexpr (D == 2) {
    if (friction_) friction_->book(cracked_, faces_, in_cracks());
    derived_ = derived_ && !friction_;  // what is elastic holds friction's part
  }
  if (is_steady()) {
    const auto energies = cracked_.energies(faces_.pressure, faces_.shear);
    const double share = has_begun_ == 0 ? 0.5 : 1.0;
    external_work_ += share * (energies.load - load_work_ + energies.relief - relief_work_);
    // Faces begin to slide once half, and more, has come on.
    if (has_begun_ == 0 && friction_) external_work_ += 0.5 * friction_->dissipation();
    has_begun_ = 1;
    load_work_ = energies.load;
    relief_work_ = energies.relief;
    elastic_energy_ = energies.elastic + (friction_ ? friction_->elastic_energy() : 0.0);
    return;
  }
  find_unknowns();
  std::vector<double> force(unknowns_.size()), scratch(body_->points().size());
  cracked_.elastic().apply(unknowns_, {added_pore_stress()}, force, scratch);
  view(force) -= cracked_.face_force(faces_.pressure, true, faces_.shear);
  double relief = 0.0;
  for (Index f = 0; f < static_cast<Index>(cracked_.jumps().size()); ++f) {
    const Vector<D> stress = cracked_.relief(f), jump = cracked_.jump(f, unknowns_);
    double sum = 0.0;
    for (int a = 0; a < D; ++a) sum += stress[a] * jump[a];
    relief += cracked_.jumps()[f].area * sum;
  }
  // Likewise, what bears the pore stress at rest from outside.
  for (std::size_t i = 0; i < pore_stress_at_rest_.size(); ++i) {
    relief -= pore_stress_at_rest_[i] * scratch[i] * body_->points().volume[i];
  }
  external_work_ +=
      0.5 * (view(force_) + view(force)).dot(view(unknowns_) - view(unknowns_before_)) +
      (has_begun_ == 0 ? 0.5 : 1.0) * (relief - relief_work_);
  has_begun_ = 1;
  relief_work_ = relief;
  force_ = force;
  unknowns_before_ = unknowns_;
}

template <int D>
CrackState<D> FracturingSolid<D>::crack_state() {
  return {.t = window_end_,
          .opening = faces_.opening,
          .pressure = faces_.pressure,
          .viscosity = crack_viscosity_,
          .leak_off = crack_leak_off_,
          .pore_stress = added_pore_stress(),
          .unknowns = [this](const UnknownNames& named) { return find_unknowns(named); },
          .jumps = [this] { return cracked_.jumps_under(faces_.pressure, faces_.shear); },
          .shear = faces_.shear};
}

template <int D>
void FracturingSolid<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("pore_stress", pore_stress_);  // says whether the rest is steady
  visitor.visit("has_begun", has_begun_);
  visitor.visit("relief_work", relief_work_);
  if (is_steady()) {
    visitor.visit("load_work", load_work_);
    visitor.visit("elastic_energy", elastic_energy_);
  } else {
    visitor.visit("displacement", unknowns_before_);
    visitor.visit("external_force", force_);
  }
  // A link reads it anew with the opening where facets were added at the end of a window.
  visitor.visit("crack_pressure", crack_pressure_);
  visitor.visit("external_work", external_work_);
  visitor.visit("fracture_energy", spent_energy_);
  visitor.visit("radiated_energy", radiated_energy_);
  visitor.visit("readiness", readiness_before_);
  visitor.visit("last_growth", last_growth_);
  if (nucleation_) visitor.visit("nucleus_readiness", nucleus_before_);
  std::vector<double> opening(faces_.opening.begin(), faces_.opening.end());
  std::vector<double> pressure(faces_.pressure.begin(), faces_.pressure.end());
  std::vector<std::int64_t> closed(faces_.closed.begin(), faces_.closed.end());
  visitor.visit("crack_opening", opening);
  visitor.visit("face_pressure", pressure);
  visitor.visit("closed_faces", closed);
  faces_.opening = view(opening);
  faces_.pressure = view(pressure);
  faces_.closed.assign(closed.begin(), closed.end());
  if (friction_) {
    visitor.visit("face_shear", faces_.shear);
    friction_->visit_state(visitor);
  }
  tips_.visit_state(visitor);
  bonds_.visit_state(visitor);
  interface_.visit_state(visitor);
}

template <int D>
void FracturingSolid<D>::on_restored(double t) {
  window_end_ = t;
  cracked_.follow_bonds();
  derived_ = false;
  unknowns_are_current_ = !is_steady();
  load_is_current_ = false;
  if (!is_steady()) unknowns_ = unknowns_before_;
}

template class FracturingSolid<2>;
template class FracturingSolid<3>;

}  // namespace perifrac
