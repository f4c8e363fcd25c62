#include "modules/crack_fluid/crack_inlet_keys.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/config/mistakes.hpp"

namespace perifrac {

namespace {

void append(KeyTable& keys, const KeyTable& more) {
  keys.insert(keys.end(), more.begin(), more.end());
}

KeyTable well_keys() {
  KeyTable keys = {
      {.path = "wells[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of a well: clusters of perforations at one pressure, which share its rate. "
                  "The well stores nothing, and fluid may go through it from crack to crack."},
      {.path = "wells[].rate",
       .unit = "m^2/s",
       .meaning = "Volume per time at zero pressure of all clusters, times the schedule; negative "
                  "takes out what there is."},
      {.path = "wells[].volume_rate",
       .unit = "m^3/s",
       .meaning = "In 3D, in place of rate: the same."},
      {.path = "wells[].thickness",
       .unit = "m",
       .range = "(0, inf)",
       .meaning = "2D, beside perforations: of how thick a slice of rock the rate is. What "
                  "goes through a cluster is its rate times this."},
      {.path = "wells[].clusters[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of a cluster, as of an inlet."},
      {.path = "wells[].clusters[].at",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its place; the nearest piece of crack takes the fluid."},
      {.path = "wells[].clusters[].perforations",
       .range = "(0, inf)",
       .meaning =
           "How many are open, of both wings where counts is both; left out: nothing is lost "
           "there."},
      {.path = "wells[].clusters[].diameter",
       .unit = "m",
       .range = "(0, inf)",
       .meaning = "Of a perforation. The cluster loses 8 rho q^2 / (pi^2 n^2 d^4 C^2)."},
      {.path = "wells[].clusters[].discharge_coefficient",
       .range = "(0, 1]",
       .fallback = "0.8",
       .meaning = "C of its perforations: some 0.6 when new, 0.9 when eroded."}};
  append(keys, schedule_keys("wells[]."));
  return keys;
}

}  // namespace

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
  append(keys, schedule_keys("inlets[]."));
  append(keys, well_keys());
  return keys;
}

namespace {

/// What an inlet or a well brings, in the unit of the scene's dimension.
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

std::string cluster_path(std::size_t well, std::size_t cluster) {
  return fmt::format("wells[{}].clusters[{}]", well, cluster);
}

/// R of a cluster; `part`: of what goes through its perforations the scene holds this.
double read_resistance(const Section& section, const std::string& well, const std::string& cluster,
                       double part) {
  const bool has_count = section.has(cluster + ".perforations");
  if (has_count != section.has(cluster + ".diameter")) {
    section.fail(cluster, has_count ? "missing key 'diameter'" : "missing key 'perforations'",
                 "both, or none where perforations lose nothing");
  }
  if (!has_count) return 0.0;
  const bool is_flat = section.scene().integer("dimension") == 2;
  if (is_flat && !section.has(well + ".thickness")) {
    section.fail(well, "missing key 'thickness'",
                 "a number in m: in 2D rates are per metre of it, and perforations take all");
  }
  const double whole = (is_flat ? section.number(well + ".thickness") : 1.0) / part;
  return whole * whole *
         perforation_resistance(section.number("density"),
                                section.number(cluster + ".perforations"),
                                section.number(cluster + ".diameter"),
                                section.number(cluster + ".discharge_coefficient"));
}

/// Adds the well's clusters to the inlets.
CrackWell read_well(const Section& section, std::size_t k, double part,
                    std::vector<CrackInlet>& inlets) {
  const std::string path = fmt::format("wells[{}]", k);
  CrackWell well{.name = section.text(path + ".name"),
                 .rate = part * read_rate(section, path),
                 .schedule = read_schedule(section, path),
                 .resistance = {}};
  if (well.rate == 0.0) {
    section.fail(path, "a well of no rate", "another rate, which its schedule may take to 0");
  }
  if (section.has(path + ".thickness") && section.scene().integer("dimension") == 3) {
    section.fail(path + ".thickness", "in 3D", "it in 2D, where rates are per metre");
  }
  for (std::size_t c = 0; c < section.count(path + ".clusters"); ++c) {
    const std::string cluster = cluster_path(k, c);
    well.resistance.push_back(read_resistance(section, path, cluster, part));
    CrackInlet& inlet = inlets.emplace_back();
    inlet.name = section.text(cluster + ".name");
    inlet.from_well = true;
    std::ranges::copy(section.numbers(cluster + ".at"), inlet.at.begin());
  }
  if (well.resistance.empty()) {
    section.fail(path, "a well without clusters", "a list 'clusters' with one or more");
  }
  return well;
}

/// History names them all by their names alone.
void refuse_second_names(const Section& section, const std::vector<std::string>& paths) {
  std::set<std::string> names;
  for (const std::string& path : paths) {
    if (names.insert(section.text(path + ".name")).second) continue;
    section.fail(path + ".name", "the name of another inlet", "names that differ");
  }
}

}  // namespace

CrackInlets read_crack_inlets(const Section& section, const CrackLiquid& liquid) {
  const double part = section.word("counts") == "both" ? 0.5 : 1.0;
  std::vector<CrackInlet> inlets;
  std::vector<CrackWell> wells;
  Mistakes mistakes;
  for (std::size_t k = 0; k < section.count("inlets"); ++k) {
    mistakes.note(
        [&] { inlets.push_back(read_inlet(section, fmt::format("inlets[{}]", k), part)); });
  }
  for (std::size_t k = 0; k < section.count("wells"); ++k) {
    mistakes.note([&] { wells.push_back(read_well(section, k, part, inlets)); });
  }
  mistakes.note([&] { refuse_second_names(section, crack_inlet_paths(section)); });
  mistakes.throw_if_any();
  return {std::move(inlets), liquid, std::move(wells)};
}

std::vector<std::string> crack_inlet_paths(const Section& section) {
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < section.count("inlets"); ++k) {
    paths.push_back(fmt::format("inlets[{}]", k));
  }
  for (std::size_t k = 0; k < section.count("wells"); ++k) {
    for (std::size_t c = 0; c < section.count(fmt::format("wells[{}].clusters", k)); ++c) {
      paths.push_back(cluster_path(k, c));
    }
  }
  return paths;
}

}  // namespace perifrac
