#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// Runs a drawing script of ours on folders or files; `input` is its standard input. It prints the
/// paths of what it made, unless `quiet`. Returns its exit code. A missing Python is a warning: the
/// results are there anyway.
int draw(const std::string& script, const std::vector<std::string>& paths, bool quiet,
         const std::string& input = {});

}  // namespace perifrac
