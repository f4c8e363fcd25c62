#include "app/installation/examples.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/installation/data_folder.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"

namespace perifrac {

namespace fs = std::filesystem;

std::vector<std::string> example_names() {
  const fs::path folder = data_folder() / "configs";
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : fs::recursive_directory_iterator(folder, missing)) {
    const fs::path name = entry.path().lexically_relative(folder);
    if (name.extension() != ".yaml" || *name.begin() == "studies") continue;
    names.push_back(fs::path(name).replace_extension());
  }
  std::ranges::sort(names);
  return names;
}

std::string example_scene(const std::string& name) {
  const std::vector<std::string> names = example_names();
  if (std::ranges::find(names, name) != names.end()) {
    return data_folder() / "configs" / (name + ".yaml");
  }
  const std::string near = nearest_name(name, names);
  throw InputError(fmt::format("perifrac: unknown example {}; expected one of: {}{}",
                               in_quotes(name), fmt::join(names, ", "),
                               near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace perifrac
