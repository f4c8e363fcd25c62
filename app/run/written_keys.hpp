#pragma once

#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

using KeyVisit = std::function<void(const std::string& path, const Key& key)>;

/// Visits every key that a scene writes below `path` (empty: all) and that holds there, in the
/// file's order.
void for_each_written(const Section& scene, const std::string& path, const KeyVisit& visit);

/// What a scene writes, as it is nested, numbers in SI; trees (KeyType::tree) are left out.
nlohmann::json written_in_si(const Section& scene);

}  // namespace perifrac
