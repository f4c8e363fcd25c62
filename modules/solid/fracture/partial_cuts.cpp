#include "modules/solid/fracture/partial_cuts.hpp"

#include <Eigen/Dense>

#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

/// What stiffens its own place by less than this part counts as nothing.
constexpr double least_stiffening = 1e-9;

/// A symmetric stiffness L as V d V^T, without what is nothing, with V^T A V = 1.
void decompose(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& moved_by,
               Eigen::MatrixXd& vectors, Eigen::VectorXd& values) {
  const Eigen::LLT<Eigen::MatrixXd> factor(moved_by);
  const Eigen::MatrixXd root = factor.matrixL();
  const SymmetricSpectrum found = symmetric_spectrum(root.transpose() * stiffness * root);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index n = 0; n < found.values.size(); ++n) {
    if (std::abs(found.values[n]) > least_stiffening) kept.push_back(n);
  }
  vectors = factor.matrixU().solve(found.vectors(Eigen::all, kept));
  values = found.values(kept);
}

}  // namespace

void PartialCuts::take(std::vector<Cut> cuts, const Eigen::MatrixXd& block) {
  parts_.clear();
  Eigen::Index all = 0;
  for (Cut& cut : cuts) {
    Part& part = parts_.emplace_back();
    Eigen::MatrixXd vectors;
    decompose(cut.less, block(cut.places, cut.places), vectors, part.less);
    part.at = cut.at;
    part.area = cut.area;
    part.pressed = cut.pressed;
    part.places = std::move(cut.places);
    part.rank = vectors.cols();
    part.first = all;
    part.basis.resize(vectors.rows(), vectors.cols() + cut.modes.cols());
    part.basis << vectors, cut.modes;
    all += part.basis.cols();
  }
  columns_.resize(block.rows(), all);
  for (const Part& part : parts_) {
    columns_.middleCols(part.first, part.basis.cols()).noalias() =
        block(Eigen::all, part.places) * part.basis;
  }
  gram_.resize(all, all);
  for (const Part& part : parts_) {
    gram_.middleRows(part.first, part.basis.cols()).noalias() =
        part.basis.transpose() * columns_(part.places, Eigen::all);
  }
  between_ = gram_;
  for (Part& part : parts_) {
    between_.block(part.first, part.first, part.rank, part.rank).setZero();
    part.softened = (1.0 + part.less.array()).inverse();
    set(part, part.at.opened);
  }
  factor();
}

void PartialCuts::open(std::span<const double> opened) {
  for (std::size_t k = 0; k < parts_.size(); ++k) set(parts_[k], opened[k]);
  factor();
}

void PartialCuts::tell(std::vector<Eigen::MatrixXd> rows, Eigen::VectorXd area) {
  rows_ = std::move(rows);
  area_ = std::move(area);
  answers_.assign(rows_.size(), std::nullopt);
}

const PartialCuts::Answer& PartialCuts::answer(int axis) {
  if (answers_[axis]) return *answers_[axis];
  Answer& found = answers_[axis].emplace();
  found.of_facets = taken(rows_[axis].transpose());
  found.acting = Eigen::MatrixXd::Zero(gram_.rows(), std::ssize(parts_));
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    found.acting.col(static_cast<Eigen::Index>(k)).segment(part.first, part.basis.cols()) =
        part.acting.col(axis);
  }
  found.of_cuts = found.acting - taken(gram_ * found.acting);
  return found;
}

/// V^T A m.
Eigen::MatrixXd PartialCuts::by_own_faces(const Part& part) const {
  return gram_.block(part.first, part.first + part.rank, part.rank, part.basis.cols() - part.rank);
}

/// m^T A m.
Eigen::MatrixXd PartialCuts::own_jumps(const Part& part) const {
  const Eigen::Index axes = part.basis.cols() - part.rank, first = part.first + part.rank;
  return gram_.block(first, first, axes, axes);
}

