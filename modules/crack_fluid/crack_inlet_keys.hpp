#pragma once

#include <string>
#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/crack_fluid/crack_inlets.hpp"

namespace perifrac {

/// The keys of `inlets`, `wells` and `counts`.
KeyTable crack_inlet_keys();

/// Reads them. Throws InputError.
CrackInlets read_crack_inlets(const Section& section, const CrackLiquid& liquid);

/// The paths of all inlets and clusters in a section `crack_fluid`.
std::vector<std::string> crack_inlet_paths(const Section& section);

}  // namespace perifrac
