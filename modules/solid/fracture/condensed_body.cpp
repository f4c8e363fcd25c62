#include "modules/solid/fracture/condensed_body.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include <Eigen/Dense>

#include "core/base/require.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/solvers/complementarity.hpp"
#include "core/solvers/reduced_matrix.hpp"
#include "modules/solid/fracture/loose_piece.hpp"

namespace perifrac {

namespace {

double along(const std::vector<std::pair<int, double>>& mode, const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (const auto& [place, coefficient] : mode) sum += coefficient * x[place];
  return sum;
}

}  // namespace

template <int D>
CondensedBody<D>::CondensedBody(std::shared_ptr<Family<D>> family, double spacing,
                                std::shared_ptr<BreakableElasticity<D>> elastic,
                                Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
                                std::optional<InitialStress<D>> initial_stress,
                                std::vector<CrackFacet<D>> seeds, std::string why)
    : CrackedBody<D>(std::move(family), spacing, std::move(elastic), std::move(free_unknowns),
                     bonds, std::move(initial_stress), std::move(seeds)),
      why_(why.empty() ? why : ": " + why),
      free_of_(free_unknowns_.rows(), {-1, 0.0}),
      load_(Eigen::VectorXd::Zero(free_unknowns_.cols())) {
  for (int column = 0; column < free_unknowns_.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(free_unknowns_, column); entry; ++entry) {
      free_of_[entry.row()] = {column, entry.value()};
    }
  }
}

template <int D>
const Eigen::SparseMatrix<double>& CondensedBody<D>::free_stiffness() {
  if (stiffness_.size() == 0) {
    stiffness_ = reduced(elastic_->assemble(), free_unknowns_);
  }
  return stiffness_;
}

template <int D>
void CondensedBody<D>::start() {
  factor_.factor(free_stiffness());
  stiffness_ = {};
  inverse_ = std::make_unique<CondensedInverse>(factor_, free_unknowns_.cols());
  jumps_.clear();
  modes_.clear();
  pressed_.clear();
  change_of_.clear();
  partial_ = {};
  add_seeds();
  begun_.resize(0);
  set_load(load_);
  find_compliance();
}

template <int D>
bool CondensedBody<D>::cut(const CrackFacet<D>& facet) {
  const auto bonds = bonds_cut_by<D>(facet, *family_, longest_);
  if (bonds.empty()) return false;
  const FaceJump<D> jump = face_jump<D>(facet, intact_, spacing_, longest_);
  std::set<Index> points;
  for (const auto& [i, j] : bonds) points.insert({i, j});
  Parts parts;
  for (const Index i : points) parts.less.push_back(on_free(elastic_->point_stiffness(i)));
  this->break_bonds(bonds);
  std::vector<PartialCut> partial;
  for (std::size_t k = 0; k < partial_.count(); ++k) partial.push_back(partial_.at(k));
  try {
    for (const Index i : points) parts.more.push_back(on_free(elastic_->point_stiffness(i)));
    this->check_pieces(bonds);
    change_stiffness(parts);
  } catch (...) {
    this->heal_bonds(bonds);
    take_partial(partial);  // of a block that may have grown
    throw;
  }
  bonds_.add_facet(facet, bonds);
  followed_ = bonds_.version();
  change_of_.push_back(static_cast<int>(inverse_->changes().size()) - 1);
  add_mode(jump);
  take_partial(partial);
  return true;
}

template <int D>
void CondensedBody<D>::change_stiffness(const Parts& parts) {
  std::set<int> unknowns;
  for (const auto* side : {&parts.less, &parts.more}) {
    for (const PointStiffness& part : *side)
      unknowns.insert(part.unknowns.begin(), part.unknowns.end());
  }
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
  for (const PointStiffness& part : parts.less) add(part, -1.0);
  for (const PointStiffness& part : parts.more) add(part, 1.0);
  inverse_->change(places, delta);
}

