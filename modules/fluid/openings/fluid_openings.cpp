#include "modules/fluid/openings/fluid_openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "modules/fluid/openings/named_box.hpp"

namespace perifrac {

namespace {

/// The box that holds everything at the start.
template <int D>
Region<D> box_of_all(const Section& section, const Body<D>* body, const WallCloud<D>& cloud) {
  Region<D> all;
  all.from.fill(std::numeric_limits<double>::infinity());
  all.to.fill(-std::numeric_limits<double>::infinity());
  const auto include = [&](const Vector<D>& low, const Vector<D>& high) {
    for (int a = 0; a < D; ++a) {
      all.from[a] = std::min(all.from[a], low[a]);
      all.to[a] = std::max(all.to[a], high[a]);
    }
  };
  for (const char* list : {"blocks", "inlets", "outlets"}) {
    for (std::size_t k = 0; k < section.count(list); ++k) {
      const Region<D> box = read_named_box<D>(section, fmt::format("{}[{}]", list, k));
      include(box.from, box.to);
    }
  }
  for (Index w = 0; w < cloud.size(); ++w) include(cloud.at(w), cloud.at(w));
  for (Index i = 0; body != nullptr && i < body->points().size(); ++i) {
    include(body->points().at(i), body->points().at(i));
  }
  return all;
}

}  // namespace

template <int D>
FluidOpenings<D> read_fluid_openings(const Section& section, const Body<D>* body,
                                     const FluidWalls<D>& walls, const FluidProperties& fluid,
                                     double spacing) {
  FluidOpenings<D> openings{.inlets = nullptr,
                            .outlets = nullptr,
                            .domain = read_fluid_domain<D>(
                                section, box_of_all(section, body, walls.cloud), walls.period)};
  std::vector<Inlet<D>> inlets = read_inlets<D>(section, spacing);
  if (!inlets.empty()) {
    openings.inlets = std::make_unique<Inlets<D>>(
        std::move(inlets), fluid, fluid.density * std::pow(spacing, D), walls.period);
  }
  std::vector<Region<D>> outlets = read_outlets<D>(section);
  if (!outlets.empty()) {
    openings.outlets = std::make_unique<Outlets<D>>(std::move(outlets), walls.period);
  }
  return openings;
}

template FluidOpenings<2> read_fluid_openings<2>(const Section&, const Body<2>*,
                                                 const FluidWalls<2>&, const FluidProperties&,
                                                 double);
template FluidOpenings<3> read_fluid_openings<3>(const Section&, const Body<3>*,
                                                 const FluidWalls<3>&, const FluidProperties&,
                                                 double);

}  // namespace perifrac
