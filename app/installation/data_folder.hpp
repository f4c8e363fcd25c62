#pragma once

#include <filesystem>

namespace perifrac {

/// The folder with what the program reads of its own: `configs`, `app/writing/templates`,
/// `app/report`, `app/study/drawing`. Of an installed program PREFIX/share/perifrac, found from
/// where the program lies, so that the whole may be moved; else the source tree.
const std::filesystem::path& data_folder();

/// Has udunits read the database that a folder which is moved brings along, where it does.
void name_own_unit_database();

/// What to start for another run of this program: where it is installed, the one that chooses the
/// instruction set, since that run may be on another machine.
std::filesystem::path program_file();

/// The folder is one that `cmake --install` made.
bool is_installed();

}  // namespace perifrac