template <int D>
PointStiffness CondensedBody<D>::on_free(const PointStiffness& all) const {
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

/// The jump along its normal, or a tangent, of what is solved for.
template <int D>
UnknownSum CondensedBody<D>::sum_of(const FaceJump<D>& jump, int axis) const {
  const Vector<D>& along = axis == 0 ? jump.normal : jump.tangents[axis - 1];
  UnknownSum sum;
  for (const auto& [point, coefficient] : jump.terms) {
    for (int a = 0; a < D; ++a) {
      const auto& [free, by] = free_of_[a * family_->point_count + point];
      if (free >= 0) sum.emplace_back(free, by * coefficient * along[a]);
    }
  }
  return sum;
}

/// Cracks of the start change no stiffness: their jumps are all that is asked of them.
template <int D>
void CondensedBody<D>::add_seeds() {
  std::vector<UnknownSum> sums;
  for (const CrackFacet<D>& seed : seeds_) {
    const FaceJump<D> jump = face_jump<D>(seed, intact_, spacing_, longest_);
    this->add_jump(jump);
    Mode& mode = modes_.emplace_back();
    for (int axis = 0; axis < D; ++axis) {
      mode[axis].emplace_back(static_cast<int>(sums.size()), 1.0);
      sums.push_back(sum_of(jump, axis));
    }
  }
  inverse_->add(sums);
}

template <int D>
void CondensedBody<D>::add_mode(const FaceJump<D>& jump) {
  std::vector<int> unknowns;  // the same along all axes
  for (const auto& [free, coefficient] : sum_of(jump, 0)) unknowns.push_back(free);
  inverse_->add(unknowns);
  this->add_jump(jump);
  modes_.push_back(mode_of(jump));
}

template <int D>
typename CondensedBody<D>::Mode CondensedBody<D>::mode_of(const FaceJump<D>& jump) const {
  Mode mode;
  for (int axis = 0; axis < D; ++axis) {
    for (const auto& [free, coefficient] : sum_of(jump, axis)) {
      mode[axis].emplace_back(inverse_->place(free), coefficient);
    }
  }
  return mode;
}

template <int D>
Eigen::MatrixXd CondensedBody<D>::compliance(int jump, int traction) {
  const bool of_openings = jump == 0 && traction == 0;
  Eigen::MatrixXd compliance = whole_compliance(jump, traction);
  if (!partial_.empty()) partial_.hold(compliance, jump, traction);
  if (of_openings) {
    for (std::size_t f = 0; f < modes_.size(); ++f) compliance(f, f) += pressed_[f];
  }
  return compliance;
}

template <int D>
void CondensedBody<D>::find_compliance() {
  whole_compliance_.fill({});
  compliance_ = compliance(0, 0);
}

template <int D>
Eigen::MatrixXd CondensedBody<D>::whole_compliance() {
  const auto count = std::ssize(modes_);
  Eigen::MatrixXd whole(D * count, D * count);
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      whole.block(a * count, b * count, count, count) = whole_compliance(a, b);
    }
  }
  for (Eigen::Index f = 0; f < count; ++f) whole(f, f) += this->pressed_by(static_cast<Index>(f));
  return whole;
}

template <int D>
LowRankChange CondensedBody<D>::compliance_change() {
  if (partial_.empty()) return {};
  const auto count = std::ssize(modes_), cuts = static_cast<std::ptrdiff_t>(partial_.count());
  std::vector<Eigen::Index> facets;
  for (std::size_t k = 0; k < partial_.count(); ++k) facets.push_back(partial_.at(k).facet);
  Eigen::MatrixXd by_own(D * count, D * cuts), at_own = by_own;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      by_own.block(a * count, b * cuts, count, cuts) = whole_compliance(a, b)(Eigen::all, facets);
      at_own.block(a * count, b * cuts, count, cuts) =
          whole_compliance(b, a)(facets, Eigen::all).transpose();
    }
  }
  return partial_.change(by_own, at_own);
}

