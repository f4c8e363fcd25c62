#include "coupling/connect.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace perifrac {
namespace {

bool carries_slope(const Link& link) {
  return !link.source().module->port(link.source().port).slope.empty();
}

bool are_opposite(const Link& a, const Link& b) {
  return a.source().module == b.target().module && a.target().module == b.source().module;
}

void check_ports(const Link& link) {
  const Port& out = link.source().module->ports()[link.source().port];
  const Port& in = link.target().module->ports()[link.target().port];
  if (out.unit != in.unit || out.kind != in.kind || out.components != in.components) {
    throw std::logic_error(
        fmt::format("{}: the out-port gives {} x [{}], the in-port takes {} x [{}], or one is "
                    "extensive and the other intensive",
                    link.path(), out.components, out.unit, in.components, in.unit));
  }
  if (out.kind == PortKind::extensive && carries_slope(link)) {
    throw std::logic_error(link.path() + ": a total over the window has no slope");
  }
}

double largest_size(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Appends the link that feeds in-port `in` of module `target`, if any module has its out-port.
void link_writer(std::span<ModuleSlot> modules, std::size_t target, PortId in,
                 std::vector<Link>& links) {
  const std::string& name = modules[target].module->ports()[in].name;
  const std::size_t before = links.size();
  for (std::size_t source = 0; source < modules.size(); ++source) {
    if (source == target) continue;
    const auto ports = modules[source].module->ports();
    for (std::size_t out = 0; out < ports.size(); ++out) {
      if (ports[out].direction != PortDirection::out || ports[out].name != name) continue;
      const LinkEnd from{modules[source].name, modules[source].module.get(),
                         static_cast<PortId>(out)};
      const LinkEnd to{modules[target].name, modules[target].module.get(), in};
      links.emplace_back(from, to, source > target);
      check_ports(links.back());
    }
  }
  if (links.size() > before + 1) {
    throw std::logic_error(links.back().path() + ": a second writer of one port");
  }
}

}  // namespace

std::vector<Link> connect(std::span<ModuleSlot> modules, Split split) {
  std::vector<Link> links;
  for (std::size_t target = 0; target < modules.size(); ++target) {
    const auto ports = modules[target].module->ports();
    for (std::size_t in = 0; in < ports.size(); ++in) {
      if (ports[in].direction == PortDirection::in) {
        link_writer(modules, target, static_cast<PortId>(in), links);
      }
    }
  }
  if (split == Split::fixed_stress) {
    for (const CoupledPair& pair : coupled_pairs(links)) {
      const auto use_slope = [](Link& link, const Link& partner) {
        const PortView input = link.target().module->port(link.target().port);
        if (!input.slope.empty()) link.use_slope(partner.target().port);
      };
      use_slope(links[pair.first], links[pair.second]);
      use_slope(links[pair.second], links[pair.first]);
    }
  }
  return links;
}

std::vector<CoupledPair> coupled_pairs(std::span<const Link> links) {
  std::vector<CoupledPair> pairs;
  std::vector<bool> paired(links.size(), false);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!carries_slope(links[i])) continue;
    for (std::size_t j = i + 1; j < links.size(); ++j) {
      if (!are_opposite(links[i], links[j]) || !carries_slope(links[j])) continue;
      if (paired[i] || paired[j]) {
        throw std::logic_error(links[i].path() + ": its slope could refer to two ports");
      }
      paired[i] = paired[j] = true;
      pairs.push_back({i, j});
    }
  }
  return pairs;
}

double coupling_strength(const Link& first, const Link& second) {
  const PortView a = first.source().module->port(first.source().port);
  const PortView b = second.source().module->port(second.source().port);
  if (!a.points->same_points(*b.points)) return largest_size(a.slope) * largest_size(b.slope);
  double largest = 0.0;
  for (std::size_t i = 0; i < a.slope.size(); ++i) {
    largest = std::max(largest, std::abs(a.slope[i] * b.slope[i]));
  }
  return largest;
}

}  // namespace perifrac
