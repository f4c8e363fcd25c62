#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// Of all scenes that come with the program, in alphabetical order.
std::vector<std::string> example_names();

/// The file of a scene that comes with the program, by its name as in `mandel` or `paper/mandel`.
/// Throws InputError, which lists all names, for any other.
std::string example_scene(const std::string& name);

}  // namespace perifrac
