#include "core/solvers/contact.hpp"

#include <Eigen/Dense>

namespace perifrac {

Contact find_contact(const Eigen::VectorXd& free, const Eigen::MatrixXd& compliance,
                     double smallest) {
  Contact contact{free, Eigen::VectorXd::Zero(free.size()), {}};
  std::vector<bool> is_closed(free.size(), false);
  // Which faces close is found by trial: those that overlap close, those that pull open.
  for (int trial = 0; trial < 100; ++trial) {
    bool changed = false;
    for (Eigen::Index f = 0; f < free.size(); ++f) {
      const bool overlaps =
          !is_closed[f] && contact.opening[f] < -smallest && compliance(f, f) > 0.0;
      const bool pulls = is_closed[f] && contact.pressure[f] < 0.0;
      if (overlaps || pulls) {
        is_closed[f] = overlaps;
        changed = true;
      }
    }
    if (!changed) break;
    contact.closed.clear();
    for (Eigen::Index f = 0; f < free.size(); ++f) {
      if (is_closed[f]) contact.closed.push_back(static_cast<int>(f));
    }
    contact.pressure.setZero();
    contact.opening = free;
    if (contact.closed.empty()) continue;
    const Eigen::MatrixXd own = compliance(contact.closed, contact.closed);
    const Eigen::VectorXd pressure = own.partialPivLu().solve(-free(contact.closed));
    contact.pressure(contact.closed) = pressure;
    contact.opening += compliance(Eigen::all, contact.closed) * pressure;
  }
  for (const int f : contact.closed) contact.opening[f] = 0.0;
  return contact;
}

Eigen::MatrixXd compliance_beside(const std::vector<int>& closed,
                                  const Eigen::MatrixXd& compliance) {
  if (closed.empty()) return compliance;
  const Eigen::MatrixXd own = compliance(closed, closed);
  Eigen::MatrixXd result =
      compliance - compliance(Eigen::all, closed) *
                       own.partialPivLu().solve(Eigen::MatrixXd(compliance(closed, Eigen::all)));
  result(closed, Eigen::all).setZero();
  return result;
}

}  // namespace perifrac
