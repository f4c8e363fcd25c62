#include "modules/solid/fracture/crack_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/require.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/solvers/complementarity.hpp"
#include "core/state/visit_each.hpp"
#include "modules/solid/material/stiffness_bound.hpp"

namespace perifrac {

CrackDynamics::CrackDynamics(std::shared_ptr<Family<2>> family, double spacing,
                             std::shared_ptr<BreakableElasticity<2>> elastic, BondState<2>& bonds,
                             std::optional<InitialStress<2>> initial_stress,
                             std::vector<CrackFacet<2>> seeds, double release)
    : CutBody<2>(std::move(family), spacing, std::move(elastic), bonds, initial_stress,
                 std::move(seeds)),
      release_(release) {}

void CrackDynamics::start(ElasticDynamics<2>& system, double t) {
  system_ = &system;
  t_ = t;
  held_.clear();
  relief_work_ = spent_energy_ = contact_loss_ = 0.0;
  for (Eigen::VectorXd* field :
       {&opening_, &sliding_, &pressure_, &contact_, &given_, &given_by_contact_}) {
    field->setZero(static_cast<Eigen::Index>(facets().size()));
  }
  face_force_.assign(2 * static_cast<std::size_t>(family_->point_count), 0.0);
  terms_.clear();
  for (const CrackFacet<2>& facet : facets()) add_facet(facet);
  find_answers();
  stiffest_at_start_ = 0.0;
  for (Index i = 0; i < family_->point_count; ++i) {
    stiffest_at_start_ =
        std::max(stiffest_at_start_, stiffness_bound(*family_, elastic_->law(i), i));
  }
}

/// Faces, tips and corners are among the stiffest points from the start; a crack that goes on
/// straight makes no stiffer ones.
void CrackDynamics::note_stiffness(Index i) {
  growth_ = std::max(growth_, stiffness_bound(*family_, elastic_->law(i), i) / stiffest_at_start_);
}

/// What the motion needs to know of the facet; its jump once.
void CrackDynamics::add_facet(const CrackFacet<2>& facet) {
  const std::size_t f = terms_.size();
  if (f == jumps_.size()) jumps_.push_back(face_jump<2>(facet, intact_, spacing_, longest_));
  std::vector<Term>& terms = terms_.emplace_back();
  for (const auto& [point, coefficient] : jumps_[f].terms) {
    for (int a = 0; a < 2; ++a) {
      const Index unknown = a * family_->point_count + point;
      terms.push_back({unknown, system_->moved_by(unknown), coefficient * jumps_[f].normal[a],
                       coefficient * jumps_[f].tangents[0][a]});
    }
  }
}

void CrackDynamics::find_answers() {
  struct Part {
    Index facet;
    double normal;
  };
  std::map<Index, std::vector<Part>> on;  // by what has a mass
  for (std::size_t f = 0; f < terms_.size(); ++f) {
    for (const Term& term : terms_[f]) {
      if (term.moved >= 0) on[term.moved].push_back({static_cast<Index>(f), term.normal});
    }
  }
  const std::span<const double> mass = system_->mass();
  std::vector<std::map<Index, double>> answers(terms_.size());
  for (const auto& [moved, parts] : on) {
    for (const Part& of : parts) {
      for (const Part& by : parts) {
        answers[of.facet][by.facet] += of.normal * by.normal * jumps_[by.facet].area / mass[moved];
      }
    }
  }
  answers_.clear();
  for (const auto& row : answers) answers_.emplace_back(row.begin(), row.end());
  forecast_.opening.assign(terms_.size(), 0.0);
  forecast_.slope.assign(terms_.size() * terms_.size(), 0.0);
  forecast_.step = -1.0;
}

void CrackDynamics::read_jump(Index f, std::span<const double> u) {
  opening_[f] = sliding_[f] = 0.0;
  for (const Term& term : terms_[f]) {
    opening_[f] += term.normal * u[term.unknown];
    sliding_[f] += term.tangent * u[term.unknown];
  }
}

void CrackDynamics::add(double t, std::span<const double> u, std::span<double> inner) {
  t_ = t;
  hold(t, u, inner);
  add_faces(u, inner);
}

void CrackDynamics::hold(double t, std::span<const double> u, std::span<double> inner) {
  for (Held& held : held_) {
    const double share = std::clamp(1.0 - (t - held.since) / release_, 0.0, 1.0);
    double work = 0.0;
    for (std::size_t k = 0; k < held.unknowns.size(); ++k) {
      const Index unknown = held.unknowns[k];
      work += held.force[k] * (u[unknown] - held.last[k]);
      held.last[k] = u[unknown];
      inner[unknown] -= share * held.force[k];
    }
    spent_energy_ -= 0.5 * (held.share + share) * work;
    held.share = share;
  }
  std::erase_if(held_, [](const Held& held) { return held.share == 0.0; });
}

void CrackDynamics::add_faces(std::span<const double> u, std::span<double> inner) {
  for (std::size_t f = 0; f < terms_.size(); ++f) {
    const auto [normal, tangential] = relief(static_cast<Index>(f));
    const double length = jumps_[f].area;
    const double opening = opening_[f], sliding = sliding_[f];
    read_jump(static_cast<Index>(f), u);
    relief_work_ +=
        length * (normal * (opening_[f] - opening) + tangential * (sliding_[f] - sliding));
    for (const Term& term : terms_[f]) {
      inner[term.unknown] -= length * (normal * term.normal + tangential * term.tangent);
    }
  }
}

void CrackDynamics::foretell(double step, double decay, std::span<const double> velocity,
                             std::span<const double> acceleration) {
  const std::size_t count = terms_.size();
  forecast_.opening.assign(opening_.begin(), opening_.end());
  for (std::size_t f = 0; f < count && step > 0.0; ++f) {
    double change = 0.0;
    for (const Term& term : terms_[f]) {
      if (term.moved < 0) continue;
      change +=
          term.normal * (decay * velocity[term.moved] + 0.5 * step * acceleration[term.moved]);
    }
    for (const auto& [g, answer] : answers_[f]) change -= answer * given_[g];
    forecast_.opening[f] += step * change;
  }
  if (forecast_.step == step) return;
  forecast_.step = step;
  forecast_.slope.assign(count * count, 0.0);
  for (std::size_t f = 0; f < count; ++f) {
    for (const auto& [g, answer] : answers_[f])
      forecast_.slope[f * count + g] = step * step * answer;
  }
}

double CrackDynamics::opening_rate(std::size_t f, std::span<const double> velocity) const {
  double rate = 0.0;
  for (const Term& term : terms_[f]) {
    if (term.moved >= 0) rate += term.normal * velocity[term.moved];
  }
  return rate;
}

void CrackDynamics::press(std::span<const double> pressure) {
  const auto count = static_cast<Eigen::Index>(terms_.size());
  require(pressure.size() == terms_.size() && forecast_.opening.size() == terms_.size() &&
              forecast_.slope.size() == terms_.size() * terms_.size(),
          "pressure of other facets than the body has");
  const Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>> slope(
      forecast_.slope.data(), count, count);
  pressure_ = Eigen::Map<const Eigen::VectorXd>(pressure.data(), count);
  contact_.setZero(count);
  const Eigen::VectorXd free =
      Eigen::Map<const Eigen::VectorXd>(forecast_.opening.data(), count) + slope * pressure_;
  if (free.minCoeff() < 0.0 && slope(0, 0) > 0.0) {
    contact_ = solve_complementarity(slope, free, 1e-14 * spacing_).x;
    pressure_ += contact_;
  }
  for (const auto& terms : terms_) {
    for (const Term& term : terms) face_force_[term.unknown] = 0.0;
  }
  for (std::size_t f = 0; f < terms_.size(); ++f) {
    for (const Term& term : terms_[f]) {
      face_force_[term.unknown] += jumps_[f].area * pressure_[f] * term.normal;
    }
  }
}

void CrackDynamics::begin_step(double step, std::span<double> velocity) {
  strike(step * pressure_ - given_, step * contact_ - given_by_contact_, velocity);
}

void CrackDynamics::end_step(double step, std::span<double> velocity) {
  given_ = 0.5 * step * pressure_;
  given_by_contact_ = 0.5 * step * contact_;
  strike(given_, given_by_contact_, velocity);
}

/// Velocities take an impulse of pressure, of which contact is a part that does work by itself.
void CrackDynamics::strike(const Eigen::VectorXd& impulse, const Eigen::VectorXd& contact,
                           std::span<double> velocity) {
  const auto book = [&] {
    for (std::size_t f = 0; f < terms_.size(); ++f) {
      if (contact[f] == 0.0) continue;
      contact_loss_ -= 0.5 * jumps_[f].area * contact[f] * opening_rate(f, velocity);
    }
  };
  book();
  const std::span<const double> mass = system_->mass();
  for (std::size_t f = 0; f < terms_.size(); ++f) {
    const double total = jumps_[f].area * impulse[f];
    for (const Term& term : terms_[f]) {
      if (term.moved >= 0) velocity[term.moved] += total * term.normal / mass[term.moved];
    }
  }
  book();
}

std::vector<Vector<2>> CrackDynamics::jumps_at(std::span<const double> unknowns) const {
  std::vector<Vector<2>> jumps;
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    jumps.push_back(jump(static_cast<Index>(f), unknowns));
  }
  return jumps;
}

