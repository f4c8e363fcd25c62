#include "core/solvers/frictional_contact.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "core/solvers/complementarity.hpp"

namespace perifrac {

namespace {

/// Newton's method may go on so often without fewer wrong pairs.
constexpr int slip_patience = 10;
constexpr int most_rounds = 20, sweeps_a_round = 100;
constexpr double limit_tolerance = 1e-9;

/// Held places for each that is not, and each column that the change brings beside its basis, from
/// which on the base's factor is the cheaper one.
constexpr Eigen::Index many_held = 8;

}  // namespace

void FrictionalContactSolver::take(Eigen::MatrixXd base) {
  base_ = std::move(base);
  factor_ = {};
  moved_by_basis_.resize(0, 0);
  change({});
}

void FrictionalContactSolver::change(LowRankChange change) {
  const bool is_same = change.basis.rows() == change_.basis.rows() &&
                       change.basis.cols() == change_.basis.cols() && change.basis == change_.basis;
  if (!is_same) moved_by_basis_.resize(0, 0);
  change_ = std::move(change);
  left_.resize(base_.rows(), change_.right.cols());
  if (left_.cols() > 0) left_ << change_.basis * change_.of_basis, change_.left;
  moved_by_left_.resize(0, 0);
  whole_.resize(0, 0);
}

Eigen::VectorXd FrictionalContactSolver::times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = base_ * x;
  if (left_.cols() > 0) y.noalias() += left_ * (change_.right.transpose() * x);
  return y;
}

/// Of M.
Eigen::MatrixXd FrictionalContactSolver::columns(std::span<const Eigen::Index> places) const {
  Eigen::MatrixXd columns = base_(Eigen::all, places);
  if (left_.cols() > 0) columns.noalias() += left_ * change_.right(places, Eigen::all).transpose();
  return columns;
}

const Eigen::MatrixXd& FrictionalContactSolver::whole() {
  if (whole_.size() == 0) {
    whole_ = base_;
    if (left_.cols() > 0) whole_.noalias() += left_ * change_.right.transpose();
  }
  return whole_;
}

/// Places that do not answer to their own x are never held.
void FrictionalContactSolver::factor() {
  if (factor_.rows() == 0) {
    Eigen::MatrixXd base = base_;
    for (Eigen::Index i = 0; i < base.rows(); ++i) {
      if (base(i, i) > 0.0) continue;
      base.row(i).setZero();
      base(i, i) = 1.0;
    }
    factor_.compute(base);
  }
  if (moved_by_left_.cols() == left_.cols()) return;
  if (moved_by_basis_.cols() < change_.basis.cols()) moved_by_basis_ = factor_.solve(change_.basis);
  moved_by_left_.resize(left_.rows(), left_.cols());
  moved_by_left_ << moved_by_basis_ * change_.of_basis, factor_.solve(change_.left);
}

class FrictionalContactSolver::Search {
 public:
  Search(FrictionalContactSolver& m, const Eigen::VectorXd& q, double coefficient, double rounding)
      : m_(m),
        q_(q),
        count_(q.size() / 2),
        coefficient_(coefficient),
        rounding_(rounding),
        pairs_(count_, PairState::open) {}

  FrictionalContact run(std::span<const PairState> guess) {
    if (std::ssize(guess) == count_) {
      pairs_.assign(guess.begin(), guess.end());
      for (Eigen::Index i = 0; i < count_; ++i) {
        if (!can_open(i)) pairs_[i] = PairState::open;
        if (pairs_[i] == PairState::stick && !can_slip(i)) pairs_[i] = PairState::forward;
      }
      if (newton()) return {x_, y_};
      pairs_.assign(count_, PairState::open);
    }
    const Complementarity smooth =
        solve_complementarity(m_.whole().topLeftCorner(count_, count_), q_.head(count_), rounding_);
    for (Eigen::Index i = 0; i < count_; ++i) {
      if (smooth.held[i]) pairs_[i] = can_slip(i) ? PairState::stick : PairState::forward;
    }
    Eigen::VectorXd swept = Eigen::VectorXd::Zero(2 * count_);
    for (int round = 0; round < most_rounds; ++round) {
      if (newton()) return {x_, y_};
      for (int sweep = 0; sweep < sweeps_a_round; ++sweep) relax_all(swept);
    }
    throw NoContact("no solution of a contact problem with friction");
  }

