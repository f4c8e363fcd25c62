#include "app/run/memory.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sys/resource.h>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "core/base/ranks.hpp"
#include "core/body/crack_seeds.hpp"
#include "modules/pore_flow/flow_in_scene.hpp"
#include "modules/solid/equilibrium/cracked_solver.hpp"
#include "modules/solid/equilibrium/stiffness_solver.hpp"

namespace perifrac {

namespace {

constexpr double kilobyte = 1e3;

/// The number behind `name:` in a table of the system, in its unit of 1024 bytes; infinity where it
/// is not there.
double kilobytes_of(const char* table, const std::string& name) {
  std::ifstream file(table);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(name + ":"))
      return 1024.0 * std::strtod(line.c_str() + name.size() + 1, nullptr);
  }
  return std::numeric_limits<double>::infinity();
}

/// What the group of processes that we are in may still take; infinity where nobody limits it.
double left_in_group() {
  std::ifstream groups("/proc/self/cgroup");
  std::string path = "/";
  for (std::string line; std::getline(groups, line);) {
    if (line.starts_with("0::")) path = line.substr(3);
  }
  double most = 0.0, used = 0.0;
  const std::string folder = "/sys/fs/cgroup" + (path == "/" ? "" : path);
  std::ifstream limit(folder + "/memory.max"), current(folder + "/memory.current");
  if (limit >> most && current >> used) return std::max(0.0, most - used);
  return std::numeric_limits<double>::infinity();
}

double left_of_limit(__rlimit_resource which, const char* used) {
  rlimit limit{};
  if (getrlimit(which, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(0.0,
                  static_cast<double>(limit.rlim_cur) - kilobytes_of("/proc/self/status", used));
}

/// Of a body that is a lattice; 0 of any other.
double lattice_points(const Section& scene) {
  if (!writes(scene, "body") || !scene.has("body.spacing")) return 0.0;
  const double spacing = scene.number("body.spacing");
  double points = 1.0;
  const std::string shape = scene.word("body.shape");
  if (shape == "points") return 0.0;
  if (shape == "box") {
    for (const double length : scene.numbers("body.size"))
      points *= std::max(1.0, length / spacing);
    return points;
  }
  const int dimension = scene.integer("dimension");
  const double part = scene.word("body.part") == "octant" ? 0.5 : 1.0;
  points = std::pow(2.0 * part * scene.number("body.radius") / spacing, dimension);
  return points * (dimension == 2 ? M_PI / 4.0 : M_PI / 6.0);
}

/// How a sparse factor in 3D fills up with the number of points.
double fill(double points) { return std::cbrt(std::max(1.0, points / 1e4)); }

/// The solid's equilibrium will be solved for by multigrid (stiffness_solver.cpp), as far as the
/// scene says so.
bool takes_multigrid(const Section& scene, double points) {
  const std::string solver = scene.word("solid.linear_solver.type");
  const int dimension = scene.integer("dimension");
  const double worth =
      has_cracks(scene) ? points_worth_iteration(dimension) : points_worth_multigrid(dimension);
  const double bonds = 4.0 / 3.0 * M_PI * std::pow(scene.number("body.horizon_ratio"), 3);
  const bool has_many_bonds =
      dimension == 3 && points * 9.0 * bonds * bonds > numbers_worth_multigrid;
  return solver != "direct" && !scene.has("solid.crack_friction") &&
         (solver == "multigrid" || points >= worth || has_many_bonds);
}

/// More than with a horizon of 2.5 spacings.
double bonds_over_usual(const Section& scene) {
  return std::pow(scene.number("body.horizon_ratio") / 2.5, scene.integer("dimension"));
}

/// Of the solid, for a point. On a lattice points share their bonds: what iterates there or steps
/// takes as much whatever the horizon is.
double solid_bytes(const Section& scene, double points) {
  const bool plane = scene.integer("dimension") == 2;
  const std::string type = scene.word("solid.type");
  if (type == "rigid") return 0.0;
  if (type == "quasi_static" && takes_multigrid(scene, points)) {
    return (plane ? 1.2 : has_cracks(scene) ? 3.0 : 2.0) * kilobyte;
  }
  const double bonds = bonds_over_usual(scene);
  if (type == "dynamic" && scene.has("body.jitter") && scene.number("body.jitter") > 0.0)
    return (plane ? 1.0 : 2.6) * bonds * kilobyte;
  if (type == "dynamic") return (plane ? 0.7 : 0.8) * kilobyte;
  return (plane ? 20.0 : 230.0 * fill(points)) * bonds * kilobyte;
}

double pore_flow_bytes(const Section& scene, double points) {
  const bool plane = scene.integer("dimension") == 2;
  const bool implicit =
      scene.has("pore_flow.integrator.type") && scene.word("pore_flow.integrator.type") == "cvode";
  if (!implicit) return (plane ? 1.0 : 4.0) * kilobyte;
  if (!factors_flow(scene.at("pore_flow"), points)) return (plane ? 2.5 : 6.0) * kilobyte;
  return (plane ? 4.0 : 25.0 * fill(points)) * kilobyte;
}

}  // namespace

double available_memory() {
  const double of_all = std::min(kilobytes_of("/proc/meminfo", "MemAvailable"), left_in_group());
  return std::min({of_all / ranks::count_here(), left_of_limit(RLIMIT_AS, "VmSize"),
                   left_of_limit(RLIMIT_DATA, "VmData")});
}

long peak_memory() {
  const double peak = kilobytes_of("/proc/self/status", "VmHWM");
  if (std::isfinite(peak)) return static_cast<long>(peak);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return 1024 * used.ru_maxrss;
}

void keep_to_free_memory() {
  const double free = available_memory();
  rlimit limit{};
  if (!std::isfinite(free) || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  const double most = free + kilobytes_of("/proc/self/status", "VmData");
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, static_cast<rlim_t>(most));
  setrlimit(RLIMIT_DATA, &limit);
}

std::optional<MemoryEstimate> estimate_memory(const Section& scene) {
  constexpr double refused_anyway = 1e8;
  const double points = lattice_points(scene);
  if (points == 0.0 || points > refused_anyway) return {};
  double bytes = 0.0;
  if (writes(scene, "solid")) bytes += solid_bytes(scene, points);
  if (writes(scene, "pore_flow")) bytes += bonds_over_usual(scene) * pore_flow_bytes(scene, points);
  return MemoryEstimate{points, bytes * points};
}

void require_memory(const Section& scene) {
  constexpr double certain = 1.5, possible = 0.5;
  const auto estimate = estimate_memory(scene);
  if (!estimate) return;
  const double available = available_memory();
  if (estimate->bytes > certain * available) {
    scene.fail("body.spacing", "a run takes " + describe(*estimate, available),
               "points farther apart, or more memory");
  }
  if (estimate->bytes > possible * available) keep_to_free_memory();
}

std::string describe(const MemoryEstimate& estimate, double available) {
  return fmt::format("about {:.2g} GB for {:.0f} points, and {:.2g} GB are free",
                     1e-9 * estimate.bytes, estimate.points, 1e-9 * available);
}

}  // namespace perifrac
