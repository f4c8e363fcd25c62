#include "modules/fluid/points/fluid_blocks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/body/most_points.hpp"
#include "core/geometry/lattice.hpp"

namespace perifrac {

KeyTable fluid_block_keys() {
  return {
      {.path = "blocks[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of a box of fluid at the start."},
      {.path = "blocks[].from",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its low corner."},
      {.path = "blocks[].to",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its high corner, whole spacings away."},
      {.path = "blocks[].pressure",
       .unit = "Pa",
       .fallback = "0 Pa",
       .meaning = "Pressure at the start; if hydrostatic at the box's highest corner."},
      {.path = "blocks[].hydrostatic",
       .type = KeyType::boolean,
       .fallback = "false",
       .meaning = "The pressure grows downwards by the fluid's weight."},
      {.path = "blocks[].velocity",
       .type = KeyType::vector,
       .unit = "m/s",
       .meaning = "Velocity at the start; at rest where left out."},
  };
}

template <int D>
std::array<int, D> cells_of_box(const Section& section, const std::string& path, double spacing) {
  const std::vector<double> from = section.numbers(path + ".from");
  const std::vector<double> to = section.numbers(path + ".to");
  double points = 1.0;
  for (int a = 0; a < D; ++a) points *= std::max((to[a] - from[a]) / spacing, 1.0);
  refuse_too_many_points(section, path, points, spacing);
  std::array<int, D> cells;
  for (int a = 0; a < D; ++a) {
    const double size = to[a] - from[a];
    cells[a] = static_cast<int>(std::lround(size / spacing));
    if (!(size > 0.0) || std::abs(size / spacing - cells[a]) > 1e-6 * cells[a]) {
      section.fail(path + ".to",
                   fmt::format("the box is {:g} m wide along axis {}", size, "xyz"[a]),
                   fmt::format("a positive multiple of the fluid's spacing, {:g} m", spacing));
    }
  }
  return cells;
}

template <int D>
Points<D> box_points(const Section& section, const std::string& path, double spacing) {
  Points<D> points = box_lattice<D>(cells_of_box<D>(section, path, spacing), spacing);
  const std::vector<double> from = section.numbers(path + ".from");
  for (int a = 0; a < D; ++a) {
    for (double& x : points.position[a]) x += from[a];
  }
  return points;
}

template <int D>
FluidPoints<D> read_fluid_blocks(const Section& section, const FluidProperties& fluid,
                                 double spacing, const Vector<D>& gravity) {
  FluidPoints<D> points;
  for (std::size_t k = 0; k < section.count("blocks"); ++k) {
    const std::string path = fmt::format("blocks[{}]", k);
    const Points<D> lattice = box_points<D>(section, path, spacing);
    const std::vector<double> from = section.numbers(path + ".from");
    const std::vector<double> to = section.numbers(path + ".to");
    const double top = fluid.density_at(section.number(path + ".pressure"));
    const bool hydrostatic = section.boolean(path + ".hydrostatic");
    Vector<D> velocity{};
    if (section.has(path + ".velocity")) {
      std::ranges::copy(section.numbers(path + ".velocity"), velocity.begin());
    }
    for (Index i = 0; i < lattice.size(); ++i) {
      const Vector<D> x = lattice.at(i);
      double below = 0.0;
      for (int a = 0; a < D; ++a) {
        below += gravity[a] * (x[a] - (gravity[a] > 0.0 ? from[a] : to[a]));
      }
      const double density = hydrostatic ? fluid.density_below(top, below) : top;
      points.add(x, velocity, density, density * lattice.volume[i]);
    }
  }
  return points;
}

template FluidPoints<2> read_fluid_blocks<2>(const Section&, const FluidProperties&, double,
                                             const Vector<2>&);
template FluidPoints<3> read_fluid_blocks<3>(const Section&, const FluidProperties&, double,
                                             const Vector<3>&);
template Points<2> box_points<2>(const Section&, const std::string&, double);
template Points<3> box_points<3>(const Section&, const std::string&, double);
template std::array<int, 2> cells_of_box<2>(const Section&, const std::string&, double);
template std::array<int, 3> cells_of_box<3>(const Section&, const std::string&, double);

}  // namespace perifrac
