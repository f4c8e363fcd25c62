#include "core/solvers/complementarity.hpp"

#include <utility>

namespace perifrac {

namespace {

/// All are exchanged at once so often without progress before they are one by one.
constexpr int patience = 10;

std::vector<int> places_of(const std::vector<bool>& held) {
  std::vector<int> places;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i]) places.push_back(static_cast<int>(i));
  }
  return places;
}

}  // namespace

const Eigen::PartialPivLU<Eigen::MatrixXd>& ComplementaritySolver::factor(
    const Eigen::Ref<const Eigen::MatrixXd>& m, const std::vector<int>& places) {
  Eigen::MatrixXd block = m(places, places);
  if (block.rows() != block_.rows() || block != block_) {
    factor_.compute(block);
    block_ = std::move(block);
  }
  return factor_;
}

void ComplementaritySolver::find_values(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                        const Eigen::VectorXd& q, Complementarity& answer) {
  const std::vector<int> held = places_of(answer.held);
  answer.x.setZero(q.size());
  answer.y = q;
  if (held.empty()) return;
  const Eigen::VectorXd pushed = factor(m, held).solve(-q(held));
  answer.x(held) = pushed;
  for (std::size_t k = 0; k < held.size(); ++k) answer.y += pushed[k] * m.col(held[k]);
  for (const int i : held) answer.y[i] = 0.0;
}

Complementarity ComplementaritySolver::solve(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                             const Eigen::VectorXd& q, double rounding) {
  const Eigen::Index count = q.size();
  held_.resize(count, false);
  for (Eigen::Index i = 0; i < count; ++i) held_[i] = held_[i] && m(i, i) > 0.0;
  Complementarity answer{Eigen::VectorXd::Zero(count), q, held_};
  find_values(m, q, answer);
  Eigen::Index fewest = count + 1;
  int left = patience;
  for (Eigen::Index trial = 0; trial < 100 + 10 * count; ++trial) {
    std::vector<Eigen::Index> wrong;
    for (Eigen::Index i = 0; i < count; ++i) {
      const bool overlaps = answer.y[i] < -rounding && m(i, i) > 0.0;
      if (answer.held[i] ? answer.x[i] < 0.0 : overlaps) wrong.push_back(i);
    }
    if (wrong.empty()) {
      held_ = answer.held;
      return answer;
    }
    if (static_cast<Eigen::Index>(wrong.size()) < fewest) {
      fewest = static_cast<Eigen::Index>(wrong.size());
      left = patience;
    } else if (left-- <= 0) {
      wrong = {wrong.back()};  // which comes to an end whatever M, if slowly (Murty 1974)
    }
    for (const Eigen::Index i : wrong) answer.held[i] = !answer.held[i];
    find_values(m, q, answer);
  }
  throw NoContact("no solution of a complementarity problem");
}

Eigen::MatrixXd ComplementaritySolver::response(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                                Eigen::MatrixXd a) {
  const std::vector<int> held = places_of(held_);
  if (held.empty()) return a;
  const Eigen::MatrixXd own = a(held, Eigen::all);
  const Eigen::MatrixXd columns = m(Eigen::all, held);
  a.noalias() -= columns * factor(m, held).solve(own);
  a(held, Eigen::all).setZero();
  return a;
}

Complementarity solve_complementarity(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                      const Eigen::VectorXd& q, double rounding) {
  return ComplementaritySolver().solve(m, q, rounding);
}

}  // namespace perifrac