/// K_I falls as length^(-3/2) where the volume stays, in a body that is large beside the crack.
double CrackDynamics::intensity_at_fixed_volume(Index facet) {
  std::set<Vector<2>> ends(facets()[facet].begin(), facets()[facet].end());
  std::vector<bool> is_part(facets().size(), false);
  double length = 0.0;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t f = 0; f < facets().size(); ++f) {
      const CrackFacet<2>& other = facets()[f];
      if (is_part[f] || !(ends.contains(other[0]) || ends.contains(other[1]))) continue;
      ends.insert(other.begin(), other.end());
      is_part[f] = grows = true;
      length += jumps_[f].area;
    }
  }
  return std::pow(length, -1.5);
}

bool CrackDynamics::cut(const CrackFacet<2>& facet) {
  const auto bonds = bonds_cut_by<2>(facet, *family_, longest_);
  if (bonds.empty()) return false;
  std::set<Index> points;
  for (const auto& [i, j] : bonds) points.insert({i, j});
  const std::vector<double>& u = system_->unknowns();
  std::vector<double> before(u.size()), after(u.size());
  system_->find_bond_force(before);
  const DeformedMaterial<2> deformed = elastic_->deform(u);
  for (const Index i : points) spent_energy_ += deformed.energy(i);
  break_bonds(bonds);
  for (const Index i : points) spent_energy_ -= deformed.energy(i);
  for (const Index i : points) note_stiffness(i);
  bonds_.add_facet(facet, bonds);
  followed_ = bonds_.version();
  add_facet(facet);
  system_->find_bond_force(after);

  const Index f = static_cast<Index>(terms_.size()) - 1;
  for (Eigen::VectorXd* field :
       {&opening_, &sliding_, &pressure_, &contact_, &given_, &given_by_contact_}) {
    field->conservativeResize(f + 1);
    (*field)[f] = 0.0;
  }
  read_jump(f, u);
  const auto [normal, tangential] = relief(f);
  const double length = jumps_[f].area;
  const double relieved = length * (normal * opening_[f] + tangential * sliding_[f]);
  relief_work_ += relieved;
  spent_energy_ += relieved;
  for (const Term& term : terms_[f]) {
    after[term.unknown] -= length * (normal * term.normal + tangential * term.tangent);
  }
  Held held{.facet = f, .since = t_, .unknowns = {}, .force = {}, .last = {}};
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (after[k] == before[k]) continue;
    held.unknowns.push_back(static_cast<Index>(k));
    held.force.push_back(after[k] - before[k]);
    held.last.push_back(u[k]);
  }
  held_.push_back(std::move(held));
  return true;
}

