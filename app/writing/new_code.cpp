#include "app/writing/new_code.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/installation/data_folder.hpp"
#include "app/writing/new_file.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace {

namespace fs = std::filesystem;

/// An example of the docs that is handed out under another name.
struct Example {
  std::string kind;
  std::string folder;                ///< in docs
  std::string name;                  ///< of its files and its word in scenes
  std::vector<std::string> sources;  ///< extensions
};

const std::vector<Example>& code_examples() {
  static const std::vector<Example> all = {
      {"module", "docs/example_module", "compaction", {".hpp", ".cpp"}},
      {"material", "docs/example_material", "reinforced", {".hpp", ".cpp"}},
  };
  return all;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// `my_rock` as a class: `MyRock`.
std::string class_name(const std::string& name) {
  std::string words;
  for (std::size_t k = 0; k < name.size(); ++k) {
    if (name[k] == '_') continue;
    const bool begins = k == 0 || name[k - 1] == '_';
    words +=
        begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[k]))) : name[k];
  }
  return words;
}

void check_name(const std::string& kind, const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z' && std::ranges::all_of(name, fits)) return;
  throw InputError(fmt::format(
      "perifrac new {}: {}; expected small letters, digits and '_', as in: perifrac new {} my_rock",
      kind, name.empty() ? "the name is missing" : in_quotes(name) + " is no name", kind));
}

}  // namespace

std::vector<std::string> code_kinds() {
  std::vector<std::string> kinds;
  for (const Example& example : code_examples()) kinds.push_back(example.kind);
  return kinds;
}

int write_new_code(const std::string& kind, const std::string& name, const std::string& output) {
  check_name(kind, name);
  const Example& example = *std::ranges::find(code_examples(), kind, &Example::kind);
  const fs::path folder = output.empty() ? fs::path(name) : fs::path(output);
  if (fs::exists(fs::symlink_status(folder))) {
    throw InputError(fmt::format(
        "perifrac new: {} is there already; expected a new name, or --output with another folder",
        in_quotes(folder.string())));
  }
  const auto text = [&](const fs::path& path) {
    std::string words =
        read_input_text((data_folder() / path).string(), "a template of the program");
    words = replaced(std::move(words), example.folder + "/", "");
    words = replaced(std::move(words), class_name(example.name), class_name(name));
    words = replaced(std::move(words), example.name, name);
    words = replaced(std::move(words), "@CLASS@", class_name(name));
    return replaced(replaced(std::move(words), "@NAME@", name), "@KIND@", kind);
  };
  const fs::path code = "app/writing/templates/code";
  std::error_code error;
  if (!fs::create_directories(folder, error)) throw OutputError(folder.string(), error.message());
  for (const std::string& extension : example.sources) {
    write_new_file(folder / (name + extension),
                   text(fs::path(example.folder) / (example.name + extension)));
  }
  for (const std::string file : {"CMakeLists.txt", "README.md"}) {
    write_new_file(folder / file, text(code / (file + ".in")));
  }
  write_new_file(folder / "library.cpp", text(code / (kind + "_library.cpp.in")));
  write_new_file(folder / "contract_test.cpp", text(code / (kind + "_test.cpp.in")));
  write_new_file(folder / "scene.yaml",
                 fmt::format("modules: [build/lib{}.so]\n", name) +
                     text(fs::path(example.folder) / (example.name + ".yaml")));
  fmt::print("wrote {}; next: {}\n", folder.string(), (folder / "README.md").string());
  return 0;
}

}  // namespace perifrac