/// What openings put back apart.
template <int D>
const Eigen::MatrixXd& CondensedBody<D>::whole_compliance(int jump, int traction) {
  Eigen::MatrixXd& compliance = whole_compliance_[jump * D + traction];
  if (compliance.size() > 0) return compliance;
  const Eigen::Index count = static_cast<Eigen::Index>(modes_.size());
  std::vector<Mode> modes = modes_;
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    modes[partial_.at(k).facet] = mode_of(jumps_[partial_.at(k).facet]);
  }
  Eigen::MatrixXd response(inverse_->block().rows(), count);
  for (Eigen::Index g = 0; g < count; ++g) {
    response.col(g).setZero();
    for (const auto& [place, coefficient] : modes[g][traction]) {
      response.col(g) += jumps_[g].area * coefficient * inverse_->block().col(place);
    }
  }
  compliance.resize(count, count);
  for (Eigen::Index f = 0; f < count; ++f) {
    for (Eigen::Index g = 0; g < count; ++g) {
      double sum = 0.0;
      for (const auto& [place, c] : modes[f][jump]) sum += c * response(place, g);
      compliance(f, g) = sum;
    }
  }
  return compliance;
}

template <int D>
void CondensedBody<D>::set_load(const Eigen::VectorXd& load) {
  require(load.size() == free_unknowns_.cols(), "a load on other unknowns than the body has");
  if (begun_.size() == load.size() && load == load_) return;
  load_ = load;
  begun_ = factor_.begin(load_);
  intact_move_.resize(0);
  find_opening();
}

template <int D>
std::vector<Vector<D>> CondensedBody<D>::face_loads(const Eigen::VectorXd& pressure,
                                                    std::span<const double> shear) const {
  require(pressure.size() == std::ssize(modes_) && (shear.empty() || shear.size() == modes_.size()),
          "pressure and shear of other facets than the body has");
  std::vector<Vector<D>> loads;
  for (std::size_t f = 0; f < modes_.size(); ++f) {
    loads.push_back(this->face_load(f, pressure[f], shear));
  }
  return loads;
}

/// What loads of the faces do on the condensed unknowns.
template <int D>
Eigen::VectorXd CondensedBody<D>::force_of(std::span<const Vector<D>> loads) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(inverse_->block().rows());
  for (std::size_t f = 0; f < modes_.size(); ++f) {
    for (int k = 0; k < D; ++k) {
      for (const auto& [place, c] : modes_[f][k]) force[place] += jumps_[f].area * loads[f][k] * c;
    }
  }
  return force;
}

template <int D>
Eigen::VectorXd CondensedBody<D>::block_force(const Eigen::VectorXd& pressure,
                                              std::span<const double> shear) const {
  return force_of(face_loads(pressure, shear));
}

template <int D>
Eigen::VectorXd CondensedBody<D>::moved_by(const Eigen::VectorXd& force) const {
  const Eigen::VectorXd moved = inverse_->block() * force;
  return partial_.empty() ? moved : partial_.held(moved);
}

template <int D>
void CondensedBody<D>::find_opening() {
  find_cut_loaded();
  find_free_opening();
}

template <int D>
void CondensedBody<D>::find_cut_loaded() {
  cut_loaded_ =
      inverse_->correct_block(inverse_->at_places(factor_.part(begun_, inverse_->unknowns())));
}

template <int D>
void CondensedBody<D>::find_free_opening() {
  loaded_ = partial_.empty() ? cut_loaded_ : partial_.held(cut_loaded_);
  const auto count = static_cast<Eigen::Index>(modes_.size());
  const auto loads = face_loads(Eigen::VectorXd::Zero(count), {});
  const auto jumps = jumps_at(loaded_ + moved_by(force_of(loads)), loads);
  opening_.resize(count);
  for (Eigen::Index f = 0; f < count; ++f) opening_[f] = jumps[f][0];
}

