#include "modules/solid/equilibrium/iterated_body.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/base/digest.hpp"
#include "core/base/eigen_view.hpp"
#include "core/base/require.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/profile/profile.hpp"
#include "core/solvers/complementarity.hpp"

namespace perifrac {

namespace {

/// Of the body's tolerance: answers to even tractions are for slopes and for ratios.
constexpr double even_tolerance = 10.0;

/// Contact is found where openings change by no more than so many times the tolerance.
constexpr double contact_tolerance = 3.0;
constexpr int most_contact_solves = 40;

}  // namespace

template <int D>
IteratedBody<D>::IteratedBody(const Body<D>& body, const SolidBoundary<D>& boundary,
                              std::shared_ptr<Family<D>> family,
                              std::shared_ptr<BreakableElasticity<D>> elastic,
                              Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
                              std::optional<InitialStress<D>> initial_stress,
                              std::vector<CrackFacet<D>> seeds, double tolerance, std::string why)
    : CrackedBody<D>(std::move(family), body.spacing(), std::move(elastic),
                     std::move(free_unknowns), bonds, std::move(initial_stress), std::move(seeds)),
      body_(body),
      boundary_(boundary),
      tolerance_(tolerance),
      why_(why.empty() ? why : ": " + why),
      load_(Eigen::VectorXd::Zero(free_unknowns_.rows())) {
  for (std::size_t f = 0; f < body_.faces().size(); ++f) {
    const Face& face = body_.faces()[f];
    if (!contains(boundary_.mirrored(), static_cast<int>(f)) || face.curved()) continue;
    planes_.push_back({face.axis, face.coordinate});
  }
}

template <int D>
std::string IteratedBody<D>::path() const {
  return "multigrid" + why_ + ", " + elastic_->path() + "; cracks go on by whole facets";
}

template <int D>
void IteratedBody<D>::start() {
  rebuild();
  const auto count = static_cast<Eigen::Index>(facet_count());
  answer_ = {Eigen::VectorXd::Zero(free_unknowns_.rows()), Eigen::VectorXd::Zero(count),
             Eigen::VectorXd::Zero(count)};
  even_.clear();
  learned_.clear();
  concluded_ = {};
}

template <int D>
void IteratedBody<D>::rebuild() {
  multigrid_.emplace(body_, elastic_, boundary_, free_unknowns_);
  jumps_.clear();
  pressed_.clear();
  for (const CrackFacet<D>& seed : seeds_) {
    this->add_jump(face_jump<D>(seed, intact_, spacing_, longest_));
    multigrid_->cut(seed);
  }
  multigrid_->find_largest();
  slope_.resize(0, 0);
  aside_ = {};
}

template <int D>
bool IteratedBody<D>::cut(const CrackFacet<D>& facet) {
  const ProfileScope profiled("cuts");
  const auto bonds = bonds_cut_by<D>(facet, *family_, longest_);
  if (bonds.empty()) return false;
  const FaceJump<D> jump = face_jump<D>(facet, intact_, spacing_, longest_);
  this->break_bonds(bonds);
  try {
    this->check_pieces(bonds);
  } catch (...) {
    this->heal_bonds(bonds);
    throw;
  }
  bonds_.add_facet(facet, bonds);
  followed_ = bonds_.version();
  this->add_jump(jump);
  multigrid_->cut(facet);
  return true;
}

template <int D>
void IteratedBody<D>::set_load(const Eigen::VectorXd& load) {
  require(load.size() == free_unknowns_.cols(), "a load on other unknowns than the body has");
  load_ = free_unknowns_ * load;
  Digest digest;
  digest.add(load_);
  load_digest_ = digest.value();
}

template <int D>
bool IteratedBody<D>::is_of_this_body(const auto& answer) const {
  return answer.facets == facet_count() && answer.load == load_digest_;
}

template <int D>
bool IteratedBody<D>::is_of(const auto& answer, const Eigen::VectorXd& pressure) const {
  return is_of_this_body(answer) && answer.pressure == pressure;
}

/// Goes on from `move` until what is left over is small beside the force.
template <int D>
void IteratedBody<D>::solve(const Eigen::VectorXd& force, double tolerance, Eigen::VectorXd& move) {
  Eigen::VectorXd residual = force;
  multigrid_->hold(residual);
  const double target = tolerance * residual.norm();
  if (target == 0.0) {
    move.setZero();
    return;
  }
  std::vector<double> inner(move.size());
  elastic_->apply_stiffness(view(std::as_const(move)), inner);
  residual -= view(std::as_const(inner));
  iterations_ += multigrid_->correct(residual, move, target);
}

template <int D>
void IteratedBody<D>::solve(Answer& answer, const Eigen::VectorXd& pressure) {
  solve(load_ + this->face_force(pressure), tolerance_, answer.move);
  answer.pressure = pressure;
  answer.facets = facet_count();
  answer.load = load_digest_;
}

/// The last answer where it is that; else one beside it, so that who looks on changes nothing.
template <int D>
auto IteratedBody<D>::at(const Eigen::VectorXd& pressure, std::span<const double> shear)
    -> const Answer& {
  const bool is_sheared = std::ranges::any_of(shear, [](double s) { return s != 0.0; });
  if (!is_sheared && is_of(answer_, pressure)) return answer_;
  if (!is_sheared && is_of(aside_, pressure)) return aside_;
  aside_ = answer_;
  solve(load_ + this->face_force(pressure, true, shear), tolerance_, aside_.move);
  aside_.pressure = pressure;
  aside_.facets = is_sheared ? -1 : facet_count();
  aside_.load = load_digest_;
  return aside_;
}

template <int D>
Vector<D> IteratedBody<D>::jump_of(std::size_t f, const Answer& answer) const {
  const auto facet = static_cast<Index>(f);
  Vector<D> jump = this->jump(facet, view(answer.move));
  jump[0] += pressed_[f] * this->face_load(f, answer.pressure[facet], {})[0];
  return jump;
}

template <int D>
Eigen::VectorXd IteratedBody<D>::openings(const Answer& answer) const {
  Eigen::VectorXd opening(answer.pressure.size());
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    opening[static_cast<Eigen::Index>(f)] = jump_of(f, answer)[0];
  }
  return opening;
}

