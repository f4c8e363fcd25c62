#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/references/comparison.hpp"
#include "app/references/free_fluid.hpp"
#include "app/references/moving_points.hpp"
#include "app/references/reference_types.hpp"
#include "app/references/rock.hpp"
#include "app/references/solutions/seepage_solution.hpp"

namespace perifrac {

namespace {

const std::string constant_head_problem = "a constant head test";

/// What presses on the water: the area it fills, and the pressure that comes of it.
struct Piston {
  double area;
  double pressure;
  Schedule schedule;
};

[[noreturn]] void refuse(const Section& scene, const char* expected) {
  scene.fail("reference.type", "this scene is not " + constant_head_problem, expected);
}

Piston read_piston(const Section& scene) {
  const int vertical = scene.integer("dimension") - 1;
  if (scene.count("fluid.walls") != 1) refuse(scene, "one item under fluid.walls");
  require_word(scene, constant_head_problem, "fluid.walls[0].motion", {"piston"});
  const Box container = read_box(scene, "fluid.container");
  Piston piston{.area = 1.0,
                .pressure = -scene.numbers("fluid.walls[0].force")[vertical],
                .schedule = read_schedule(scene, "fluid.walls[0]")};
  for (int a = 0; a < vertical; ++a) piston.area *= container.size(a);
  piston.pressure /= piston.area;
  return piston;
}

SeepageProblem read_constant_head(const Section& scene, const Piston& piston) {
  const int vertical = scene.integer("dimension") - 1;
  require_word(scene, constant_head_problem, "body.shape", {"box"});
  require_section(scene, constant_head_problem, "pore_flow");
  require_word(scene, constant_head_problem, "pore_flow.boundary.bottom.type", {"pressure"});
  require_absent(scene, constant_head_problem,
                 {"gravity", "pore_flow.regions", "pore_flow.sources", "fluid.inlets",
                  "fluid.outlets", "body.boundary.top"});
  if (scene.has("solid")) require_word(scene, constant_head_problem, "solid.type", {"rigid"});
  const Section flow = scene.at("pore_flow");
  const std::vector<double> size = scene.numbers("body.size");
  const Box container = read_box(scene, "fluid.container");
  for (int a = 0; a < vertical; ++a) {
    if (std::abs(container.size(a) - size[a]) > 1e-9 * size[a]) {
      refuse(scene, "a fluid.container as wide as the body");
    }
  }
  if (flow.number("boundary.bottom.pressure") != 0.0 || flow.number("initial_pressure") != 0.0) {
    refuse(scene, "pore_flow.boundary.bottom.pressure and initial_pressure: 0 Pa");
  }
  const PorousRock pore = read_porous_rock(scene);
  const double length = size[vertical] + outside(scene, "bottom");
  SeepageProblem slab{.length = length,
                      .mobility = pore.mobility,
                      .storage = pore.storage,
                      .pressure = piston.pressure,
                      .schedule = piston.schedule};
  if (writes(scene, "pore_flow.initial_gradient")) {
    slab.initial_pressure = flow.numbers("initial_gradient")[vertical] * length;
  }
  return slab;
}

/// What the comparisons share.
struct Test {
  SeepageSolution solution;
  double head;       ///< the water's pressure in the end [Pa]
  double loaded;     ///< from when on it is steady [s]
  double end;        ///< of the run [s]
  double spacing;    ///< of the body's points [m]
  double interface;  ///< its height [m]
  double below;      ///< how far the plane that drains lies below the body's bottom [m]

