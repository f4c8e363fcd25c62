#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/config/key.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// What a key holds once read, in SI; a group of further keys holds nothing itself.
using KeyValue =
    std::variant<std::monostate, double, int, bool, std::string, std::vector<double>, YamlNode>;

/// Reads and checks the value of `key` that stands at `path`. Throws InputError.
KeyValue read_value(const Key& key, const YamlNode& node, const std::string& path, int dimension);

/// What may stand there, as in `a pressure [Pa], such as '1 MPa' in [0, inf)`.
std::string describe_value(const Key& key, int dimension);

/// The alternative of `N/m|N` for this dimension.
std::string unit_in(const std::string& unit, int dimension);

}  // namespace perifrac