/// Faces that touched go on to press on each other as they did, fluid and all; new ones as the rock
/// did before.
template <int D>
Eigen::VectorXd IteratedBody<D>::first_contact(const Eigen::VectorXd& pressure) const {
  Eigen::VectorXd contact = Eigen::VectorXd::Zero(pressure.size());
  for (Eigen::Index f = 0; f < pressure.size(); ++f) {
    const bool is_new = f >= answer_.contact.size();
    if (!is_new && answer_.contact[f] == 0.0) continue;
    const double before = is_new ? -this->relief(static_cast<Index>(f))[0] : answer_.pressure[f];
    contact[f] = std::max(0.0, before - pressure[f]);
  }
  return contact;
}

/// Of a change of pressure and openings. What it opens in the rock beside the faces is known.
template <int D>
void IteratedBody<D>::learn(const Eigen::VectorXd& pressure, const Eigen::VectorXd& opening) {
  if (learned_.size() != facet_count()) return;
  const auto pressed = Eigen::Map<const Eigen::VectorXd>(pressed_.data(), pressure.size());
  learned_.learn(pressure, opening - pressed.cwiseProduct(pressure));
}

/// As far as answers have shown it.
template <int D>
Eigen::MatrixXd IteratedBody<D>::known_slope() const {
  Eigen::MatrixXd slope = learned_.matrix();
  slope.diagonal() += Eigen::Map<const Eigen::VectorXd>(pressed_.data(), slope.rows());
  return slope;
}

/// Contact by the slope, which learns from each solve: what it says of a pressure on closed faces
/// is put right until openings agree.
template <int D>
auto IteratedBody<D>::faces(const Eigen::VectorXd& pressure) -> Faces {
  const Eigen::Index count = pressure.size();
  require(count == std::ssize(jumps_), "pressure of other facets than the body has");
  const bool is_foreseen = is_of_this_body(answer_) && learned_.size() == count;
  Eigen::VectorXd& contact = answer_.contact;
  contact = is_foreseen ? foresee(pressure).contact.x : first_contact(pressure);
  Faces faces{Eigen::VectorXd::Zero(count), {}, std::vector<bool>(count, false)};
  for (int tries = 0;; ++tries) {
    faces.pressure = pressure + contact;
    if (!is_of(answer_, faces.pressure)) solve_and_learn(faces.pressure);
    const Eigen::VectorXd opening = openings(answer_);
    faces.opening = opening.cwiseMax(0.0);
    if (count == 0 || (contact.isZero(0.0) && opening.minCoeff() >= 0.0)) return faces;
    ready_slope();
    const Foreseen next = foresee(pressure);
    faces.closed = next.contact.held;
    if (next.change <= contact_tolerance * tolerance_) return faces;
    if (tries == most_contact_solves) throw NoContact("contact is not found by iteration");
    contact = next.contact.x;
  }
}