  double pressure(double z, double t) const { return solution.pressure(z + below, t); }
  bool finished(std::span<const double> times) const { return times.back() >= 0.999 * end; }
};

/// A figure that a finished run has.
Reference::Figure figure(const Test& test, const std::string& name, const std::string& unit,
                         double exact, double scale, std::size_t history, auto computed) {
  return {name, unit, exact, scale, history, [=](auto times, auto values) -> std::optional<double> {
            if (!test.finished(times)) return {};
            return computed(times, values);
          }};
}

void compare_volume(Reference& reference, const Test& test, const Field& mass, double density,
                    double area) {
  const auto total = [=] { return std::reduce(mass.values().begin(), mass.values().end()); };
  const auto volume = [=, start = total()] { return (start - total()) / (density * area); };
  const auto exact = [=](double t) { return test.solution.volume(t); };
  reference.add(Reference::Error{
      "volume_error", [=](double t) { return std::abs(volume() - exact(t)) / exact(t); }});
  const std::size_t history =
      reference.add(Reference::History{"volume passed, per area", "m", volume, exact});
  reference.add(Reference::Rate{"flux into the specimen", "m/s", history});
  reference.add(figure(test, "volume passed", "m", exact(test.end), exact(test.end), history,
                       [](auto, auto values) { return values.back(); }));
  const double late = (exact(test.end) - exact(0.75 * test.end)) / (0.25 * test.end);
  reference.add(figure(test, "late flux", "m/s", late, late, history, [](auto times, auto values) {
    const std::size_t from = std::ranges::lower_bound(times, 0.75 * times.back()) - times.begin();
    return (values.back() - values[from]) / (times.back() - times[from]);
  }));
}

void compare_water(Reference& reference, const Test& test, const Field& pressure) {
  const int axis = pressure.points().dimension - 1;
  const std::size_t history = reference.add(Reference::History{
      "water pressure", "Pa", mean_between(pressure, 0, axis, -INFINITY, INFINITY),
      [=](double t) { return test.solution.water_pressure(t); }});
  reference.add(figure(test, "water pressure", "Pa", test.head, test.head, history,
                       [=](auto times, auto values) {
                         double farthest = test.head;
                         for (std::size_t n = 0; n < times.size(); ++n) {
                           if (times[n] < test.loaded) continue;
                           if (std::abs(values[n] - test.head) > std::abs(farthest - test.head)) {
                             farthest = values[n];
                           }
                         }
                         return farthest;
                       }));
}

/// Where the line through the middle half of the points of `row` meets the water's pressure; NaN
/// where it hardly rises.
template <class PressureAt>
double line_meets(const Test& test, const std::vector<Index>& row, std::span<const double> z,
                  PressureAt pressure_at) {
  double count = 0.0, sum_z = 0.0, sum_p = 0.0, sum_zz = 0.0, sum_zp = 0.0;
  for (const Index i : row) {
    if (z[i] < 0.25 * test.interface || z[i] > 0.75 * test.interface) continue;
    const double p = pressure_at(i);
    count += 1.0;
    sum_z += z[i];
    sum_p += p;
    sum_zz += z[i] * z[i];
    sum_zp += z[i] * p;
  }
  const double slope = (count * sum_zp - sum_z * sum_p) / (count * sum_zz - sum_z * sum_z);
  if (!(slope * test.interface > 0.1 * test.head)) return NAN;
  return (test.head - (sum_p - slope * sum_z) / count) / slope;
}

void compare_interface(Reference& reference, const Test& test, const Field& pore_pressure,
                       const std::vector<Index>& row) {
  const PointSet& points = pore_pressure.points();
  const std::span<const double> z = points.position[points.dimension - 1];
  const auto exact = [=](double t) {
    return line_meets(test, row, z, [&](Index i) { return test.pressure(z[i], t); });
  };
  const auto computed = [=] {
    return line_meets(test, row, z, [&](Index i) { return pore_pressure.values()[i]; });
  };
  const std::size_t history =
      reference.add(Reference::History{"height at the interface", "m", computed, exact});
  // Steady: before, the pressure in the middle says nothing about the interface.
  const double height = exact(test.end);
  if (!(std::abs(height - test.interface) < 0.5 * test.spacing)) return;
  reference.add(figure(test, "interface offset", "dx", 0.0, 1.0, history,
                       [=](auto, auto values) { return (values.back() - height) / test.spacing; }));
}

}  // namespace

std::unique_ptr<Reference> make_constant_head_reference(const Section& scene,
                                                        const Simulation& simulation) {
  const Piston piston = read_piston(scene);
  const SeepageProblem slab = read_constant_head(scene, piston);
  const SeepageSolution solution(slab);
  const PointSet& points = simulation.points();
  const int axis = points.dimension - 1;
  const bool sudden = slab.schedule.is_constant();
  const Test test{.solution = solution,
                  .head = solution.water_pressure(simulation.end),
                  .loaded = sudden ? 0.0 : slab.schedule.break_points().back(),
                  .end = simulation.end,
                  .spacing = scene.number("body.spacing"),
                  .interface = scene.numbers("body.size")[axis],
                  .below = outside(scene, "bottom")};
  const auto field = [&](const char* name) { return field_named(*simulation.manager, name); };
  const Field pore_pressure = field("pore_pressure");
  const auto exact = once_each([=](double z, double t) { return test.pressure(z, t); });

  auto reference = std::make_unique<Reference>("constant_head", "Diffusion into a slab under water",
                                               solution.time_scale());
  const std::span<const double> z = points.position[axis];
  reference->add(Reference::Error{
      "pressure_error", largest_error(pore_pressure, 0, points_inside(scene, points), test.head,
                                      [=](Index i, double t) { return exact(z[i], t); })});
  compare_volume(*reference, test, field("fluid_mass"), scene.number("fluid.density"), piston.area);
  compare_water(*reference, test, field("fluid_pressure"));
  const std::vector<Index> row = points_along(scene, points, axis, std::vector(axis + 1, 0.0));
  compare_interface(*reference, test, pore_pressure, row);
  reference->add(profile_along(row, points, axis, "pore pressure", "Pa", pore_pressure, exact));
  return reference;
}

}  // namespace perifrac
