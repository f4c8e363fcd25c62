#include "modules/solid/cracked_body.hpp"

#include <algorithm>
#include <set>

#include <Eigen/Dense>

#include "core/geometry/crack_cut.hpp"
#include "core/solvers/complementarity.hpp"

namespace perifrac {

namespace {

double dot(const std::vector<std::pair<int, double>>& mode, const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (const auto& [place, coefficient] : mode) sum += coefficient * x[place];
  return sum;
}

}  // namespace

CrackedBody::CrackedBody(std::shared_ptr<Family<2>> family, double spacing,
                         std::shared_ptr<BreakableElasticity<2>> elastic,
                         Eigen::SparseMatrix<double> free_unknowns, BondState<2>& bonds,
                         std::optional<InitialStress<2>> initial_stress,
                         std::vector<CrackFacet<2>> seeds)
    : CutBody(std::move(family), spacing, std::move(elastic), bonds, initial_stress,
              std::move(seeds)),
      free_unknowns_(std::move(free_unknowns)),
      free_of_(free_unknowns_.rows(), {-1, 0.0}),
      load_(Eigen::VectorXd::Zero(free_unknowns_.cols())) {
  for (int column = 0; column < free_unknowns_.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(free_unknowns_, column); entry; ++entry) {
      free_of_[entry.row()] = {column, entry.value()};
    }
  }
}

const Eigen::SparseMatrix<double>& CrackedBody::free_stiffness() {
  if (stiffness_.size() == 0) {
    stiffness_ = free_unknowns_.transpose() * elastic_->assemble() * free_unknowns_;
  }
  return stiffness_;
}

void CrackedBody::start() {
  factor_.factor(free_stiffness());
  stiffness_ = {};
  inverse_ = std::make_unique<CondensedInverse>(factor_, free_unknowns_.cols());
  jumps_.clear();
  modes_.clear();
  for (const CrackFacet<2>& seed : seeds_) add_mode(face_jump(seed, intact_, spacing_));
  intact_move_.resize(0);
  set_load(load_);
  find_compliance();
}

bool CrackedBody::cut(const CrackFacet<2>& facet) {
  const auto bonds = bonds_cut_by<2>(facet, *family_);
  if (bonds.empty()) return false;
  std::set<Index> points;
  for (const auto& [i, j] : bonds) points.insert({i, j});
  std::vector<PointStiffness> before, after;
  for (const Index i : points) before.push_back(on_free(elastic_->point_stiffness(i)));
  break_bonds(bonds);
  for (const Index i : points) after.push_back(on_free(elastic_->point_stiffness(i)));

  std::set<int> unknowns;
  for (const PointStiffness& part : before)
    unknowns.insert(part.unknowns.begin(), part.unknowns.end());
  inverse_->add(std::vector<int>(unknowns.begin(), unknowns.end()));
  std::vector<int> places;
  for (const int unknown : unknowns) places.push_back(inverse_->place(unknown));
  const auto row = [&](Index unknown) {
    return std::distance(unknowns.begin(), unknowns.find(unknown));
  };
  Eigen::MatrixXd delta = Eigen::MatrixXd::Zero(places.size(), places.size());
  const auto add = [&](const PointStiffness& part, double sign) {
    std::vector<Eigen::Index> rows;
    for (const Index unknown : part.unknowns) rows.push_back(row(unknown));
    for (std::size_t a = 0; a < rows.size(); ++a) {
      for (std::size_t b = 0; b < rows.size(); ++b) {
        delta(rows[a], rows[b]) += sign * part.matrix(a, b);
      }
    }
  };
  for (const PointStiffness& part : before) add(part, -1.0);
  for (const PointStiffness& part : after) add(part, 1.0);
  inverse_->change(places, delta);

  bonds_.add_facet(facet, bonds);
  followed_ = bonds_.version();
  add_mode(face_jump(facet, intact_, spacing_));
  find_compliance();
  find_opening();
  return true;
}

void CrackedBody::follow_bonds() {
  if (bonds_.version() == followed_) return;
  const std::vector<CrackFacet<2>> facets(bonds_.facets().begin(), bonds_.facets().end());
  bonds_ = BondState<2>(bonds_.version());
  mend();
  cut_seeds();
  start();
  for (const CrackFacet<2>& facet : std::span(facets).subspan(seeds_.size())) cut(facet);
}

