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

class Search {
 public:
  Search(const Eigen::MatrixXd& m, const Eigen::VectorXd& q, double coefficient, double rounding)
      : m_(m),
        q_(q),
        count_(q.size() / 2),
        coefficient_(coefficient),
        rounding_(rounding),
        pairs_(count_, PairState::open) {}

  FrictionalContact run(std::span<const PairState> guess) {
    if (std::ssize(guess) == count_) {
      pairs_.assign(guess.begin(), guess.end());
      if (newton()) return {x_, y_};
      pairs_.assign(count_, PairState::open);
    }
    const Complementarity smooth =
        solve_complementarity(m_.topLeftCorner(count_, count_), q_.head(count_), rounding_);
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
  bool can_slip(Eigen::Index i) const { return m_(count_ + i, count_ + i) > 0.0; }
  bool can_open(Eigen::Index i) const { return m_(i, i) > 0.0; }
  static double direction(PairState pair) {
    return pair == PairState::forward ? 1.0 : pair == PairState::backward ? -1.0 : 0.0;
  }

  /// What x and y are where every pair is in its present state.
  void find_values() {
    std::vector<Eigen::Index> held;
    for (Eigen::Index i = 0; i < count_; ++i) {
      if (pairs_[i] != PairState::open) held.push_back(i);
    }
    for (Eigen::Index i = 0; i < count_; ++i) {
      if (pairs_[i] == PairState::stick) held.push_back(count_ + i);
    }
    x_.setZero(q_.size());
    y_ = q_;
    if (held.empty()) return;
    Eigen::MatrixXd columns = m_(Eigen::all, held);
    for (std::size_t k = 0; k < held.size() && held[k] < count_; ++k) {
      const double way = direction(pairs_[held[k]]);
      if (way != 0.0) columns.col(k) -= way * coefficient_ * m_.col(count_ + held[k]);
    }
    const Eigen::MatrixXd own = columns(held, Eigen::all);
    const Eigen::VectorXd found = own.partialPivLu().solve(-q_(held));
    x_(held) = found;
    y_.noalias() += columns * found;
    for (const Eigen::Index k : held) y_[k] = 0.0;
    for (Eigen::Index i = 0; i < count_; ++i) {
      const double way = direction(pairs_[i]);
      if (way != 0.0) x_[count_ + i] = -way * coefficient_ * x_[i];
    }
  }

  /// What a pair is to be by its present values.
  PairState next(Eigen::Index i) const {
    const Eigen::Index t = count_ + i;
    switch (pairs_[i]) {
      case PairState::open:
        if (!can_open(i) || !(y_[i] < -rounding_)) return PairState::open;
        if (!can_slip(i)) return PairState::forward;
        if (std::abs(y_[t] / m_(t, t)) <= coefficient_ * -y_[i] / m_(i, i)) return PairState::stick;
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
    Eigen::VectorXd y = q_ + m_ * x;
    for (Eigen::Index i = 0; i < count_; ++i) {
      if (!can_open(i)) continue;
      const Eigen::Index t = count_ + i;
      const Eigen::Vector2d before(x[i], x[t]);
      const Eigen::Vector2d others(y[i] - m_(i, i) * x[i] - m_(i, t) * x[t],
                                   y[t] - m_(t, i) * x[i] - m_(t, t) * x[t]);
      pairs_[i] = relax(i, others, x);
      y += m_.col(i) * (x[i] - before[0]) + m_.col(t) * (x[t] - before[1]);
    }
  }

  /// `y`: without the pair's own x.
  PairState relax(Eigen::Index i, const Eigen::Vector2d& y, Eigen::VectorXd& x) const {
    const Eigen::Index t = count_ + i;
    x[i] = x[t] = 0.0;
    if (y[0] >= 0.0) return PairState::open;
    const double determinant = m_(i, i) * m_(t, t) - m_(i, t) * m_(t, i);
    if (can_slip(i)) {
      const double normal = (m_(i, t) * y[1] - m_(t, t) * y[0]) / determinant;
      const double tangential = (m_(t, i) * y[0] - m_(i, i) * y[1]) / determinant;
      if (normal >= 0.0 && std::abs(tangential) <= coefficient_ * normal) {
        x[i] = normal;
        x[t] = tangential;
        return PairState::stick;
      }
    }
    for (const PairState pair : {PairState::forward, PairState::backward}) {
      const double way = direction(pair);
      const double normal = -y[0] / (m_(i, i) - way * coefficient_ * m_(i, t));
      const double slip = y[1] + (m_(t, i) - way * coefficient_ * m_(t, t)) * normal;
      if (normal < 0.0 || way * slip < 0.0) continue;
      x[i] = normal;
      x[t] = -way * coefficient_ * normal;
      return pair;
    }
    return PairState::open;
  }

  const Eigen::MatrixXd& m_;
  const Eigen::VectorXd& q_;
  Eigen::Index count_;
  double coefficient_, rounding_;
  std::vector<PairState> pairs_;
  Eigen::VectorXd x_, y_;
};

}  // namespace

FrictionalContact solve_frictional_contact(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                           double coefficient, double rounding,
                                           std::span<const PairState> guess) {
  return Search(m, q, coefficient, rounding).run(guess);
}

}  // namespace perifrac
