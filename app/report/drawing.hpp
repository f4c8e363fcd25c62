#pragma once

#include <filesystem>
#include <string>

namespace perifrac {

/// Runs a drawing script of ours on a folder. It prints the paths of what it made, unless `quiet`.
/// Returns its exit code. A missing Python is a warning: the results are there anyway.
int draw(const std::string& script, const std::filesystem::path& folder, bool quiet);

}  // namespace perifrac
