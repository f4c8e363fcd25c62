#include <algorithm>
#include <cmath>

#include "app/references/comparison.hpp"
#include "app/references/crack_viscosity.hpp"
#include "app/references/reference_types.hpp"
#include "core/body/crack_seeds.hpp"

namespace perifrac {

namespace {

const std::string slit_flow_problem = "flow through one straight slit between two pressures";

/// A facet whose pressure is held.
struct End {
  Vector<2> at;
  double pressure;
};

struct Slit {
  End from, to;
  double conductivity;  ///< w^3 / (12 mu) [m^3/(Pa s)]
  double length;        ///< [m]

  double flow_rate() const { return conductivity * (from.pressure - to.pressure) / length; }
  double pressure(double distance) const {
    return from.pressure + distance / length * (to.pressure - from.pressure);
  }
};

double distance(const PointSet& facets, std::size_t f, const Vector<2>& place) {
  return std::hypot(facets.position[0][f] - place[0], facets.position[1][f] - place[1]);
}

/// Inlets hold the pressure at the centre of the nearest facet.
End read_end(const Section& scene, const std::string& inlet, const PointSet& facets) {
  const std::vector<double> x = scene.numbers(inlet + ".at");
  const Vector<2> place = {x[0], x[1]};
  std::size_t nearest = 0;
  for (std::size_t f = 1; f < facets.count; ++f) {
    if (distance(facets, f, place) < distance(facets, nearest, place)) nearest = f;
  }
  return {{facets.position[0][nearest], facets.position[1][nearest]},
          scene.number(inlet + ".pressure")};
}

Slit read_slit(const Section& scene, const PointSet& facets) {
  require_word(scene, slit_flow_problem, "solid.type", {"rigid"});
  require_word(scene, slit_flow_problem, "crack_fluid.leak_off", {"none"});
  if (scene.count("cracks") != 1 || read_crack_corners(scene, 0).size() != 2 ||
      scene.count("crack_fluid.inlets") != 2 || scene.count("crack_fluid.wells") > 0 ||
      !scene.has("crack_fluid.inlets[0].pressure") ||
      !scene.has("crack_fluid.inlets[1].pressure")) {
    scene.fail("reference.type", "this scene is not " + slit_flow_problem,
               "one crack of one leg, and an inlet with a pressure at each of its ends");
  }
  Slit slit{.from = read_end(scene, "crack_fluid.inlets[0]", facets),
            .to = read_end(scene, "crack_fluid.inlets[1]", facets),
            .conductivity =
                std::pow(scene.number("cracks[0].opening"), 3) / (12.0 * crack_viscosity(scene)),
            .length = 0.0};
  slit.length = std::hypot(slit.to.at[0] - slit.from.at[0], slit.to.at[1] - slit.from.at[1]);
  if (!(slit.flow_rate() > 0.0)) {
    scene.fail("reference.type", "nothing flows",
               "a slit that is open, and more pressure at the first inlet than at the second");
  }
  return slit;
}

}  // namespace

std::unique_ptr<Reference> make_slit_flow_reference(const Section& scene,
                                                    const Simulation& simulation) {
  const Field rate = field_named(*simulation.manager, "crack_flow_rate");
  const Field pressure = field_named(*simulation.manager, "crack_pressure");
  const PointSet& facets = rate.points();
  const Slit slit = read_slit(scene, facets);
  std::vector<std::size_t> between;
  std::vector<double> along;
  for (std::size_t f = 0; f < facets.count; ++f) {
    const double x = distance(facets, f, slit.from.at);
    if (x < 0.01 * slit.length || distance(facets, f, slit.to.at) < 0.01 * slit.length) continue;
    between.push_back(f);
    along.push_back(x);
  }
  const auto largest = [between](auto&& error_of) {
    return [=](double) {
      double error = 0.0;
      for (std::size_t n = 0; n < between.size(); ++n) error = std::max(error, error_of(n));
      return error;
    };
  };

  auto reference = std::make_unique<Reference>("slit_flow", "the cubic law", 0.0);
  // From the crack's first end to its second, whichever inlet lies there.
  reference->add(Reference::Error{"flow_rate_error", largest([=](std::size_t n) {
                                    const double computed = std::abs(rate.values()[between[n]]);
                                    return std::abs(computed / slit.flow_rate() - 1.0);
                                  })});
  reference->add(Reference::Error{"pressure_error", largest([=](std::size_t n) {
                                    return std::abs(pressure.values()[between[n]] -
                                                    slit.pressure(along[n])) /
                                           (slit.from.pressure - slit.to.pressure);
                                  })});
  reference->add(
      Reference::History{"flow rate at the middle", "m^2/s",
                         [=] { return std::abs(rate.values()[between[between.size() / 2]]); },
                         [=](double) { return slit.flow_rate(); }});
  reference->add(
      Reference::Profile{.name = "pressure along the slit",
                         .unit = "Pa",
                         .x_name = "distance",
                         .x = along,
                         .computed = [=](std::size_t n) { return pressure.values()[between[n]]; },
                         .exact = [=](double x, double) { return slit.pressure(x); }});
  return reference;
}

}  // namespace perifrac
