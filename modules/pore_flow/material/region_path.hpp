#pragma once

#include <string>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// Prefixes of the paths that materials are read from: empty for the body's own, then
/// `regions.<name>.` for each that the section names.
inline std::vector<std::string> region_prefixes(const Section& section) {
  std::vector<std::string> prefixes = {""};
  if (!section.has("regions")) return prefixes;
  for (const std::string& name : section.names("regions")) {
    prefixes.push_back("regions." + name + ".");
  }
  return prefixes;
}

/// The path of a key in a region; the body's own where the region leaves it out.
inline std::string path_in_region(const Section& section, const std::string& prefix,
                                  const std::string& key) {
  return section.has(prefix + key) ? prefix + key : key;
}

}  // namespace perifrac