void PartialCuts::set(Part& part, double opened) {
  part.at.opened = opened;
  const Eigen::Index axes = part.basis.cols() - part.rank;
  part.held = (1.0 - opened) * part.less.array() * part.softened.array() /
              (opened + (1.0 - opened) * part.softened.array());
  const Eigen::MatrixXd a = by_own_faces(part);
  part.acting.resize(part.basis.cols(), axes);
  part.acting.topRows(part.rank) = opened * part.held.asDiagonal() * a;
  part.acting.bottomRows(axes) = opened * Eigen::MatrixXd::Identity(axes, axes);
  part.own = opened * (1.0 - opened) * own_jumps(part) -
             opened * opened * a.transpose() * part.held.asDiagonal() * a;
}

void PartialCuts::factor() {
  alone_ = Eigen::VectorXd::Zero(gram_.rows());
  for (const Part& part : parts_) {
    alone_.segment(part.first, part.rank) =
        (1.0 - part.at.opened) * part.less.cwiseProduct(part.softened);
  }
  if (parts_.size() > 1) {
    Eigen::MatrixXd system = alone_.asDiagonal() * between_;
    system.diagonal().array() += 1.0;
    together_.compute(system);
  }
  answers_.assign(rows_.size(), std::nullopt);
}

/// (1 / H + V^T A V)^-1 in the basis, times that.
Eigen::MatrixXd PartialCuts::taken(const Eigen::MatrixXd& moved) const {
  if (parts_.size() == 1) return alone_.asDiagonal() * moved;
  return together_.solve(alone_.asDiagonal() * moved);
}

Eigen::VectorXd PartialCuts::held(const Eigen::VectorXd& moved) const {
  Eigen::VectorXd named(gram_.rows());
  for (const Part& part : parts_) {
    named.segment(part.first, part.basis.cols()) = in_basis(part, moved);
  }
  return moved - columns_ * taken(named);
}

/// Of a field on the block.
Eigen::VectorXd PartialCuts::in_basis(const Part& part, const Eigen::VectorXd& block) const {
  return part.basis.transpose() * block(part.places);
}

Eigen::VectorXd PartialCuts::force(const Eigen::VectorXd& block) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(block.size());
  for (const Part& part : parts_) {
    const Eigen::VectorXd moved = in_basis(part, block).head(part.rank);
    sum(part.places) += part.basis.leftCols(part.rank) * (part.held.asDiagonal() * moved);
  }
  return sum;
}

Eigen::VectorXd PartialCuts::traction_force(std::size_t k, int axis, Eigen::Index size) const {
  const Part& part = parts_[k];
  Eigen::VectorXd force = Eigen::VectorXd::Zero(size);
  force(part.places) = part.area * (part.basis * part.acting.col(axis));
  return force;
}

Eigen::MatrixXd PartialCuts::own_compliance(std::size_t k) const {
  return parts_[k].area * parts_[k].own;
}

Eigen::MatrixXd PartialCuts::whole_compliance(std::size_t k) const {
  Eigen::MatrixXd own = parts_[k].area * own_jumps(parts_[k]);
  own(0, 0) += parts_[k].pressed;
  return own;
}

void PartialCuts::hold(Eigen::MatrixXd& compliance, int jump, int traction) {
  const Answer &to_jump = answer(jump), &by_traction = answer(traction);
  compliance -= rows_[jump] * by_traction.of_facets * area_.asDiagonal();
  const Eigen::MatrixXd columns = rows_[jump] * by_traction.of_cuts;
  const Eigen::MatrixXd rows = area_.asDiagonal() * (rows_[traction] * to_jump.of_cuts);
  const Eigen::MatrixXd between = to_jump.acting.transpose() * (gram_ * by_traction.of_cuts);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    compliance.col(parts_[k].at.facet) = parts_[k].area * columns.col(at);
    compliance.row(parts_[k].at.facet) = rows.col(at).transpose();
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& one = parts_[k];
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      const Part& other = parts_[n];
      compliance(one.at.facet, other.at.facet) =
          other.area * between(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(n));
    }
    compliance(one.at.facet, one.at.facet) += one.area * one.own(jump, traction);
  }
}

std::vector<Eigen::Index> PartialCuts::own_places() const {
  std::vector<Eigen::Index> own;
  for (Eigen::Index a = 0; a < std::ssize(rows_); ++a) {
    for (const Part& part : parts_) own.push_back(a * area_.size() + part.at.facet);
  }
  return own;
}