 private:
  bool can_slip(Eigen::Index i) const { return m_.diagonal(count_ + i) > 0.0; }
  bool can_open(Eigen::Index i) const { return m_.diagonal(i) > 0.0; }
  static double direction(PairState pair) {
    return pair == PairState::forward ? 1.0 : pair == PairState::backward ? -1.0 : 0.0;
  }

  /// What x and y are where every pair is in its present state.
  void find_values() {
    std::vector<Eigen::Index> held, free;
    for (const bool normal : {true, false}) {
      for (Eigen::Index i = 0; i < count_; ++i) {
        const bool is_held = normal ? pairs_[i] != PairState::open : pairs_[i] == PairState::stick;
        (is_held ? held : free).push_back(normal ? i : count_ + i);
      }
    }
    x_.setZero(q_.size());
    y_ = q_;
    if (held.empty()) return;
    const auto beside = std::ssize(free) + m_.change_.left.cols();
    if (many_held * beside < std::ssize(held)) {
      find_beside_the_base(free);
    } else {
      find_held(held);
    }
    for (const Eigen::Index k : held) y_[k] = 0.0;
  }

  /// By what their states say.
  void set_free() {
    for (Eigen::Index i = 0; i < count_; ++i) {
      if (pairs_[i] == PairState::open) x_[i] = x_[count_ + i] = 0.0;
      const double way = direction(pairs_[i]);
      if (way != 0.0) x_[count_ + i] = -way * coefficient_ * x_[i];
    }
  }

  /// From y = 0 where places are held.
  void find_held(const std::vector<Eigen::Index>& held) {
    Eigen::MatrixXd columns = m_.columns(held);
    std::vector<Eigen::Index> sliding, place;
    for (std::size_t k = 0; k < held.size() && held[k] < count_; ++k) {
      if (direction(pairs_[held[k]]) == 0.0) continue;
      sliding.push_back(count_ + held[k]);
      place.push_back(static_cast<Eigen::Index>(k));
    }
    const Eigen::MatrixXd along = m_.columns(sliding);
    for (std::size_t k = 0; k < sliding.size(); ++k) {
      const double way = direction(pairs_[sliding[k] - count_]);
      columns.col(place[k]) -= way * coefficient_ * along.col(static_cast<Eigen::Index>(k));
    }
    const Eigen::MatrixXd own = columns(held, Eigen::all);
    const Eigen::VectorXd found = own.partialPivLu().solve(-q_(held));
    x_(held) = found;
    set_free();
    y_.noalias() += columns * found;
  }

  /// With y where places are free, and z = right^T x, for unknowns:
  ///   base x + left z = -q + y,   y 0 but for those.
  void find_beside_the_base(const std::vector<Eigen::Index>& free) {
    m_.factor();
    const auto open = std::ssize(free), all = open + m_.left_.cols();
    Eigen::MatrixXd moves(q_.size(), all);  // of x by them
    moves.leftCols(open).setZero();
    for (Eigen::Index k = 0; k < open; ++k) moves(free[k], k) = 1.0;
    moves.leftCols(open) = m_.factor_.solve(Eigen::MatrixXd(moves.leftCols(open)));
    moves.rightCols(all - open) = -m_.moved_by_left_;
    const Eigen::VectorXd pushed = m_.factor_.solve(-q_);
    Eigen::MatrixXd system(all, all);
    Eigen::VectorXd right(all);
    for (Eigen::Index k = 0; k < open; ++k) {
      system.row(k) = moves.row(free[k]);
      right[k] = -pushed[free[k]];
      const double way = free[k] < count_ ? 0.0 : direction(pairs_[free[k] - count_]);
      if (way == 0.0) continue;
      system.row(k) += way * coefficient_ * moves.row(free[k] - count_);
      right[k] -= way * coefficient_ * pushed[free[k] - count_];
    }
    if (all > open) {
      const Eigen::MatrixXd& change = m_.change_.right;
      system.bottomRows(all - open).noalias() = -change.transpose() * moves;
      system.diagonal().tail(all - open).array() += 1.0;
      right.tail(all - open).noalias() = change.transpose() * pushed;
    }
    x_ = pushed;
    if (all > 0) x_.noalias() += moves * system.partialPivLu().solve(right);
    set_free();
    y_.noalias() += m_.times(x_);
  }

