#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// Code that `perifrac new KIND NAME` can write.
std::vector<std::string> code_kinds();

/// `perifrac new module NAME`, `new material NAME`: writes a folder (`output`, or NAME) with a
/// class, what builds it against the installed program, a scene and a page that says how: the
/// example of docs/add_a_module.md or docs/add_a_material.md under another name. Throws InputError
/// for a name that is none, and where the folder is there already; OutputError.
int write_new_code(const std::string& kind, const std::string& name, const std::string& output);

}  // namespace perifrac
