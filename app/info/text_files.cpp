#include <array>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "app/info/file_facts.hpp"
#include "core/base/errors.hpp"
#include "core/config/yaml_tree.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json seconds(const Json& value) { return {{"value", value}, {"unit", "s"}}; }

/// The cells of a row of CSV, in which a cell may stand in quotes.
std::vector<std::string> cells_of(std::string_view row) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : row) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == ',' && !is_quoted)
      cells.emplace_back();
    else if (c != '"')
      cells.back() += c;
  }
  return cells;
}

/// `name [unit]`.
std::pair<std::string, std::string> name_and_unit(const std::string& cell) {
  const auto open = cell.rfind(" [");
  if (open == std::string::npos || !cell.ends_with(']')) return {cell, ""};
  return {cell.substr(0, open), cell.substr(open + 2, cell.size() - open - 3)};
}

/// Their names and units, by a table's first line.
Json columns_of(const std::string& line) {
  Json columns = Json::object();
  for (const std::string& cell : cells_of(line)) {
    const auto [name, unit] = name_and_unit(cell);
    columns[name] = {{"unit", unit}};
  }
  return columns;
}

/// What stands in quotes behind every `key="` of a text of XML.
std::vector<std::string> quoted(const std::string& text, const std::string& key) {
  std::vector<std::string> found;
  const std::string start = key + "=\"";
  for (auto at = text.find(start); at != std::string::npos; at = text.find(start, at)) {
    at += start.size();
    found.push_back(text.substr(at, text.find('"', at) - at));
  }
  return found;
}

