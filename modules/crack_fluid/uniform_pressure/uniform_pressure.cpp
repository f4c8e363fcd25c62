#include "modules/crack_fluid/uniform_pressure/uniform_pressure.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {

namespace {

constexpr int most_newton_steps = 60;
/// From here on every other step is halved: pressures of several cracks may chase each other.
constexpr int patience = 20;
constexpr double balance_tolerance = 1e-12;  ///< of what a crack holds when full
/// Of the fluid's bulk modulus: below this a pressure that an inlet holds is as good as none.
constexpr double least_held_pressure = 5e-7;

}  // namespace

void UniformPressure::follow(CrackGraph graph, Eigen::VectorXd height) {
  CrackFlow::follow(std::move(graph), std::move(height));
  const Index count = graph_.facet_count();
  crack_.assign(count, -1);
  first_.clear();
  for (Index f = 0; f < count; ++f) {
    Index& number = crack_[graph_.crack(f)];
    if (number < 0) {
      number = static_cast<Index>(first_.size());
      first_.push_back(f);
    }
    crack_[f] = number;
  }
}

Eigen::VectorXd UniformPressure::by_crack(const Eigen::VectorXd& of_facets) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(crack_count());
  for (Index f = 0; f < graph_.facet_count(); ++f) sum[crack_[f]] += of_facets[f];
  return sum;
}

Eigen::VectorXd UniformPressure::by_facet(const Eigen::VectorXd& of_cracks) const {
  return of_cracks(crack_);
}

void UniformPressure::evaluate(const CrackStep& step, const Eigen::VectorXd& unknown) {
  const Eigen::VectorXd pressure = unknown.unaryExpr([&](double v) { return liquid_.pressure(v); });
  rest(step, by_facet(unknown), answer_ * pressure);
  balance_ = by_crack(residual_);
  const Eigen::VectorXd capacity = by_crack(capacity_);
  allowed_ = balance_tolerance * capacity + 1e-14 * by_crack(rounding_);
  for (Index c = 0; c < crack_count(); ++c) {
    // A pressure that is held is weighed to be a mass.
    const double weight =
        capacity[c] / std::max(std::abs(unknown[c]), least_held_pressure * liquid_.bulk_modulus);
    balance_[c] = inflows_[c].balance(unknown[c], balance_[c], weight);
    allowed_[c] += 1e-14 * std::abs(inflows_[c].total());
  }
}

Eigen::MatrixXd UniformPressure::jacobian(const CrackStep& step, const Eigen::VectorXd& unknown) {
  const Index count = crack_count();
  // Rows of facets, columns of cracks: with the faces closed that are closed.
  const Eigen::MatrixXd answer =
      closed_.empty() ? answer_ : contact_.response(step.opening.slope, answer_);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(count, count);
  for (const auto& entry : by_pressure_) {
    jacobian(crack_[entry.row()], crack_[entry.col()]) += entry.value();
  }
  for (const auto& entry : by_aperture_) {
    if (is_open(entry.row())) {
      jacobian.row(crack_[entry.row()]) += entry.value() * answer.row(entry.row());
    }
  }
  const Eigen::VectorXd by_fill = by_crack(by_fill_);
  for (Index c = 0; c < count; ++c) {
    if (!liquid_.is_full(unknown[c])) {
      jacobian.col(c).setZero();
      jacobian(c, c) = by_fill[c] / liquid_.bulk_modulus;
    }
    jacobian(c, c) += inflows_[c].slope();
  }
  return jacobian;
}

bool UniformPressure::is_balanced(FlowReport& report) const {
  double largest = -1.0;
  for (Index c = 0; c < crack_count(); ++c) {
    const double error = std::abs(balance_[c]) / allowed_[c];
    if (error <= largest) continue;
    largest = error;
    report.worst = first_[c];
  }
  return largest <= 1.0;
}

/// What has come in and what has leaked leaves each facet as full as all others of its crack. What
/// is left of the balance stays in the facet that can take most of it, so that mass is exact.
void UniformPressure::spread() {
  outflow_ = -residual_;  // which has what wells bring
  for (const CrackInflow& inflow : inflows_) {
    for (const auto& [facet, amount] : inflow.by_facet()) {
      inflow_[facet] += amount;
      outflow_[facet] += amount;
    }
  }
  const Eigen::VectorXd left = by_crack(outflow_);
  std::vector<Index> widest = first_;
  for (Index f = 0; f < graph_.facet_count(); ++f) {
    Index& most = widest[crack_[f]];
    if (capacity_[f] > capacity_[most]) most = f;
  }
  for (Index c = 0; c < crack_count(); ++c) outflow_[widest[c]] -= left[c];
}

/// What stays while the unknowns are found.
void UniformPressure::begin(const CrackStep& step) {
  perifrac::begin(step.wells);
  const Index facets = graph_.facet_count();
  answer_.setZero(facets, crack_count());
  for (Index f = 0; f < facets; ++f) {
    for (Index g = 0; g < facets; ++g) answer_(f, crack_[g]) += step.opening.slope(f, g);
  }
  inflows_.assign(crack_count(), {});
  for (const FacetInflow& inflow : step.inflows) inflows_[crack_[inflow.facet]].add(inflow);
  for (Index c = 0; c < crack_count(); ++c) {
    if (inflows_[c].order()) continue;
    throw FinalError("crack_pressure", fmt::format("the crack of facet {}", first_[c]),
                     step.time.begin,
                     "two places hold different pressures in one crack, and fluid without "
                     "viscosity flows between them without end,");
  }
}

/// One of Newton's.
Eigen::VectorXd UniformPressure::change(const CrackStep& step, const Eigen::VectorXd& unknown) {
  Eigen::MatrixXd matrix = jacobian(step, unknown);
  Eigen::VectorXd right = -balance_;
  for (Index c = 0; c < crack_count(); ++c) {
    if (!inflows_[c].holds()) continue;
    matrix.row(c).setZero();
    matrix(c, c) = 1.0;
    right[c] = inflows_[c].held_at() - unknown[c];
  }
  return matrix.partialPivLu().solve(right);
}

FlowReport UniformPressure::solve(const CrackStep& step, Eigen::VectorXd& v) {
  begin(step);
  begin_contact(step);
  Eigen::VectorXd unknown = Eigen::VectorXd::Constant(crack_count(), liquid_.empty());
  for (Index f = 0; f < graph_.facet_count(); ++f) {
    unknown[crack_[f]] = std::max(unknown[crack_[f]], v[f]);
  }
  FlowReport report;
  for (; report.iterations < most_newton_steps; ++report.iterations) {
    evaluate(step, unknown);
    report.converged = is_balanced(report) && are_settled(step.wells);
    if (report.converged) break;
    const Eigen::VectorXd by = change(step, unknown);
    if (!by.allFinite()) break;
    const double part = report.iterations < patience || report.iterations % 2 == 0 ? 1.0 : 0.5;
    for (Index c = 0; c < crack_count(); ++c) {
      // A closed crack holds next to nothing: what it is to take would press it by any amount.
      const double rise = std::min(by[c], liquid_.bulk_modulus);
      unknown[c] = liquid_.moved(unknown[c], part * rise);
    }
  }
  v = by_facet(unknown);
  // In no time nothing flows, though pressures answer: facets even out in the next window.
  if (report.converged && step.time.length() > 0.0) spread();
  return report;
}

}  // namespace perifrac
