#include "coupling/connect.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

namespace perifrac {
namespace {

bool carries_slope(const Link& link) {
  return !link.source().module->port(link.source().port).slope.empty();
}

bool takes_slope(const Link& link) {
  return !link.target().module->port(link.target().port).slope.empty();
}

bool is_property(const Link& link) {
  return !carries_slope(link) &&
         link.source().module->ports()[link.source().port].role == PortRole::property;
}

bool are_opposite(const Link& a, const Link& b) {
  if (is_property(a) || is_property(b)) return false;
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

/// Appends the links that feed in-port `in` of module `target`: one, or of totals any number.
void link_writers(std::span<ModuleSlot> modules, std::size_t target, PortId in,
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
      to.module->connect(in);
      check_ports(links.back());
    }
  }
  if (links.size() <= before + 1) return;
  if (links.back().kind() != PortKind::extensive) {
    throw std::logic_error(links.back().path() + ": a second writer of one port");
  }
  const auto sum = std::make_shared<SummedInput>();
  for (std::size_t k = before; k < links.size(); ++k) links[k].join(sum);
}

/// Who is handed totals over a window answers them within it, whatever the split.
void use_slopes_of_totals(std::span<Link> links) {
  for (Link& link : links) {
    if (!link.lagged() || !carries_slope(link) || !takes_slope(link)) continue;
    for (const Link& total : links) {
      if (total.kind() == PortKind::extensive && are_opposite(link, total)) {
        link.use_slope_of(total);
      }
    }
  }
}

std::vector<Link> plain_links(std::span<ModuleSlot> modules) {
  std::vector<Link> links;
  for (std::size_t target = 0; target < modules.size(); ++target) {
    const auto ports = modules[target].module->ports();
    for (std::size_t in = 0; in < ports.size(); ++in) {
      if (ports[in].direction == PortDirection::in) {
        link_writers(modules, target, static_cast<PortId>(in), links);
      }
    }
  }
  use_slopes_of_totals(links);
  return links;
}

/// Puts the later module of a pair first if it can add the earlier one's slope within its window;
/// returns it, or nothing.
const PhysicsModule* put_undrained_first(std::span<ModuleSlot> modules,
                                         std::span<const Link> links) {
  for (const CoupledPair& pair : coupled_pairs(links)) {
    const Link& link = links[links[pair.first].lagged() ? pair.second : pair.first];
    if (!carries_slope(link) || !takes_slope(link)) continue;
    const auto place = [&](const LinkEnd& end) {
      return std::ranges::find_if(
          modules, [&](const ModuleSlot& slot) { return slot.module.get() == end.module; });
    };
    const auto later = place(link.target());
    std::rotate(place(link.source()), later, later + 1);
    return link.target().module;
  }
  return nullptr;
}

}  // namespace

std::vector<Link> connect(std::span<ModuleSlot> modules, Split split) {
  std::vector<Link> links = plain_links(modules);
  if (split == Split::drained) return links;
  const PhysicsModule* moved = nullptr;
  if (split != Split::fixed_stress) {
    moved = put_undrained_first(modules, links);
    if (moved != nullptr) links = plain_links(modules);
  }
  for (const CoupledPair& pair : coupled_pairs(links)) {
    const bool first_is_lagged = links[pair.first].lagged();
    Link& link = links[first_is_lagged ? pair.first : pair.second];
    const Link& partner = links[first_is_lagged ? pair.second : pair.first];
    const bool undrained = link.target().module == moved;
    if (carries_slope(link) && takes_slope(link) && (undrained || split != Split::undrained)) {
      link.use_slope(partner.target().port, undrained);
    }
  }
  return links;
}

std::vector<CoupledPair> coupled_pairs(std::span<const Link> links) {
  std::vector<CoupledPair> pairs;
  std::vector<bool> paired(links.size(), false);
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (std::size_t j = i + 1; j < links.size(); ++j) {
      if (!are_opposite(links[i], links[j])) continue;
      if (links[i].kind() != links[j].kind()) continue;
      if (!carries_slope(links[i]) && !carries_slope(links[j])) continue;
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
  if (a.slope.empty() || b.slope.empty()) return 0.0;
  if (!a.points->same_points(*b.points)) return largest_size(a.slope) * largest_size(b.slope);
  double largest = 0.0;
  for (std::size_t i = 0; i < a.slope.size(); ++i) {
    largest = std::max(largest, std::abs(a.slope[i] * b.slope[i]));
  }
  return largest;
}

}  // namespace perifrac
