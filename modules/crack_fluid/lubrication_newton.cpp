#include "modules/crack_fluid/lubrication_newton.hpp"

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

/// Facets answer to their neighbours alone where the solid has inertia, and to all where not.
Eigen::VectorXd solved(const Eigen::MatrixXd& jacobian, std::span<const Index> order,
                       const Eigen::VectorXd& right) {
  const Eigen::Index width = half_bandwidth(jacobian, order);
  if (8 * width < jacobian.rows()) return solve_band(jacobian, order, width, right);
  return jacobian.partialPivLu().solve(right);
}

Lubrication::Conductances conductances(int iteration) {
  using enum Lubrication::Conductances;
  return iteration >= first && (iteration - first) % round_of < calm ? held : follow;
}

/// v after its change, stopped at the edge between full and not, and where a facet is empty.
double moved(const CrackLiquid& liquid, double v, double change) {
  const double goal = v + change;
  const double edge = liquid.vapour_pressure;
  if (liquid.is_full(v) && !liquid.is_full(goal)) return edge - 1e-13 * liquid.bulk_modulus;
  if (!liquid.is_full(v) && liquid.is_full(goal)) return edge;
  return std::max(goal, liquid.empty());
}

}  // namespace

NewtonReport solve(Lubrication& lubrication, const CrackLiquid& liquid, const LubricationStep& step,
                   Eigen::VectorXd& v) {
  NewtonReport report;
  const Index count = lubrication.graph().facet_count();
  Eigen::VectorXd pressure_change(count);
  for (; report.iterations < most_iterations; ++report.iterations) {
    lubrication.evaluate(step, v);
    report.converged = is_balanced(lubrication, report.worst);
    if (report.converged) break;
    const Eigen::VectorXd change = solved(lubrication.jacobian(v, conductances(report.iterations)),
                                          lubrication.graph().order(), -lubrication.residual());
    if (!change.allFinite()) break;
    for (Index f = 0; f < count; ++f) {
      pressure_change[f] = liquid.is_full(v[f]) ? change[f] : 0.0;
    }
    const double part = part_allowed(lubrication, liquid, step.opening, pressure_change);
    for (Index f = 0; f < count; ++f) v[f] = moved(liquid, v[f], part * change[f]);
  }
  return report;
}

}  // namespace perifrac