PointStiffness CrackedBody::on_free(const PointStiffness& all) const {
  std::set<Index> free;
  for (const Index unknown : all.unknowns) {
    if (free_of_[unknown].first >= 0) free.insert(free_of_[unknown].first);
  }
  PointStiffness result{{free.begin(), free.end()},
                        Eigen::MatrixXd::Zero(free.size(), free.size())};
  const auto place = [&](Index unknown) {
    return std::ranges::lower_bound(result.unknowns, free_of_[unknown].first) -
           result.unknowns.begin();
  };
  for (std::size_t a = 0; a < all.unknowns.size(); ++a) {
    const auto& [free_a, by_a] = free_of_[all.unknowns[a]];
    if (free_a < 0) continue;
    for (std::size_t b = 0; b < all.unknowns.size(); ++b) {
      const auto& [free_b, by_b] = free_of_[all.unknowns[b]];
      if (free_b < 0) continue;
      result.matrix(place(all.unknowns[a]), place(all.unknowns[b])) +=
          by_a * by_b * all.matrix(a, b);
    }
  }
  return result;
}

void CrackedBody::add_mode(const FaceJump& jump) {
  std::vector<int> unknowns;
  for (const auto& [point, coefficient] : jump.terms) {
    for (int a = 0; a < 2; ++a) {
      const int free = free_of_[a * family_->point_count + point].first;
      if (free >= 0) unknowns.push_back(free);
    }
  }
  inverse_->add(unknowns);
  Mode mode;
  for (const auto& [point, coefficient] : jump.terms) {
    for (int a = 0; a < 2; ++a) {
      const auto& [free, by] = free_of_[a * family_->point_count + point];
      if (free < 0) continue;
      mode.normal.emplace_back(inverse_->place(free), by * coefficient * jump.normal[a]);
      mode.tangent.emplace_back(inverse_->place(free), by * coefficient * jump.tangent[a]);
    }
  }
  jumps_.push_back(jump);
  modes_.push_back(std::move(mode));
}

void CrackedBody::find_compliance() {
  const Eigen::Index count = static_cast<Eigen::Index>(modes_.size());
  Eigen::MatrixXd response(inverse_->block().rows(), count);
  for (Eigen::Index g = 0; g < count; ++g) {
    response.col(g).setZero();
    for (const auto& [place, coefficient] : modes_[g].normal) {
      response.col(g) += jumps_[g].length * coefficient * inverse_->block().col(place);
    }
  }
  compliance_.resize(count, count);
  for (Eigen::Index f = 0; f < count; ++f) {
    for (Eigen::Index g = 0; g < count; ++g) {
      double sum = 0.0;
      for (const auto& [place, coefficient] : modes_[f].normal)
        sum += coefficient * response(place, g);
      compliance_(f, g) = sum;
    }
  }
}

void CrackedBody::set_load(const Eigen::VectorXd& load) {
  if (intact_move_.size() == load.size() && load == load_) return;
  load_ = load;
  intact_move_.resize(load.size());
  factor_.solve(load_, intact_move_);
  find_opening();
}

/// What a pressure on the faces, and the stress they are relieved of, do on the condensed unknowns.
Eigen::VectorXd CrackedBody::block_force(const Eigen::VectorXd& pressure) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(inverse_->block().rows());
  for (std::size_t f = 0; f < modes_.size(); ++f) {
    const auto [normal, tangential] = relief(static_cast<Index>(f));
    const double length = jumps_[f].length;
    for (const auto& [place, c] : modes_[f].normal) {
      force[place] += length * (pressure[f] + normal) * c;
    }
    for (const auto& [place, c] : modes_[f].tangent) force[place] += length * tangential * c;
  }
  return force;
}

void CrackedBody::find_opening() {
  Eigen::VectorXd moved(inverse_->block().rows());
  for (Eigen::Index k = 0; k < moved.size(); ++k) {
    moved[k] = intact_move_[inverse_->unknowns()[k]];
  }
  loaded_ = inverse_->correct_block(moved);
  const auto count = static_cast<Eigen::Index>(modes_.size());
  const Eigen::VectorXd x = loaded_ + inverse_->block() * block_force(Eigen::VectorXd::Zero(count));
  opening_.resize(count);
  for (Eigen::Index f = 0; f < count; ++f) opening_[f] = dot(modes_[f].normal, x);
}

Eigen::VectorXd CrackedBody::free_opening(const Eigen::VectorXd& pressure) const {
  return opening_ + compliance_ * pressure;
}

CrackedBody::Faces CrackedBody::faces(const Eigen::VectorXd& pressure) const {
  Complementarity contact =
      solve_complementarity(compliance_, free_opening(pressure), 1e-14 * spacing_);
  return {contact.y.cwiseMax(0.0), pressure + contact.x, std::move(contact.held)};
}