void CrackDynamics::visit_state(StateVisitor& visitor) {
  visitor.visit("relief_work", relief_work_);
  visitor.visit("fracture_energy", spent_energy_);
  visitor.visit("contact_loss", contact_loss_);
  visitor.visit("given_impulse", given_);
  visitor.visit("given_contact_impulse", given_by_contact_);
  visit_each(visitor, "held", held_,  //
             FieldOfEach("facet", [](Held& held) -> Index& { return held.facet; }),
             FieldOfEach("since", [](Held& held) -> double& { return held.since; }),
             FieldOfEach("share", [](Held& held) -> double& { return held.share; }),
             FieldOfEach(
                 "unknowns", [](Held & held) -> auto& { return held.unknowns; }),
             FieldOfEach(
                 "force", [](Held & held) -> auto& { return held.force; }),
             FieldOfEach(
                 "displacement", [](Held & held) -> auto& { return held.last; }));
  bonds_.visit_state(visitor);
}

void CrackDynamics::follow_state() {
  if (bonds_.version() == followed_) return;
  followed_ = bonds_.version();
  mend();
  std::vector<std::pair<Index, Index>> broken;
  std::set<Index> points;
  for (const BrokenBond& bond : bonds_.broken()) {
    broken.emplace_back(bond.i, bond.j);
    points.insert({bond.i, bond.j});
  }
  break_bonds(broken);
  growth_ = 1.0;
  for (const Index i : points) note_stiffness(i);
  jumps_.clear();
  terms_.clear();
  for (const CrackFacet<2>& facet : facets()) add_facet(facet);
  find_answers();
}

void CrackDynamics::read_jumps() {
  const auto count = static_cast<Eigen::Index>(terms_.size());
  for (Eigen::VectorXd* field : {&opening_, &sliding_, &pressure_, &contact_})
    field->setZero(count);
  for (Index f = 0; f < count; ++f) read_jump(f, system_->unknowns());
}

}  // namespace perifrac
