#include "modules/crack_fluid/crack_inlets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.hpp"

namespace perifrac {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

CrackInlets::CrackInlets(std::vector<CrackInlet> inlets, const CrackLiquid& liquid)
    : inlets_(std::move(inlets)),
      liquid_(liquid),
      supply_(inlets_.size()),
      facets_(inlets_.size()),
      share_(inlets_.size()) {}

void CrackInlets::locate(const PointSet& facets, const CrackGraph& graph) {
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    const auto distance = [&](Index f) {
      return std::hypot(facets.position[0][f] - inlets_[k].at[0],
                        facets.position[1][f] - inlets_[k].at[1]);
    };
    double nearest = infinity;
    for (Index f = 0; f < graph.facet_count(); ++f) nearest = std::min(nearest, distance(f));
    facets_[k].clear();
    share_[k].clear();
    double length = 0.0;
    for (Index f = 0; f < graph.facet_count(); ++f) {
      if (distance(f) > nearest + 1e-6 * graph.length(f)) continue;
      facets_[k].push_back(f);
      share_[k].push_back(graph.length(f));
      length += graph.length(f);
    }
    for (double& share : share_[k]) share /= length;
  }
}

std::span<const FacetInflow> CrackInlets::inflows(const TimeWindow& step) {
  inflows_.clear();
  for (std::size_t k = 0; k < inlets_.size(); ++k) {
    const CrackInlet& inlet = inlets_[k];
    for (std::size_t n = 0; n < facets_[k].size(); ++n) {
      FacetInflow inflow{
          .facet = facets_[k][n], .least = 0.0, .most = 0.0, .target = liquid_.vapour_pressure};
      if (std::ranges::count(inflows_, inflow.facet, &FacetInflow::facet) > 0) {
        throw NumericalError("crack_pressure", fmt::format("inlet '{}'", inlet.name), step.begin,
                             "a facet that serves another inlet too");
      }
      const bool holds = inlet.from_fluid ? supply_[k].stiffness > 0.0 : inlet.holds_pressure;
      if (holds && step.length() > 0.0) {
        const double pressure =
            inlet.from_fluid ? supply_[k].pressure : inlet.amount * inlet.schedule.factor(step.end);
        inflow.least = -infinity;
        inflow.most = infinity;
        inflow.target = std::max(inflow.target, pressure);
        if (inlet.from_fluid) inflow.stiffness = supply_[k].stiffness;
      } else if (!inlet.holds_pressure && !inlet.from_fluid) {
        const double mass = liquid_.density * inlet.amount * share_[k][n] *
                            inlet.schedule.integral(step.begin, step.end);
        inflow.least = mass;
        inflow.most = std::max(mass, 0.0);
      }
      inflows_.push_back(inflow);
    }
  }
  return inflows_;
}

KeyTable crack_inlet_keys() {
  KeyTable keys = {
      {.path = "inlets[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of a place where fluid is pumped into the crack."},
      {.path = "inlets[].at",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its place; the nearest piece of crack takes the fluid."},
      {.path = "inlets[].holds",
       .type = KeyType::word,
       .fallback = "rate",
       .words = {"rate", "pressure", "fluid"},
       .meaning = "What is prescribed there. fluid: the pressure of the free fluid that the crack "
                  "opens into, which gives what the crack takes."},
      {.path = "inlets[].rate",
       .unit = "m^2/s",
       .required = true,
       .when = "holds=rate",
       .meaning = "Volume per time at zero pressure, times the schedule; negative takes out what "
                  "there is."},
      {.path = "inlets[].pressure",
       .unit = "Pa",
       .required = true,
       .when = "holds=pressure",
       .meaning = "Pressure, times the schedule; fluid comes and goes as it must."},
      {.path = "counts",
       .type = KeyType::word,
       .fallback = "one_wing",
       .words = {"one_wing", "both"},
       .meaning = "both: the rates feed two wings of a crack of which the scene holds one, which "
                  "gets half."},
  };
  const KeyTable schedule = schedule_keys("inlets[].");
  keys.insert(keys.end(), schedule.begin(), schedule.end());
  return keys;
}

std::vector<CrackInlet> read_crack_inlets(const Section& section) {
  const double part = section.word("counts") == "both" ? 0.5 : 1.0;
  std::vector<CrackInlet> inlets;
  for (std::size_t k = 0; k < section.count("inlets"); ++k) {
    const std::string path = fmt::format("inlets[{}]", k);
    CrackInlet inlet{.name = section.text(path + ".name"),
                     .at = {},
                     .holds_pressure = section.word(path + ".holds") == "pressure",
                     .amount = 0.0,
                     .schedule = read_schedule(section, path),
                     .from_fluid = section.word(path + ".holds") == "fluid"};
    if (inlet.holds_pressure) {
      inlet.amount = section.number(path + ".pressure");
    } else if (!inlet.from_fluid) {
      inlet.amount = part * section.number(path + ".rate");
    } else if (!section.scene().has("fluid")) {
      section.fail(path + ".holds", "the scene has no section 'fluid'", "rate or pressure");
    }
    std::ranges::copy(section.numbers(path + ".at"), inlet.at.begin());
    inlets.push_back(std::move(inlet));
  }
  return inlets;
}

}  // namespace perifrac
