#include "modules/solid/fracture/partial_cuts.hpp"

#include <Eigen/Dense>

namespace perifrac {

namespace {

/// Of the largest, a part of stiffness that counts as nothing.
constexpr double nothing = 1e-13;

/// A symmetric matrix as V d V^T, without what is nothing.
void decompose(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& vectors, Eigen::VectorXd& values) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> found(matrix);
  const double least = nothing * found.eigenvalues().cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index n = 0; n < matrix.rows(); ++n) {
    if (std::abs(found.eigenvalues()[n]) > least) kept.push_back(n);
  }
  vectors = found.eigenvectors()(Eigen::all, kept);
  values = found.eigenvalues()(kept);
}

}  // namespace

void PartialCuts::take(std::vector<Cut> cuts, const Eigen::MatrixXd& block) {
  parts_.clear();
  Eigen::Index all = 0;
  for (Cut& cut : cuts) {
    Part& part = parts_.emplace_back();
    Eigen::MatrixXd vectors;
    decompose(cut.less, vectors, part.less);
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
  for (Part& part : parts_) {
    const auto moved = gram_.block(part.first, part.first, part.rank, part.rank);
    Eigen::MatrixXd system = moved * part.less.asDiagonal();
    system.diagonal().array() += 1.0;
    part.softened = system.partialPivLu().inverse();
    set(part, part.at.opened);
  }
  hold_together();
}

void PartialCuts::open(std::span<const double> opened) {
  for (std::size_t k = 0; k < parts_.size(); ++k) set(parts_[k], opened[k]);
  hold_together();
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
  Eigen::MatrixXd system = (1.0 - opened) * part.softened;
  system.diagonal().array() += opened;
  const Eigen::MatrixXd held =
      (1.0 - opened) * part.less.asDiagonal() * part.softened * system.partialPivLu().inverse();
  part.held = 0.5 * (held + held.transpose());
  const Eigen::MatrixXd a = by_own_faces(part);
  part.acting.resize(part.basis.cols(), axes);
  part.acting.topRows(part.rank) = opened * part.held * a;
  part.acting.bottomRows(axes) = opened * Eigen::MatrixXd::Identity(axes, axes);
  part.own =
      opened * (1.0 - opened) * own_jumps(part) - opened * opened * a.transpose() * part.held * a;
}

void PartialCuts::hold_together() {
  const Eigen::Index all = gram_.rows();
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(all, all);
  for (const Part& part : parts_) {
    held.block(part.first, part.first, part.rank, part.rank) = part.held;
  }
  Eigen::MatrixXd system = held * gram_;
  system.diagonal().array() += 1.0;
  const Eigen::MatrixXd taken = system.partialPivLu().solve(held);
  taken_ = 0.5 * (taken + taken.transpose());
}

Eigen::VectorXd PartialCuts::held(const Eigen::VectorXd& moved) const {
  Eigen::VectorXd named(gram_.rows());
  for (const Part& part : parts_) {
    named.segment(part.first, part.basis.cols()) = in_basis(part, moved);
  }
  return moved - columns_ * (taken_ * named);
}

/// Of a field on the block.
Eigen::VectorXd PartialCuts::in_basis(const Part& part, const Eigen::VectorXd& block) const {
  return part.basis.transpose() * block(part.places);
}

Eigen::VectorXd PartialCuts::force(const Eigen::VectorXd& block) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(block.size());
  for (const Part& part : parts_) {
    const Eigen::VectorXd moved = in_basis(part, block).head(part.rank);
    sum(part.places) += part.basis.leftCols(part.rank) * (part.held * moved);
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

void PartialCuts::hold(Eigen::MatrixXd& compliance, int jump, int traction,
                       std::span<const Eigen::MatrixXd> rows, const Eigen::VectorXd& area) const {
  const Eigen::MatrixXd &by_jump = rows[jump], &by_traction = rows[traction];
  compliance.noalias() -= by_jump * (taken_ * by_traction.transpose()) * area.asDiagonal();
  const auto acting = [&](const Part& part, int axis) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(gram_.rows());
    all.segment(part.first, part.basis.cols()) = part.acting.col(axis);
    return Eigen::VectorXd(all - taken_ * (gram_ * all));
  };
  for (const Part& part : parts_) {
    compliance.col(part.at.facet) = part.area * (by_jump * acting(part, traction));
    compliance.row(part.at.facet) =
        (area.asDiagonal() * (by_traction * acting(part, jump))).transpose();
  }
  for (const Part& one : parts_) {
    for (const Part& other : parts_) {
      const Eigen::VectorXd moved =
          gram_.middleRows(one.first, one.basis.cols()) * acting(other, traction);
      compliance(one.at.facet, other.at.facet) = other.area * one.acting.col(jump).dot(moved);
    }
    compliance(one.at.facet, one.at.facet) += one.area * one.own(jump, traction);
  }
}

CutLoad PartialCuts::load(std::size_t k, const Eigen::VectorXd& block,
                          const Eigen::VectorXd& traction) const {
  const Part& part = parts_[k];
  const double opened = part.at.opened, rest = 1.0 - opened;
  const Eigen::VectorXd moved = in_basis(part, block);
  const Eigen::VectorXd push = part.area * traction;
  const Eigen::MatrixXd a = by_own_faces(part);
  Eigen::MatrixXd system = rest * part.softened;
  system.diagonal().array() += opened;
  CutLoad load;
  load.traction = traction;
  load.borne = system.partialPivLu().solve(moved.head(part.rank) - opened * (a * push));
  const Eigen::VectorXd taken = part.less.asDiagonal() * (part.softened * load.borne);
  load.apart = moved.tail(moved.size() - part.rank) + rest * (a.transpose() * taken) +
               rest * (own_jumps(part) * push);
  load.apart[0] += part.pressed * traction[0];
  return load;
}

double PartialCuts::release(std::size_t k, const CutLoad& one, const CutLoad& other) const {
  const Part& part = parts_[k];
  const Eigen::VectorXd taken = part.less.asDiagonal() * (part.softened * other.borne);
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
    sum += 0.5 * moved.dot(part.held * moved);
  }
  return sum;
}

}  // namespace perifrac