template <int D>
Eigen::VectorXd CondensedBody<D>::free_opening(const Eigen::VectorXd& pressure,
                                               const Eigen::VectorXd&) {
  require(opening_.size() == pressure.size() && compliance_.cols() == pressure.size(),
          "pressure of other facets than the body has");
  return opening_ + compliance_ * pressure;
}

template <int D>
typename CrackedBody<D>::Faces CondensedBody<D>::faces(const Eigen::VectorXd& pressure) {
  Complementarity contact =
      solve_complementarity(compliance_, free_opening(pressure, pressure), 1e-14 * spacing_);
  return {contact.y.cwiseMax(0.0), pressure + contact.x, std::move(contact.held)};
}

/// Under a uniform pressure, the opening of a facet by the volume of all, which a step of the tip
/// changes as it does K_I.
template <int D>
double CondensedBody<D>::intensity_at_fixed_volume(Index facet) {
  const Eigen::VectorXd opening = compliance_.rowwise().sum();
  double volume = 0.0;
  for (std::size_t f = 0; f < jumps_.size(); ++f) volume += jumps_[f].area * opening[f];
  return opening[facet] / volume;
}

template <int D>
std::optional<double> CondensedBody<D>::find_even_answers(std::span<const Index> faces,
                                                          std::span<const Index> named,
                                                          std::span<double> by_pressure,
                                                          std::span<double> by_shear) {
  Eigen::MatrixXd force(inverse_->block().rows(), 2);
  double volume = 0.0;
  for (const int axis : {0, 1}) {
    std::vector<Vector<D>> loads(modes_.size(), Vector<D>{});
    for (const Index f : faces) loads[f][axis] = 1.0;
    const Eigen::VectorXd own = force_of(loads);
    const Eigen::VectorXd block = moved_by(own);
    force.col(axis) = block_force_on_first_body(own, block);
    if (axis > 0) continue;
    const auto jumps = jumps_at(block, loads);
    for (const Index f : faces) volume += jumps_[f].area * jumps[f][0];
  }
  const Eigen::MatrixXd moved = solve_named(force, named);
  Eigen::Index next = 0;
  for (const Index unknown : named) {
    const auto [free, by] = free_of_[unknown];
    by_pressure[unknown] = free < 0 ? 0.0 : by * moved(next, 0);
    by_shear[unknown] = free < 0 ? 0.0 : by * moved(next, 1);
    if (free >= 0) ++next;
  }
  return volume;
}

/// What forces on the condensed unknowns do to those named that are free; one column a force.
template <int D>
Eigen::MatrixXd CondensedBody<D>::solve_named(const Eigen::MatrixXd& force,
                                              std::span<const Index> named) const {
  std::vector<int> wanted;
  for (const Index unknown : named) {
    if (free_of_[unknown].first >= 0) wanted.push_back(free_of_[unknown].first);
  }
  Eigen::MatrixXd moved(std::ssize(wanted), force.cols());
  factor_.solve_part(inverse_->unknowns(), inverse_->on_unknowns(force), wanted, moved);
  return moved;
}

/// What would move the body with its first cracks alone as the faces' force moves the present one;
/// on the condensed unknowns, for it is nothing elsewhere.
template <int D>
Eigen::VectorXd CondensedBody<D>::block_force_on_first_body(const Eigen::VectorXd& force,
                                                            const Eigen::VectorXd& block) const {
  const Eigen::VectorXd own = force - inverse_->force_of_changes(block);
  if (partial_.empty()) return own;
  return own - partial_.force(block);
}

/// Loads that stay are asked for again and again, those that do not for all that moves only.
template <int D>
const Eigen::VectorXd& CondensedBody<D>::intact_move() {
  if (intact_move_.size() == 0) intact_move_ = factor_.finish(begun_);
  return intact_move_;
}

