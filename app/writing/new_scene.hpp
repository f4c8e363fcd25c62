#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// What `perifrac new` can write, in alphabetical order.
std::vector<std::string> scene_kinds();

/// The same with their titles, a line each.
std::string scene_kinds_by_line();

/// `perifrac new KIND`: writes a commented scene to begin with, and the files that it reads, beside
/// `output` (`KIND.yaml` where empty), and where it is not there yet the schema by which editors
/// check it. Throws InputError for a kind that there is none of, and where a file of that name is
/// there already.
int write_new_scene(const std::string& kind, const std::string& output);

}  // namespace perifrac
