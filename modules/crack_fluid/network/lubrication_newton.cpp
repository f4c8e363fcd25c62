#include "modules/crack_fluid/network/lubrication_newton.hpp"

#include <algorithm>
#include <cmath>

#include "core/solvers/band_lu.hpp"

namespace perifrac {

namespace {

constexpr int most_iterations = 72;
/// Where so many iterations do not do, the cubic law leads in circles: conductances are held in
/// `calm` of every `round` that follow. Of 40,000 states of lubrication_newton_test, 234 did not
/// come to an end in 40 iterations before, 5 do not in 72.
constexpr int first = 12, calm = 12, round_of = 20;
constexpr double tolerance = 1e-12;  ///< of what a facet holds when full
constexpr double widening = 3.0;     ///< most that an aperture grows in an iteration
constexpr double narrowing = 0.25;   ///< and shrinks
/// Of the residual aperture: a facet that closes stops beyond the edge, or it would stop there
/// again and again by rounding, and all others with it.
constexpr double shut = 1.0 - 1e-6;

/// The facet whose balance is farthest off, and whether even that is good enough.
bool is_balanced(const Lubrication& lubrication, Index& worst) {
  double largest = -1.0;
  for (Index f = 0; f < lubrication.graph().facet_count(); ++f) {
    const double allowed =
        tolerance * lubrication.capacity()[f] + 1e-14 * lubrication.rounding()[f];
    const double error = std::abs(lubrication.residual()[f]) / allowed;
    if (error <= largest) continue;
    largest = error;
    worst = f;
  }
  return largest <= 1.0;
}

/// The part of the change of pressures, and with it of openings, that no aperture forbids. A closed
/// facet opens once its fluid is above what presses its faces together.
double part_allowed(const Lubrication& lubrication, const CrackLiquid& liquid,
                    const CrackOpening& given, const Eigen::VectorXd& pressure_change) {
  const Eigen::VectorXd change = lubrication.opening_slope() * pressure_change;
  double part = 1.0;
  for (Index f = 0; f < lubrication.graph().facet_count(); ++f) {
    const double opening = lubrication.opening()[f];
    const double aperture = lubrication.aperture()[f];
    const double highest = widening * aperture;
    const double lowest = std::max(narrowing * aperture, shut * liquid.residual_aperture);
    const double goal = opening + change[f];
    if (const double contact = lubrication.contact(f); contact > 0.0) {
      const double most = contact + highest / given.slope(f, f);
      if (pressure_change[f] > most) part = std::min(part, most / pressure_change[f]);
      continue;
    }
    if (goal > highest) part = std::min(part, (highest - opening) / change[f]);
    if (goal < lowest && opening > liquid.residual_aperture) {
      part = std::min(part, (lowest - opening) / change[f]);
    }
  }
  return part;
}

/// Facets whose unknown no balance but their own has in it, as those of a dry crack, follow from
/// the others.
Eigen::VectorXd solved_in_parts(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& right) {
  std::vector<Index> alone, others;
  for (Index f = 0; f < jacobian.cols(); ++f) {
    const bool has_own = jacobian(f, f) != 0.0;
    const bool is_alone = has_own && (jacobian.col(f).array() != 0.0).count() == 1;
    (is_alone ? alone : others).push_back(f);
  }
  if (alone.empty()) return jacobian.partialPivLu().solve(right);
  const Eigen::MatrixXd own = jacobian(others, others);
  const Eigen::VectorXd found = own.partialPivLu().solve(right(others));
  Eigen::VectorXd solution(right.size());
  solution(others) = found;
  for (const Index f : alone) {
    solution[f] = (right[f] - jacobian.row(f)(others).dot(found)) / jacobian(f, f);
  }
  return solution;
}

/// Facets answer to their neighbours alone where the solid has inertia, and to all where not.
Eigen::VectorXd solved(const Eigen::MatrixXd& jacobian, std::span<const Index> order,
                       const Eigen::VectorXd& right) {
  const Eigen::Index width = half_bandwidth(jacobian, order);
  if (8 * width < jacobian.rows()) return solve_band(jacobian, order, width, right);
  return solved_in_parts(jacobian, right);
}

Lubrication::Conductances conductances(int iteration) {
  using enum Lubrication::Conductances;
  return iteration >= first && (iteration - first) % round_of < calm ? held : follow;
}

/// Another place to begin: facets that are dry are under the largest pressure next to them, as a
/// new one behind a thin fluid is at once.
Eigen::VectorXd filled_from_neighbours(const CrackGraph& graph, const CrackLiquid& liquid,
                                       const Eigen::VectorXd& v) {
  Eigen::VectorXd guess = v;
  for (std::size_t k = 0; k < graph.joint_count(); ++k) {
    for (const CrackGraph::Branch& a : graph.joint(k)) {
      if (liquid.is_full(v[a.facet])) continue;
      for (const CrackGraph::Branch& b : graph.joint(k)) {
        guess[a.facet] = std::max(guess[a.facet], v[b.facet]);
      }
    }
  }
  return guess;
}

}  // namespace

FlowReport solve(Lubrication& lubrication, const CrackLiquid& liquid, const CrackStep& step,
                 Eigen::VectorXd& v) {
  FlowReport report;
  begin(step.wells);
  const Index count = lubrication.graph().facet_count();
  Eigen::VectorXd pressure_change(count);
  for (; report.iterations < most_iterations; ++report.iterations) {
    lubrication.evaluate(step, v);
    report.converged = is_balanced(lubrication, report.worst) && are_settled(step.wells);
    if (report.converged) break;
    const Eigen::VectorXd change = solved(lubrication.jacobian(v, conductances(report.iterations)),
                                          lubrication.graph().order(), -lubrication.residual());
    if (!change.allFinite()) break;
    for (Index f = 0; f < count; ++f) {
      pressure_change[f] = liquid.is_full(v[f]) ? change[f] : 0.0;
    }
    const double part = part_allowed(lubrication, liquid, step.opening, pressure_change);
    for (Index f = 0; f < count; ++f) v[f] = liquid.moved(v[f], part * change[f]);
  }
  return report;
}

FlowReport Lubrication::solve(const CrackStep& step, Eigen::VectorXd& v) {
  const Eigen::VectorXd begin = v;
  const auto solved = [&] {
    begin_contact(step);
    try {
      return perifrac::solve(*this, liquid_, step, v);
    } catch (const NoContact&) {
      return FlowReport{};
    }
  };
  FlowReport report = solved();
  if (report.converged || !(step.time.length() > 0.0)) return report;
  const int iterations = report.iterations;
  v = filled_from_neighbours(graph_, liquid_, begin);
  report = solved();
  report.iterations += iterations;
  return report;
}

}  // namespace perifrac
