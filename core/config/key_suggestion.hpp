#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/key_tree.hpp"

namespace perifrac {

/// The key among `known` that somebody who wrote `written` most likely meant: by typing slips, or
/// because other programs call it so (`insitu_stress`, `k_ic`); empty if there is none.
std::string near_key(std::string_view written, const std::vector<std::string>& known);

/// `expected one of: a, b` of the keys of a map, and `; did you mean 'b'?` with such a key, or
/// with the path of one of that name elsewhere in the scene.
std::string expected_key(std::string_view written, const std::vector<std::string>& known,
                         const KeyNode& scene);

}  // namespace perifrac
