#include "core/solvers/complementarity.hpp"

#include <Eigen/Dense>

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

void find_values(const Eigen::Ref<const Eigen::MatrixXd>& m, const Eigen::VectorXd& q,
                 Complementarity& answer) {
  const std::vector<int> held = places_of(answer.held);
  answer.x.setZero(q.size());
  answer.y = q;
  if (held.empty()) return;
  const Eigen::MatrixXd own = m(held, held);
  const Eigen::VectorXd pushed = own.partialPivLu().solve(-q(held));
  answer.x(held) = pushed;
  answer.y.noalias() += m(Eigen::all, held) * pushed;
  for (const int i : held) answer.y[i] = 0.0;
}

}  // namespace

Complementarity solve_complementarity(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                      const Eigen::VectorXd& q, double rounding) {
  const Eigen::Index count = q.size();
  Complementarity answer{Eigen::VectorXd::Zero(count), q, std::vector<bool>(count, false)};
  Eigen::Index fewest = count + 1;
  int left = patience;
  for (Eigen::Index trial = 0; trial < 100 + 10 * count; ++trial) {
    std::vector<Eigen::Index> wrong;
    for (Eigen::Index i = 0; i < count; ++i) {
      const bool overlaps = answer.y[i] < -rounding && m(i, i) > 0.0;
      if (answer.held[i] ? answer.x[i] < 0.0 : overlaps) wrong.push_back(i);
    }
    if (wrong.empty()) return answer;
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

Eigen::MatrixXd response_with_held(const Eigen::Ref<const Eigen::MatrixXd>& m,
                                   const std::vector<bool>& held) {
  const std::vector<int> places = places_of(held);
  if (places.empty()) return m;
  const Eigen::MatrixXd own = m(places, places);
  Eigen::MatrixXd result =
      m - m(Eigen::all, places) * own.partialPivLu().solve(Eigen::MatrixXd(m(places, Eigen::all)));
  result(places, Eigen::all).setZero();
  return result;
}

}  // namespace perifrac