bool is_one_of(const std::string& name, std::span<const std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

std::optional<FileFacts> history_facts(const fs::path& file) {
  if (!beginning(file, 13).starts_with("time [s],step")) return {};
  std::istringstream table(InputFile(file, "a history.csv of a run").read(std::string::npos));
  std::string line, first, last;
  std::getline(table, line);
  Json columns = columns_of(line);
  std::size_t rows = 0;
  while (std::getline(table, line) && !table.eof()) {  // one without an end was cut off
    if (rows++ == 0) first = line;
    last = line;
  }
  Json facts = {{"rows", rows}};
  if (rows > 0) {
    facts["times"] = {{"from", seconds(std::strtod(first.c_str(), nullptr))},
                      {"to", seconds(std::strtod(last.c_str(), nullptr))}};
    const std::vector<std::string> cells = cells_of(last);
    auto cell = cells.begin();
    for (auto& [name, column] : columns.items()) {
      if (cell == cells.end()) break;
      if (!cell->empty()) column["last"] = std::strtod(cell->c_str(), nullptr);
      ++cell;
    }
  }
  facts["columns"] = columns;
  return FileFacts{.what = "history of a run", .facts = facts};
}

std::optional<FileFacts> frame_list_facts(const fs::path& file) {
  const std::optional<Json> list = json_in(file);
  if (!list || !list->is_object() || !list->contains("file-series-version")) return {};
  Json frames = Json::array();
  std::size_t missing = 0;
  std::error_code ignored;
  for (const Json& entry : list->value("files", Json::array())) {
    const std::string name = entry.value("name", "");
    if (!fs::exists(file.parent_path() / name, ignored)) ++missing;
    frames.push_back({{"name", name}, {"time", seconds(entry.value("time", Json()))}});
  }
  Json facts = {{"frames", frames.size()}, {"missing", missing}, {"list", frames}};
  return FileFacts{.what = "list of frames", .facts = facts};
}

std::optional<FileFacts> exported_facts(const fs::path& file) {
  const std::string extension = file.extension();
  if (extension == ".csv" && beginning(file, 12) == "x [m],y [m],") {
    std::istringstream table(InputFile(file, "a table of a frame").read(std::string::npos));
    std::string line;
    std::getline(table, line);
    Json facts = {{"points", 0}, {"columns", columns_of(line)}};
    while (std::getline(table, line)) facts["points"] = facts["points"].get<int>() + 1;
    return FileFacts{.what = "frame as a table", .facts = facts};
  }
  if (extension != ".vtu" && extension != ".pvd") return {};
  const std::string text = InputFile(file, "a file of VTK's XML").read(std::string::npos);
  if (extension == ".pvd" && text.find("type=\"Collection\"") != std::string::npos) {
    const auto files = quoted(text, "file");
    return FileFacts{.what = "list of exported frames",
                     .facts = {{"frames", files.size()}, {"list", files}, {"use", "ParaView"}}};
  }
  const auto points = quoted(text, "NumberOfPoints"), cells = quoted(text, "NumberOfCells");
  const auto data = text.find("<CellData>");
  if (points.size() != 1 || cells.size() != 1 || data == std::string::npos) return {};
  Json fields = Json::object();
  for (const std::string& name : quoted(text.substr(data), " Name")) {
    fields[name_and_unit(name).first] = {{"unit", name_and_unit(name).second}};
  }
  return FileFacts{.what = "frame as cells",
                   .facts = {{"corners", std::stoul(points[0])},
                             {"cells", std::stoul(cells[0])},
                             {"fields", fields},
                             {"use", "ParaView, or whatever reads VTU"}}};
}

std::optional<FileFacts> summary_facts(const fs::path& file) {
  const std::optional<Json> summary = json_in(file);
  if (!summary || !summary->is_object() || !summary->contains("outcome") ||
      !summary->contains("scene")) {
    return {};
  }
  const Json& scene = summary->at("scene");
  Json facts = {{"title", scene.value("title", "")}, {"scene", scene.value("path", "")}};
  for (const char* name : {"version", "outcome", "time", "effects", "counts"}) {
    if (summary->contains(name)) facts[name] = summary->at(name);
  }
  const Json build = summary->value("build", Json::object());
  for (const char* name : {"commit", "instructions"}) {
    if (build.contains(name)) facts[name] = build.at(name);
  }
  facts["wall_time"] = seconds(summary->value("wall_time", Json()));
  facts["warnings"] = summary->value("warnings", Json::array()).size();
  return FileFacts{.what = "summary of a run", .facts = facts};
}

std::optional<FileFacts> study_facts(const fs::path& file) {
  static constexpr std::array<std::string_view, 3> tables = {"study.csv", "table.md", "table.tex"};
  if (is_one_of(file.filename(), tables)) {
    auto whole = study_facts(file.parent_path() / "study.json");
    if (whole) whole->what = "table of a study";
    return whole;
  }
  const std::optional<Json> json = json_in(file);
  if (!json || !json->is_object()) return {};
  if (json->contains("axes") && json->contains("points")) {
    Json axes = Json::array();
    for (const Json& axis : json->at("axes")) axes.push_back(axis.value("name", ""));
    return FileFacts{.what = "study",
                     .facts = {{"title", json->value("title", "")},
                               {"version", json->value("version", "")},
                               {"axes", axes},
                               {"variants", json->at("points").size()}}};
  }
  if (file.filename() == "record.json" && json->contains("status")) {
    return FileFacts{.what = "record of a study's variant",
                     .facts = {{"status", json->at("status")}}};
  }
  if (json->contains("$schema") && json->contains("properties")) {
    return FileFacts{.what = "JSON Schema of scenes",
                     .facts = {{"title", json->value("title", "")}}};
  }
  return {};
}

std::optional<FileFacts> drawing_facts(const fs::path& file) {
  static constexpr std::array<std::string_view, 2> reports = {"report.png", "report.html"};
  static constexpr std::array<std::string_view, 3> studies = {"study.png", "study.svg",
                                                              "study.html"};
  const bool is_page = file.extension() == ".html";
  if (is_one_of(file.filename(), reports) ||
      (is_page && file.filename().string().starts_with("compared_with_"))) {
    auto run = summary_facts(file.parent_path() / "summary.json");
    if (run) run->what = is_page ? "page about a run" : "picture of a run";
    return run;
  }
  if (!is_one_of(file.filename(), studies)) return {};
  auto study = study_facts(file.parent_path() / "study.json");
  if (study) study->what = is_page ? "page about a study" : "picture of a study";
  return study;
}

std::optional<FileFacts> scene_facts(const fs::path& file) {
  if (file.extension() != ".yaml" && file.extension() != ".yml") return {};
  const YamlNode tree = parse_yaml_file(file);
  const YamlNode* const title = tree.child("title");
  Json facts = {{"title", title == nullptr ? "" : title->text}};
  if (tree.child("dimension") != nullptr && tree.child("time") != nullptr) {
    Json sections = Json::array();
    for (const YamlNode& section : tree.children) {
      if (section.kind == YamlNode::Kind::map) sections.push_back(section.key);
    }
    facts["sections"] = sections;
    facts["use"] = fmt::format("perifrac check {}", file.string());
    return FileFacts{.what = "scene", .facts = facts};
  }
  if (tree.child("axes") == nullptr) return {};
  facts["use"] = fmt::format("perifrac study {}", file.string());
  return FileFacts{.what = "study to be run", .facts = facts};
}

}  // namespace perifrac