/// What of a change of pressure is even, has been solved for: the part that leaves least energy.
template <int D>
void IteratedBody<D>::move_evenly(const Eigen::VectorXd& pressure) {
  const EvenAnswer* const known = find_even(-1, 0);
  if (known == nullptr || known->facets != facet_count()) return;
  const auto pressed = Eigen::Map<const Eigen::VectorXd>(pressed_.data(), pressure.size());
  const Eigen::VectorXd work = this->areas().cwiseProduct(openings(*known) - pressed);
  if (work.sum() > 0.0) answer_.move += work.dot(pressure) / work.sum() * known->move;
}

/// By the last answer and the slope.
template <int D>
auto IteratedBody<D>::foresee(const Eigen::VectorXd& pressure) const -> Foreseen {
  const Eigen::MatrixXd slope = known_slope();
  const Eigen::VectorXd off = answer_.pressure - pressure;
  const Eigen::VectorXd free = openings(answer_) - slope * off;
  const double size = std::max(free.lpNorm<Eigen::Infinity>(), 1e-14 * spacing_);
  Complementarity contact = solve_complementarity(slope, free, 1e-14 * spacing_);
  const Eigen::VectorXd change = slope * (contact.x - off);
  return {std::move(contact), change.template lpNorm<Eigen::Infinity>() / size};
}

/// From the last answer; of the same load on the same body, the two say what pressure opens.
template <int D>
void IteratedBody<D>::solve_and_learn(const Eigen::VectorXd& pressure) {
  constexpr double seen = 10.0;  // times what solves leave open
  const bool compares = is_of_this_body(answer_);
  const Eigen::VectorXd pressure_before = answer_.pressure;
  Eigen::VectorXd before;
  if (compares) {
    before = openings(answer_);
    move_evenly(pressure - pressure_before);
  }
  solve(answer_, pressure);
  if (!compares || pressure.size() == 0) return;
  const Eigen::VectorXd after = openings(answer_);
  const double size = after.template lpNorm<Eigen::Infinity>();
  const Eigen::VectorXd change = after - before;
  if (change.template lpNorm<Eigen::Infinity>() > seen * tolerance_ * size) {
    learn(pressure - pressure_before, change);
  }
}

template <int D>
Eigen::VectorXd IteratedBody<D>::free_opening(const Eigen::VectorXd& pressure,
                                              const Eigen::VectorXd& face_pressure) {
  require(pressure.size() == std::ssize(jumps_), "pressure of other facets than the body has");
  if (pressure.size() == 0) return pressure;
  const Eigen::VectorXd& on_faces =
      face_pressure.size() == pressure.size() ? face_pressure : pressure;
  const Eigen::VectorXd opening =
      is_of(concluded_, on_faces) ? concluded_.opening : openings(at(on_faces, {}));
  return opening - opening_slope() * (on_faces - pressure);
}

template <int D>
std::vector<double> IteratedBody<D>::moduli() const {
  std::vector<double> modulus;
  for (const FaceJump<D>& jump : jumps_) {
    double sum = 0.0;
    for (const auto& [point, coefficient] : jump.terms) {
      sum += 0.5 * std::abs(coefficient) * elastic_->law(point).plane_strain_modulus();
    }
    modulus.push_back(sum);
  }
  return modulus;
}

