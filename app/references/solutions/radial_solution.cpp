#include "app/references/solutions/radial_solution.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

/// Each of two corners' values by its part in the tip: of toughness `share`.
double between(double viscosity, double toughness, double share) {
  return viscosity + share * (toughness - viscosity);
}

double profile(double x, double tip, double outer) {
  return std::pow(1.0 + x, outer) * std::pow(1.0 - x, tip);
}

/// Calls f(x, width) in the middle of intervals from the edge, x = 1, inwards to 0. Equal steps of
/// the angle whose cosine squared is x: fine at the edge and about the source.
template <class Function>
void for_each_ring(Function f) {
  constexpr int count = 400;
  constexpr double step = 0.5 * M_PI / count;
  for (int n = 0; n < count; ++n) {
    const double angle = (n + 0.5) * step;
    f(std::cos(angle) * std::cos(angle), std::sin(2.0 * angle) * step);
  }
}

}  // namespace

double RadialProblem::toughness() const {
  return std::sqrt(32.0 / M_PI * plane_strain_modulus * fracture_energy);
}

double RadialProblem::dimensionless_toughness(double t) const {
  return toughness() * std::pow(t * t /
                                    (std::pow(12.0 * viscosity, 5) * std::pow(rate, 3) *
                                     std::pow(plane_strain_modulus, 13)),
                                1.0 / 18.0);
}

RadialSolution::Shape RadialSolution::shape_of(double radius, double t) const {
  const double modulus = problem_.plane_strain_modulus;
  // Of the tip's opening at the distance of the radius, cubed: w^3 = tough + viscous.
  const double tough = std::pow(problem_.toughness() * std::sqrt(radius) / modulus, 3);
  const double at_unit_growth =
      2.0 * std::pow(3.0, 2.5) * 12.0 * problem_.viscosity * std::pow(radius, 3) / (modulus * t);
  double share = 0.0;
  double growth = 4.0 / 9.0;
  for (int pass = 0; pass < 50; ++pass) {
    share = tough / (tough + growth * at_unit_growth);
    const double next = between(4.0 / 9.0, 2.0 / 5.0, share);
    if (std::abs(next - growth) < 1e-15) break;
    growth = next;
  }
  Shape shape{.radius = radius,
              .middle = 0.0,
              .tip = between(2.0 / 3.0, 0.5, share),
              .outer = between(0.487, 0.5, share),
              .growth = growth,
              .moment = 0.0};
  shape.middle = std::cbrt(tough + growth * at_unit_growth) * std::pow(2.0, -shape.outer);
  for_each_ring([&](double x, double width) {
    shape.moment += x * profile(x, shape.tip, shape.outer) * width;
  });
  return shape;
}

/// The radius at which it holds what was pumped in. The volume goes with a power of the radius of
/// about 2.5 to 3.
RadialSolution::Shape RadialSolution::shape_at(double t) const {
  const double injected = problem_.rate * t;
  double radius = std::cbrt(injected);
  Shape shape = shape_of(radius, t);
  for (int pass = 0; pass < 200; ++pass) {
    const double volume = 2.0 * M_PI * radius * radius * shape.middle * shape.moment;
    const double power = 1.0 + 3.0 * shape.tip;
    const double change = std::pow(injected / volume, 1.0 / power);
    radius *= change;
    shape = shape_of(radius, t);
    if (!(std::abs(change - 1.0) > 1e-13)) break;
  }
  return shape;
}

double RadialSolution::radius(double t) const { return shape_at(t).radius; }

double RadialSolution::opening(double r, double t) const {
  const Shape shape = shape_at(t);
  const double x = r / shape.radius;
  return x < 1.0 ? shape.middle * profile(x, shape.tip, shape.outer) : 0.0;
}

double RadialSolution::source_pressure(double source, double t) const {
  const Shape shape = shape_at(t);
  const double rim = source / shape.radius;
  const double rate = problem_.rate;
  double beyond = 0.0;  // of the volume's moment, farther out
  double fall = 0.0;    // from the mean over the source to the weighted mean
  for_each_ring([&](double x, double width) {
    const double open = profile(x, shape.tip, shape.outer);
    const double here = x * open * width;
    const double within = std::max(0.0, 1.0 - x * x / (rim * rim));
    // What passes x: the growth of what lies farther out, less what enters there.
    const double flow =
        rate * ((beyond + 0.5 * here + shape.growth * x * x * open) / shape.moment - within);
    beyond += here;
    const double slope =
        12.0 * problem_.viscosity * flow / (2.0 * M_PI * x * std::pow(shape.middle * open, 3));
    fall += slope * (std::pow(1.0 - x * x, 1.5) - within) * width;
  });
  return 3.0 * problem_.plane_strain_modulus * rate * t / (16.0 * std::pow(shape.radius, 3)) + fall;
}

}  // namespace perifrac
