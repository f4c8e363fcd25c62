#include "app/writing/new_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/installation/data_folder.hpp"
#include "app/writing/json_schema.hpp"
#include "app/writing/new_file.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/yaml_tree.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace {

namespace fs = std::filesystem;

fs::path templates() { return data_folder() / "app/writing/templates"; }

}  // namespace

std::vector<std::string> scene_kinds() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(templates())) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

std::string scene_kinds_by_line() {
  std::string lines;
  for (const std::string& kind : scene_kinds()) {
    const YamlNode scene = parse_yaml_file(templates() / (kind + ".yaml"));
    const YamlNode* const title = scene.child("title");
    lines += fmt::format("  {:<20} {}\n", kind, title != nullptr ? title->text : "");
  }
  return lines;
}

int write_new_scene(const std::string& kind, const std::string& output) {
  const std::vector<std::string> known = scene_kinds();
  if (std::ranges::find(known, kind) == known.end()) {
    const std::string near = nearest_name(kind, known);
    throw InputError(fmt::format("perifrac new: unknown kind {}; expected one of: {}{}",
                                 in_quotes(kind), fmt::join(known, ", "),
                                 near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  const fs::path scene = output.empty() ? fs::path(kind + ".yaml") : fs::path(output);
  std::vector<std::pair<fs::path, fs::path>> files = {{templates() / (kind + ".yaml"), scene}};
  const fs::path points = templates() / (kind + ".csv");
  if (fs::exists(points)) files.emplace_back(points, scene.parent_path() / points.filename());
  for (const auto& [from, to] : files) {
    if (!fs::exists(fs::symlink_status(to))) continue;
    throw InputError(
        fmt::format("perifrac new: {} is there already; expected a new name, as in "
                    "--output my_{}.yaml in another folder, or that you move it",
                    in_quotes(to.string()), kind));
  }
  std::vector<std::string> written;
  for (const auto& [from, to] : files) {
    write_new_file(to, read_input_text(from.string(), "a template of the program"));
    written.push_back(to.string());
  }
  // The first line of every template names it, for the editor.
  const fs::path schema = scene.parent_path() / "perifrac.schema.json";
  if (!fs::exists(fs::symlink_status(schema))) {
    write_new_file(schema, json_schema_of_scenes());
    written.push_back(schema.string());
  }
  fmt::print("wrote {}; next: perifrac check {}\n", fmt::join(written, ", "), scene.string());
  return 0;
}

}  // namespace perifrac
