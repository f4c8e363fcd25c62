#pragma once

#include <filesystem>
#include <string>

namespace perifrac {

/// Writes a file that may not be there yet; throws OutputError.
void write_new_file(const std::filesystem::path& path, const std::string& text);

}  // namespace perifrac
