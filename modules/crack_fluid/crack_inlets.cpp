#include "modules/crack_fluid/crack_inlets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/config/mistakes.hpp"

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
      double square = 0.0;
      for (int a = 0; a < facets.dimension; ++a) {
        const double off = facets.position[a][f] - inlets_[k].at[a];
        square += off * off;
      }
      return std::sqrt(square);
    };
    double nearest = infinity;
    for (Index f = 0; f < graph.facet_count(); ++f) nearest = std::min(nearest, distance(f));
    facets_[k].clear();
    share_[k].clear();
    double area = 0.0;
    for (Index f = 0; f < graph.facet_count(); ++f) {
      const double size = facets.dimension == 2 ? graph.area(f) : std::sqrt(graph.area(f));
      if (distance(f) > nearest + 1e-6 * size) continue;
      facets_[k].push_back(f);
      share_[k].push_back(graph.area(f));
      area += graph.area(f);
    }
    for (double& share : share_[k]) share /= area;
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
       .meaning = "rate: volume per time at zero pressure, times the schedule; negative takes out "
                  "what there is."},
      {.path = "inlets[].volume_rate",
       .unit = "m^3/s",
       .meaning = "In 3D, in place of rate: the same."},
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
                  "gets half. 2D."},
  };
  const KeyTable schedule = schedule_keys("inlets[].");
  keys.insert(keys.end(), schedule.begin(), schedule.end());
  return keys;
}

namespace {

/// What an inlet brings, in the unit of the scene's dimension.
double read_rate(const Section& section, const std::string& inlet) {
  const bool flat = section.scene().integer("dimension") == 2;
  const std::string own = inlet + (flat ? ".rate" : ".volume_rate");
  const std::string other = inlet + (flat ? ".volume_rate" : ".rate");
  if (section.has(other)) {
    section.fail(other, flat ? "in 2D" : "in 3D", flat ? "rate in m^2/s" : "volume_rate in m^3/s");
  }
  if (!section.has(own)) {
    section.fail(inlet, flat ? "missing key 'rate'" : "missing key 'volume_rate'",
                 flat ? "a number in m^2/s" : "a number in m^3/s");
  }
  return section.number(own);
}

CrackInlet read_inlet(const Section& section, const std::string& path, double part) {
  CrackInlet inlet{.name = section.text(path + ".name"),
                   .at = {},
                   .holds_pressure = section.word(path + ".holds") == "pressure",
                   .amount = 0.0,
                   .schedule = read_schedule(section, path),
                   .from_fluid = section.word(path + ".holds") == "fluid"};
  if (inlet.holds_pressure) {
    inlet.amount = section.number(path + ".pressure");
  } else if (!inlet.from_fluid) {
    inlet.amount = part * read_rate(section, path);
  }
  std::ranges::copy(section.numbers(path + ".at"), inlet.at.begin());
  return inlet;
}

}  // namespace

std::vector<CrackInlet> read_crack_inlets(const Section& section) {
  const double part = section.word("counts") == "both" ? 0.5 : 1.0;
  std::vector<CrackInlet> inlets;
  Mistakes mistakes;
  for (std::size_t k = 0; k < section.count("inlets"); ++k) {
    mistakes.note(
        [&] { inlets.push_back(read_inlet(section, fmt::format("inlets[{}]", k), part)); });
  }
  mistakes.throw_if_any();
  return inlets;
}

}  // namespace perifrac
