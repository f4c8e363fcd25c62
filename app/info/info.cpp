#include "app/info/info.hpp"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/info/file_facts.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string beginning(const fs::path& file, std::size_t count) {
  return InputFile(file, "a file that perifrac wrote").read(count);
}

std::optional<Json> json_in(const fs::path& file) {
  std::error_code missing;
  if (file.extension() == ".hdf" || !fs::is_regular_file(file, missing)) return {};
  if (!beginning(file, 1).starts_with('{')) return {};
  const std::string text = InputFile(file, "a file of JSON").read(std::string::npos);
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return {};
  return json;
}

namespace {

/// What lies in a folder and says most about it.
fs::path file_of(const fs::path& path) {
  std::error_code missing;
  if (!fs::is_directory(path, missing)) return path;
  for (const char* name : {"summary.json", "study.json", "history.csv"}) {
    if (fs::exists(path / name, missing)) return path / name;
  }
  throw InputError(
      fmt::format("{}: holds no run and no study; expected a folder or a file that "
                  "perifrac wrote",
                  path.string()));
}

FileFacts facts_of(const fs::path& file) {
  using Kind = std::optional<FileFacts> (*)(const fs::path&);
  constexpr std::array<Kind, 9> kinds = {checkpoint_facts, frame_facts,    frame_list_facts,
                                         history_facts,    exported_facts, summary_facts,
                                         study_facts,      drawing_facts,  scene_facts};
  for (const Kind kind : kinds) {
    if (auto facts = kind(file)) return std::move(*facts);
  }
  throw InputError(
      fmt::format("{}: not a file that perifrac wrote; expected a checkpoint_*.h5, frame .hdf, "
                  ".hdf.series, history.csv, summary.json, exported frame, scene, report or study",
                  printable(file.string())));
}

/// Of the run that a file belongs to, where its summary lies beside it or a folder higher.
void add_run(const fs::path& file, Json& facts) {
  if (facts.contains("version")) return;
  const fs::path folder = fs::absolute(file).parent_path();
  for (const fs::path& place : {folder, folder.parent_path()}) {
    const auto run = summary_facts(place / "summary.json");
    if (!run) continue;
    for (const char* name : {"title", "scene", "version", "outcome"}) {
      facts[name] = run->facts.at(name);
    }
    return;
  }
}

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

/// `5 s`, or what an entry of a list says of itself, on one line.
std::string entry_text(const Json& entry) {
  if (!entry.is_object()) return value_text(entry);
  std::string text;
  if (entry.contains("value")) {
    return fmt::format("{} {}", value_text(entry["value"]), entry.value("unit", ""));
  }
  for (const auto& [name, value] : entry.items()) {
    const std::string shown = entry_text(value);
    if (shown.empty()) continue;
    if (!text.empty()) text += "  ";
    text += name == "unit" ? '[' + shown + ']' : name == "name" ? shown : name + ' ' + shown;
  }
  return text;
}

void print_facts(const Json& facts) {
  for (const auto& [name, value] : facts.items()) {
    const bool is_quantity = value.is_object() && value.contains("value");
    const bool is_list = value.is_array() && !value.empty() && value[0].is_object();
    if (value.is_array() && !is_list) {
      std::vector<std::string> words;
      for (const Json& word : value) words.push_back(value_text(word));
      fmt::print("  {:<12} {}\n", name, fmt::join(words, ", "));
    } else if (is_list || (value.is_object() && !is_quantity)) {
      fmt::print("  {}\n", name);
      for (const auto& [inner, entry] : value.items()) {
        if (is_list)
          fmt::print("    {}\n", entry_text(entry));
        else
          fmt::print("    {:<40} {}\n", inner, entry_text(entry));
      }
    } else if (!entry_text(value).empty()) {
      fmt::print("  {:<12} {}\n", name, entry_text(value));
    }
  }
}

}  // namespace

int print_info(const std::string& name, bool json) {
  const fs::path file = file_of(name);
  FileFacts found = facts_of(file);
  add_run(file, found.facts);
  const auto bytes = fs::file_size(file);
  if (json) {
    Json document = {{"file", file.string()}, {"what", found.what}, {"bytes", bytes}};
    document.update(found.facts);
    fmt::print("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace));
    return 0;
  }
  fmt::print("{}: {}, {} bytes\n", file.string(), found.what, bytes);
  print_facts(found.facts);
  return 0;
}

}  // namespace perifrac