template <int D>
std::vector<Index> IteratedBody<D>::all_faces() const {
  std::vector<Index> all(jumps_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

template <int D>
const Eigen::MatrixXd& IteratedBody<D>::opening_slope() {
  if (slope_.rows() == facet_count()) return slope_;
  ready_slope();
  slope_ = known_slope();
  return slope_;
}

template <int D>
void IteratedBody<D>::renew_slope() {
  if (learned_.size() == facet_count()) slope_ = known_slope();
}

/// Tries of a window all begin here, the answer is by then that of the try before.
template <int D>
void IteratedBody<D>::conclude() {
  renew_slope();
  if (!is_of_this_body(answer_)) return;
  concluded_ = {openings(answer_), answer_.pressure, answer_.facets, answer_.load};
}

/// Facets that come are as in a body without end; what an even pressure does is solved for.
template <int D>
void IteratedBody<D>::ready_slope() {
  if (learned_.size() == facet_count()) return;
  const ProfileScope profiled("slope");
  learned_.extend(pressure_by_opening<D>(bonds_.facets(), moduli(), planes_), this->areas());
  const Eigen::VectorXd opening = openings(evenly_pressed());
  learn(Eigen::VectorXd::Ones(opening.size()), opening);
}

template <int D>
Eigen::MatrixXd IteratedBody<D>::compliance(int jump, int traction) {
  const auto count = static_cast<Eigen::Index>(facet_count());
  Eigen::MatrixXd compliance(count, count);
  Vector<D> along{};
  along[traction] = 1.0;
  for (Index g = 0; g < static_cast<Index>(count); ++g) {
    Eigen::VectorXd move = Eigen::VectorXd::Zero(load_.size());
    solve(this->traction_force(std::array{g}, along), tolerance_, move);
    for (Index f = 0; f < static_cast<Index>(count); ++f) {
      compliance(f, g) = this->jump(f, view(move))[jump];
    }
    if (jump == 0 && traction == 0) compliance(g, g) += pressed_[g];
  }
  return compliance;
}

template <int D>
auto IteratedBody<D>::find_even(std::int64_t first, std::int64_t axis) const -> const EvenAnswer* {
  const auto known = std::ranges::find_if(even_, [&](const EvenAnswer& answer) {
    return answer.first == first && answer.axis == axis;
  });
  return known == even_.end() ? nullptr : &*known;
}

template <int D>
void IteratedBody<D>::solve(EvenAnswer& answer, std::span<const Index> faces) {
  Vector<D> unit{};
  unit[answer.axis] = 1.0;
  solve(this->traction_force(faces, unit), even_tolerance * tolerance_, answer.move);
  answer.facets = facet_count();
}

template <int D>
auto IteratedBody<D>::even(std::span<const Index> faces, std::int64_t axis) -> const EvenAnswer& {
  const std::int64_t first = std::ssize(faces) == facet_count() ? -1 : std::ranges::min(faces);
  const EvenAnswer* known = find_even(first, axis);
  if (known == nullptr) {
    known = &even_.emplace_back(
        EvenAnswer{first, axis, -1, Eigen::VectorXd::Zero(answer_.move.size())});
  }
  EvenAnswer& answer = even_[known - even_.data()];
  if (answer.facets != facet_count()) solve(answer, faces);
  return answer;
}

template <int D>
auto IteratedBody<D>::evenly_pressed() -> const EvenAnswer& {
  return even(all_faces(), 0);
}

/// By a pressure of 1.
template <int D>
Eigen::VectorXd IteratedBody<D>::openings(const EvenAnswer& answer) const {
  Eigen::VectorXd opening(static_cast<Eigen::Index>(facet_count()));
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    const double jump = this->jump(static_cast<Index>(f), view(answer.move))[0];
    opening[static_cast<Eigen::Index>(f)] = jump + pressed_[f];
  }
  return opening;
}

template <int D>
double IteratedBody<D>::intensity_at_fixed_volume(Index facet) {
  const Eigen::VectorXd opening = openings(evenly_pressed());
  return opening[facet] / this->areas().dot(opening);
}

template <int D>
std::optional<double> IteratedBody<D>::find_even_answers(std::span<const Index> faces,
                                                         std::span<const Index> named,
                                                         std::span<double> by_pressure,
                                                         std::span<double> by_shear) {
  const EvenAnswer& pressed = even(faces, 0);
  for (const Index unknown : named) by_pressure[unknown] = pressed.move[unknown];
  double volume = 0.0;
  for (const Index f : faces) {
    volume += jumps_[f].area * (this->jump(f, view(pressed.move))[0] + pressed_[f]);
  }
  const EvenAnswer& sheared = even(faces, 1);
  for (const Index unknown : named) by_shear[unknown] = sheared.move[unknown];
  return volume;
}

template <int D>
std::vector<Vector<D>> IteratedBody<D>::jumps_under(const Eigen::VectorXd& pressure,
                                                    std::span<const double> shear) {
  const Answer& answer = at(pressure, shear);
  std::vector<Vector<D>> jumps;
  for (std::size_t f = 0; f < jumps_.size(); ++f) jumps.push_back(jump_of(f, answer));
  return jumps;
}

template <int D>
Eigen::VectorXd IteratedBody<D>::unknowns(const Eigen::VectorXd& pressure,
                                          std::span<const double> shear) {
  return at(pressure, shear).move;
}

template <int D>
void IteratedBody<D>::find_unknowns(const Eigen::VectorXd& pressure, std::span<const Index> named,
                                    std::span<double> all, std::span<const double> shear) {
  const Answer& answer = at(pressure, shear);
  for (const Index unknown : named) all[unknown] = answer.move[unknown];
}

template <int D>
auto IteratedBody<D>::energies(const Eigen::VectorXd& pressure, std::span<const double> shear)
    -> Energies {
  const Answer& answer = at(pressure, shear);
  Energies energies{};
  energies.load = load_.dot(answer.move);
  energies.elastic =
      0.5 * (energies.load + this->face_force(pressure, true, shear).dot(answer.move));
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    const auto facet = static_cast<Index>(f);
    energies.relief +=
        jumps_[f].area * dot(this->relief(facet), this->jump(facet, view(answer.move)));
  }
  const Energies pressed = this->pressed_energies(pressure);
  energies.elastic += pressed.elastic;
  energies.relief += pressed.relief;
  return energies;
}

