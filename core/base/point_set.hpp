#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace perifrac {

/// The points that a port lives on. A module that inserts, removes or reorders points raises
/// `version`; whoever holds a mapping then rebuilds it.
struct PointSet {
  std::string name;
  std::uint64_t version = 0;
  int dimension = 0;                                  ///< 2 or 3; 0: one value without a place
  std::array<std::span<const double>, 3> position{};  ///< [m], one span a coordinate
  std::size_t count = 1;

  bool same_points(const PointSet& other) const {
    return name == other.name && version == other.version && count == other.count;
  }
};

}  // namespace perifrac
