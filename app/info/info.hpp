#pragma once

#include <string>

namespace perifrac {

/// `perifrac info FILE`: what a file that the program wrote is, of which scene and version, its
/// times, fields and sizes; of a folder, the summary of the run or study in it. Returns the exit
/// code. Throws InputError for any other file.
int print_info(const std::string& file, bool json);

}  // namespace perifrac
