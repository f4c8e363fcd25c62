#pragma once

#include <span>
#include <vector>

#include "coupling/coupling_options.hpp"
#include "coupling/link.hpp"
#include "coupling/module_slot.hpp"

namespace perifrac {

/// A link for every in-port that another module has an out-port of the same name for; an in-port
/// without is left as its module initialised it. Totals over the window may come from several
/// modules: the in-port gets their sum (SummedInput). Modules must be initialised.
///
/// Of a coupled pair, the module that advances first is sent the slope of the other's answer, if
/// it can add it. That is fixed stress in the order given. Where the split is, or may be, undrained
/// and the later module can add a slope within its window, it is moved before the earlier one.
/// Where the earlier hands over totals, it is sent the slope of the later one's answer to them
/// whatever the split: such links are no coupled pair.
/// Throws std::logic_error where two modules write one intensive in-port, or the two ports of a
/// link differ in unit, kind or components.
std::vector<Link> connect(std::span<ModuleSlot> modules, Split split);

/// Two links of one kind that run opposite ways between two modules, at least one with a slope on
/// its out-port.
struct CoupledPair {
  std::size_t first;  ///< indices among the links
  std::size_t second;
};

/// Throws std::logic_error where a link has more than one such partner.
std::vector<CoupledPair> coupled_pairs(std::span<const Link> links);

/// The largest |slope of first x slope of second| over the points: the factor by which an exchange
/// of plain values to and fro multiplies an error; 0 where one has none. Slopes are taken as they
/// stand now.
double coupling_strength(const Link& first, const Link& second);

}  // namespace perifrac