LowRankChange PartialCuts::change(const Eigen::MatrixXd& by_own, const Eigen::MatrixXd& at_own) {
  const auto facets = area_.size(), axes = std::ssize(rows_), cuts = std::ssize(parts_);
  const auto among = gram_.rows(), size = axes * facets;
  Eigen::MatrixXd rows(size, among), of_cuts(among, axes * cuts), acting = of_cuts;
  Eigen::VectorXd area(size);
  for (Eigen::Index a = 0; a < axes; ++a) {
    const Answer& along = answer(static_cast<int>(a));
    rows.middleRows(a * facets, facets) = rows_[a];
    area.segment(a * facets, facets) = area_;
    of_cuts.middleCols(a * cuts, cuts) = along.of_cuts;
    acting.middleCols(a * cuts, cuts) = along.acting;
  }
  // Of all faces by the cuts' own, and of those by the others.
  const std::vector<Eigen::Index> own = own_places();
  const Eigen::MatrixXd moved = rows * of_cuts;
  Eigen::MatrixXd columns = moved * area(own).asDiagonal();
  Eigen::MatrixXd turned = area.asDiagonal() * moved;
  columns(own, Eigen::all) = acting.transpose() * (gram_ * of_cuts) * area(own).asDiagonal();
  for (Eigen::Index k = 0; k < cuts; ++k) {
    const Part& part = parts_[k];
    for (Eigen::Index a = 0; a < axes; ++a) {
      for (Eigen::Index b = 0; b < axes; ++b) {
        columns(own[a * cuts + k], b * cuts + k) += part.area * part.own(a, b);
      }
    }
    columns(own[k], k) += (part.at.opened - 1.0) * part.pressed;
  }
  // Of others by others; what that says of the own ones goes off again.
  LowRankChange change;
  change.of_basis = -taken(Eigen::MatrixXd::Identity(among, among));
  const Eigen::MatrixXd right = area.asDiagonal() * rows;
  columns -= by_own + rows * (change.of_basis * right(own, Eigen::all).transpose());
  turned -= at_own + right * (rows(own, Eigen::all) * change.of_basis).transpose();
  turned(own, Eigen::all).setZero();
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(size, std::ssize(own));
  for (Eigen::Index k = 0; k < std::ssize(own); ++k) unit(own[k], k) = 1.0;
  change.left.resize(size, 2 * unit.cols());
  change.left << columns, unit;
  change.right.resize(size, among + 2 * unit.cols());
  change.right << right, unit, turned;
  change.basis = std::move(rows);
  return change;
}

CutLoad PartialCuts::load(std::size_t k, const Eigen::VectorXd& block,
                          const Eigen::VectorXd& traction) const {
  const Part& part = parts_[k];
  const double opened = part.at.opened, rest = 1.0 - opened;
  const Eigen::VectorXd moved = in_basis(part, block);
  const Eigen::VectorXd push = part.area * traction;
  const Eigen::MatrixXd a = by_own_faces(part);
  CutLoad load;
  load.traction = traction;
  load.borne = (moved.head(part.rank) - opened * (a * push)).array() /
               (opened + rest * part.softened.array());
  const Eigen::VectorXd taken = part.less.cwiseProduct(part.softened).cwiseProduct(load.borne);
  load.apart = moved.tail(moved.size() - part.rank) + rest * (a.transpose() * taken) +
               rest * (own_jumps(part) * push);
  load.apart[0] += part.pressed * traction[0];
  return load;
}

double PartialCuts::release(std::size_t k, const CutLoad& one, const CutLoad& other) const {
  const Part& part = parts_[k];
  const Eigen::VectorXd taken = part.less.cwiseProduct(part.softened).cwiseProduct(other.borne);
  const double across = one.traction.dot(other.apart) + other.traction.dot(one.apart) -
                        part.pressed * one.traction[0] * other.traction[0];
  return part.area * across -
         part.area * part.area * one.traction.dot(own_jumps(part) * other.traction) +
         one.borne.dot(taken);
}

double PartialCuts::energy(const Eigen::VectorXd& block) const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    const Eigen::VectorXd moved = in_basis(part, block).head(part.rank);
    sum += 0.5 * moved.dot(part.held.asDiagonal() * moved);
  }
  return sum;
}

}  // namespace perifrac