  /// What a pair is to be by its present values.
  PairState next(Eigen::Index i) const {
    const Eigen::Index t = count_ + i;
    switch (pairs_[i]) {
      case PairState::open:
        if (!can_open(i) || !(y_[i] < -rounding_)) return PairState::open;
        if (!can_slip(i)) return PairState::forward;
        if (std::abs(y_[t] / m_.diagonal(t)) <= coefficient_ * -y_[i] / m_.diagonal(i)) {
          return PairState::stick;
        }
        return y_[t] > 0.0 ? PairState::forward : PairState::backward;
      case PairState::stick:
        if (x_[i] < 0.0) return PairState::open;
        if (std::abs(x_[t]) <= (1.0 + limit_tolerance) * coefficient_ * x_[i])
          return PairState::stick;
        return x_[t] > 0.0 ? PairState::backward : PairState::forward;
      default:
        if (x_[i] < 0.0) return PairState::open;
        if (!can_slip(i) || direction(pairs_[i]) * y_[t] >= -rounding_) return pairs_[i];
        return PairState::stick;
    }
  }

  bool newton() {
    Eigen::Index fewest = count_ + 1;
    for (int left = slip_patience; left >= 0; --left) {
      find_values();
      Eigen::Index wrong = 0;
      for (Eigen::Index i = 0; i < count_; ++i) {
        const PairState pair = next(i);
        if (pair != pairs_[i]) ++wrong;
        pairs_[i] = pair;
      }
      if (wrong == 0) return x_.allFinite();
      if (wrong < fewest) {
        fewest = wrong;
        left = slip_patience;
      }
    }
    return false;
  }

  /// Every pair in turn takes what is right beside the others as they are.
  void relax_all(Eigen::VectorXd& x) {
    const Eigen::MatrixXd& m = m_.whole();
    Eigen::VectorXd y = q_ + m * x;
    for (Eigen::Index i = 0; i < count_; ++i) {
      if (!can_open(i)) continue;
      const Eigen::Index t = count_ + i;
      const Eigen::Vector2d before(x[i], x[t]);
      const Eigen::Vector2d others(y[i] - m(i, i) * x[i] - m(i, t) * x[t],
                                   y[t] - m(t, i) * x[i] - m(t, t) * x[t]);
      pairs_[i] = relax(i, others, x);
      y += m.col(i) * (x[i] - before[0]) + m.col(t) * (x[t] - before[1]);
    }
  }

  /// `y`: without the pair's own x.
  PairState relax(Eigen::Index i, const Eigen::Vector2d& y, Eigen::VectorXd& x) const {
    const Eigen::MatrixXd& m = m_.whole();
    const Eigen::Index t = count_ + i;
    x[i] = x[t] = 0.0;
    if (y[0] >= 0.0) return PairState::open;
    const double determinant = m(i, i) * m(t, t) - m(i, t) * m(t, i);
    if (can_slip(i)) {
      const double normal = (m(i, t) * y[1] - m(t, t) * y[0]) / determinant;
      const double tangential = (m(t, i) * y[0] - m(i, i) * y[1]) / determinant;
      if (normal >= 0.0 && std::abs(tangential) <= coefficient_ * normal) {
        x[i] = normal;
        x[t] = tangential;
        return PairState::stick;
      }
    }
    for (const PairState pair : {PairState::forward, PairState::backward}) {
      const double way = direction(pair);
      const double normal = -y[0] / (m(i, i) - way * coefficient_ * m(i, t));
      const double slip = y[1] + (m(t, i) - way * coefficient_ * m(t, t)) * normal;
      if (normal < 0.0 || way * slip < 0.0) continue;
      x[i] = normal;
      x[t] = -way * coefficient_ * normal;
      return pair;
    }
    return PairState::open;
  }

  FrictionalContactSolver& m_;
  const Eigen::VectorXd& q_;
  Eigen::Index count_;
  double coefficient_, rounding_;
  std::vector<PairState> pairs_;
  Eigen::VectorXd x_, y_;
};

FrictionalContact FrictionalContactSolver::solve(const Eigen::VectorXd& q, double coefficient,
                                                 double rounding,
                                                 std::span<const PairState> guess) {
  return Search(*this, q, coefficient, rounding).run(guess);
}

}  // namespace perifrac