template <int D>
Eigen::VectorXd CondensedBody<D>::unknowns(const Eigen::VectorXd& pressure,
                                           std::span<const double> shear) {
  const Eigen::VectorXd force = block_force(pressure, shear);
  const Eigen::VectorXd block = loaded_ + moved_by(force);
  return free_unknowns_ *
         factor_.finish(begun_, inverse_->unknowns(),
                        inverse_->on_unknowns(block_force_on_first_body(force, block)));
}

template <int D>
void CondensedBody<D>::find_unknowns(const Eigen::VectorXd& pressure, std::span<const Index> named,
                                     std::span<double> all, std::span<const double> shear) {
  const Eigen::VectorXd force = block_force(pressure, shear);
  const Eigen::VectorXd block = loaded_ + moved_by(force);
  const Eigen::VectorXd moved = solve_named(block_force_on_first_body(force, block), named);
  Eigen::Index next = 0;
  for (const Index unknown : named) {
    const auto [free, by] = free_of_[unknown];
    all[unknown] = free < 0 ? 0.0 : by * (intact_move()[free] + moved[next++]);
  }
}

template <int D>
std::vector<Vector<D>> CondensedBody<D>::jumps_under(const Eigen::VectorXd& pressure,
                                                     std::span<const double> shear) {
  const auto loads = face_loads(pressure, shear);
  return jumps_at(loaded_ + moved_by(force_of(loads)), loads);
}

template <int D>
std::vector<Vector<D>> CondensedBody<D>::jumps_at(const Eigen::VectorXd& block,
                                                  std::span<const Vector<D>> loads) const {
  std::vector<Vector<D>> jumps;
  for (std::size_t f = 0; f < modes_.size(); ++f) {
    Vector<D>& jump = jumps.emplace_back();
    for (int k = 0; k < D; ++k) jump[k] = along(modes_[f][k], block);
    jump[0] += pressed_[f] * loads[f][0];
  }
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    const Index f = partial_.at(k).facet;
    const Eigen::VectorXd own = own_jump(k, loads[f]);
    for (int a = 0; a < D; ++a) jumps[f][a] += own[a];
  }
  return jumps;
}

template <int D>
typename CrackedBody<D>::Energies CondensedBody<D>::energies(const Eigen::VectorXd& pressure,
                                                             std::span<const double> shear) {
  const Eigen::VectorXd force = block_force(pressure, shear);
  const Eigen::VectorXd block = loaded_ + moved_by(force);
  Energies energies{};
  // The factor's inverse is symmetric, so that load times displacement needs no displacement.
  const Eigen::VectorXd by_cuts = inverse_->on_unknowns(block_force_on_first_body(force, block));
  energies.load = intact_move().dot(load_);
  for (Eigen::Index k = 0; k < by_cuts.size(); ++k) {
    energies.load += intact_move()[inverse_->unknowns()[k]] * by_cuts[k];
  }
  energies.elastic = 0.5 * (energies.load + force.dot(block));
  for (std::size_t f = 0; f < modes_.size(); ++f) {
    const Vector<D> load = this->relief(static_cast<Index>(f));
    double sum = 0.0;
    for (int k = 0; k < D; ++k) sum += load[k] * along(modes_[f][k], block);
    energies.relief += jumps_[f].area * sum;
  }
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    const Index f = partial_.at(k).facet;
    const Vector<D> load = this->face_load(f, pressure[f], shear), relief = this->relief(f);
    const Eigen::VectorXd own = jumps_[f].area * own_jump(k, load);
    for (int a = 0; a < D; ++a) {
      energies.elastic += 0.5 * load[a] * own[a];
      energies.relief += relief[a] * own[a];
    }
  }
  const Energies pressed = this->pressed_energies(pressure);
  energies.elastic += pressed.elastic;
  energies.relief += pressed.relief;
  return energies;
}

template class CondensedBody<2>;
template class CondensedBody<3>;

}  // namespace perifrac