template <int D>
Eigen::VectorXd IteratedBody<D>::stiffness_times(const Eigen::VectorXd& x) {
  const Eigen::VectorXd all = free_unknowns_ * x;
  std::vector<double> force(all.size());
  elastic_->apply_stiffness(view(all), force);
  return free_unknowns_.transpose() * view(std::as_const(force));
}

template <int D>
void IteratedBody<D>::visit_state(StateVisitor& visitor, bool load_is_steady) {
  // Where the load changes each pass begins from the same answer: what solves leave open would else
  // differ from pass to pass, and a coupling of many unknowns not come to rest.
  if (visitor.takes_guesses() || !load_is_steady) {
    visitor.visit("answer", answer_.move);
    visitor.visit("answer_pressure", answer_.pressure);
    visitor.visit("answer_contact", answer_.contact);
    visitor.visit("answer_facets", answer_.facets);
    visitor.visit("answer_load", answer_.load);
    visitor.enter("learned");
    learned_.visit_state(visitor);
    visitor.leave();
  }
  visitor.enter("concluded");
  visitor.visit("opening", concluded_.opening);
  visitor.visit("pressure", concluded_.pressure);
  visitor.visit("facets", concluded_.facets);
  visitor.visit("load", concluded_.load);
  visitor.leave();
  std::vector<std::int64_t> keys;
  for (const EvenAnswer& answer : even_) {
    keys.insert(keys.end(), {answer.first, answer.axis, answer.facets});
  }
  visitor.visit("even_keys", keys);
  even_.resize(keys.size() / 3);
  for (std::size_t k = 0; k < even_.size(); ++k) {
    even_[k].first = keys[3 * k];
    even_[k].axis = keys[3 * k + 1];
    even_[k].facets = keys[3 * k + 2];
    visitor.visit(fmt::format("even_answer_{}", k), even_[k].move);
  }
}

template <int D>
void IteratedBody<D>::on_restored() {
  aside_ = {};
  if (answer_.facets > facet_count()) answer_.facets = -1;
  learned_.keep(facet_count());
  if (answer_.move.allFinite() && learned_.is_finite()) return;
  answer_.move.setZero();
  answer_.facets = -1;
  learned_.clear();
}

template class IteratedBody<2>;
template class IteratedBody<3>;

}  // namespace perifrac
