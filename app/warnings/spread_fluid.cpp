#include "app/warnings/spread_fluid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/references/free_fluid.hpp"
#include "app/warnings/places_of.hpp"
#include "app/warnings/wendland_kernel.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

constexpr double packing_reach = 2.5;  ///< [spacings]
/// Of it: how far aside the middle of others may lie.
constexpr double most_aside = 0.03;
constexpr double sparse = 0.5;  ///< drops that fly apart fill less
constexpr Index fewest = 10;    ///< points that have others on all sides

/// A dam break comes down to 0.97 as the pool sloshes, and back.
constexpr double least_filled_part = 0.95;

}  // namespace

template <int D>
double filled_part(const Positions<D>& places, std::span<const double> volume, double spacing) {
  const double horizon = packing_reach * spacing;
  CellGrid<D> grid;
  grid.build(places, horizon);
  Neighbours near;
  grid.find(places, horizon, near);
  double sum = 0.0;
  Index count = 0;
  for (Index i = 0; i < near.target_count(); ++i) {
    double filled = 0.0;
    Vector<D> aside = {};
    for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
      const Index j = near.other[k];
      Vector<D> off;
      for (int a = 0; a < D; ++a) off[a] = places[a][j] - places[a][i];
      const double weight = volume[j] * wendland_kernel<D>(std::sqrt(squared_norm(off)), horizon);
      filled += weight;
      for (int a = 0; a < D; ++a) aside[a] += weight * off[a];
    }
    if (filled < sparse || std::sqrt(squared_norm(aside)) > most_aside * horizon) continue;
    sum += filled;
    ++count;
  }
  return count < fewest ? 1.0 : sum / count;
}

std::optional<std::string> spread_fluid_warning(const Section& scene,
                                                const Simulation& simulation) {
  const auto mass = find_field(*simulation.manager, "fluid_mass");
  const auto density = find_field(*simulation.manager, "fluid_density");
  if (!mass || !density) return {};
  const PointSet& points = density->points();
  const double spacing = read_free_fluid(scene).spacing;
  const double whole = std::pow(spacing, points.dimension);
  const std::span<const double> masses = mass->values(), densities = density->values();
  std::vector<double> volume(points.count);
  for (std::size_t i = 0; i < volume.size(); ++i) {
    volume[i] = std::max(whole, masses[i] / densities[i]);
  }
  const double filled = points.dimension == 2
                            ? filled_part<2>(places_of<2>(points), volume, spacing)
                            : filled_part<3>(places_of<3>(points), volume, spacing);
  if (filled >= least_filled_part) return {};
  return fmt::format(
      "free fluid takes up {:.0f} % more room in the end than its mass has at its density: its "
      "points were driven apart, as by a blow, and levels and what lies on it are off by as much; "
      "begin at the pressure that bears what lies on it, or bring points closer together",
      100.0 * (1.0 / filled - 1.0));
}

template double filled_part<2>(const Positions<2>&, std::span<const double>, double);
template double filled_part<3>(const Positions<3>&, std::span<const double>, double);

}  // namespace perifrac