/// Under a uniform pressure, the opening of a facet by the volume of all, which a step of the tip
/// changes as it does K_I.
double CrackedBody::intensity_at_fixed_volume(Index facet) const {
  const Eigen::VectorXd opening = compliance_.rowwise().sum();
  double volume = 0.0;
  for (std::size_t f = 0; f < jumps_.size(); ++f) volume += jumps_[f].length * opening[f];
  return opening[facet] / volume;
}

Eigen::VectorXd CrackedBody::face_force(const Eigen::VectorXd& pressure, bool relief) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(free_unknowns_.rows());
  for (std::size_t f = 0; f < jumps_.size(); ++f) {
    const Vector<2> relieved = relief ? this->relief(static_cast<Index>(f)) : Vector<2>{};
    for (const auto& [point, coefficient] : jumps_[f].terms) {
      for (int a = 0; a < 2; ++a) {
        force[a * family_->point_count + point] +=
            jumps_[f].length * coefficient *
            ((pressure[f] + relieved[0]) * jumps_[f].normal[a] +
             relieved[1] * jumps_[f].tangent[a]);
      }
    }
  }
  return force;
}

/// What would move the body with its first cracks alone as the faces' force moves the present one;
/// on the condensed unknowns, for it is nothing elsewhere.
Eigen::VectorXd CrackedBody::block_force_on_first_body(const Eigen::VectorXd& force,
                                                       const Eigen::VectorXd& block) const {
  return force - inverse_->force_of_changes(block);
}

Eigen::VectorXd CrackedBody::force_on_first_body(const Eigen::VectorXd& force,
                                                 const Eigen::VectorXd& block) const {
  const Eigen::VectorXd own = block_force_on_first_body(force, block);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(free_unknowns_.cols());
  for (Eigen::Index k = 0; k < own.size(); ++k) all[inverse_->unknowns()[k]] = own[k];
  return all;
}

Eigen::VectorXd CrackedBody::unknowns(const Eigen::VectorXd& pressure) const {
  const Eigen::VectorXd force = block_force(pressure);
  const Eigen::VectorXd block = loaded_ + inverse_->block() * force;
  const Eigen::VectorXd all = force_on_first_body(force, block);
  Eigen::VectorXd moved(all.size());
  factor_.solve(all, moved);
  return free_unknowns_ * (intact_move_ + moved);
}

void CrackedBody::find_unknowns(const Eigen::VectorXd& pressure, std::span<const Index> named,
                                std::span<double> all) const {
  const Eigen::VectorXd force = block_force(pressure);
  const Eigen::VectorXd block = loaded_ + inverse_->block() * force;
  std::vector<int> wanted;
  for (const Index unknown : named) {
    if (free_of_[unknown].first >= 0) wanted.push_back(free_of_[unknown].first);
  }
  Eigen::VectorXd moved(std::ssize(wanted));
  factor_.solve_part(inverse_->unknowns(), block_force_on_first_body(force, block), wanted, moved);
  Eigen::Index next = 0;
  for (const Index unknown : named) {
    const auto [free, by] = free_of_[unknown];
    all[unknown] = free < 0 ? 0.0 : by * (intact_move_[free] + moved[next++]);
  }
}

std::vector<Vector<2>> CrackedBody::jumps_under(const Eigen::VectorXd& pressure) const {
  const Eigen::VectorXd block = loaded_ + inverse_->block() * block_force(pressure);
  std::vector<Vector<2>> jumps;
  for (const Mode& mode : modes_)
    jumps.push_back({dot(mode.normal, block), dot(mode.tangent, block)});
  return jumps;
}

CrackedBody::Energies CrackedBody::energies(const Eigen::VectorXd& pressure) const {
  const Eigen::VectorXd force = block_force(pressure);
  const Eigen::VectorXd block = loaded_ + inverse_->block() * force;
  Energies energies{};
  // The factor's inverse is symmetric, so that load times displacement needs no displacement.
  energies.load = intact_move_.dot(load_ + force_on_first_body(force, block));
  energies.elastic = 0.5 * (energies.load + force.dot(block));
  for (std::size_t f = 0; f < modes_.size(); ++f) {
    const auto [normal, tangential] = relief(static_cast<Index>(f));
    energies.relief += jumps_[f].length * (normal * dot(modes_[f].normal, block) +
                                           tangential * dot(modes_[f].tangent, block));
  }
  return energies;
}

}  // namespace perifrac
