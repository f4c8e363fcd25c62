#include <algorithm>

#include <fmt/format.h>

#include "app/info/file_facts.hpp"
#include "core/base/errors.hpp"
#include "core/config/yaml_tree.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/hdf5.hpp"

namespace perifrac {

namespace {

using Json = nlohmann::ordered_json;

/// The title of a scene, by its text; empty where it has none.
std::string title_of(const std::string& scene) {
  const YamlNode tree = parse_yaml_text(scene, "the scene in the checkpoint");
  const YamlNode* const title = tree.child("title");
  return title == nullptr ? "" : title->text;
}

Json values(std::size_t count) { return {{"value", count}, {"unit", "values"}}; }

}  // namespace

std::optional<FileFacts> checkpoint_facts(const std::filesystem::path& file) {
  if (!beginning(file, 19).starts_with("perifrac checkpoint")) return {};
  const Checkpoint checkpoint = read_checkpoint(file);
  Json fields = Json::object();
  for (const auto& [name, array] : checkpoint.state.fields()) {
    fields[name] = std::visit([](const auto& v) { return values(v.size()); }, array);
  }
  return FileFacts{
      .what = "checkpoint",
      .facts = {{"title", title_of(checkpoint.scene)},
                {"version", checkpoint.version},
                {"time", {{"value", checkpoint.time}, {"unit", "s"}}},
                {"windows", checkpoint.step},
                {"fields", fields},
                {"use", fmt::format("perifrac run SCENE --restart {}", file.string())}}};
}

std::optional<FileFacts> frame_facts(const std::filesystem::path& file) {
  if (beginning(file, 8) != "\x89HDF\r\n\x1a\n") return {};
  const Hdf5Reader reader(file);
  std::size_t points = 0;
  try {
    points = reader.read<double>("VTKHDF/Points").size() / 3;
  } catch (const InputError&) {
    return {};  // somebody else's
  }
  Json fields = Json::object();
  for (const std::string& name : reader.datasets("VTKHDF/PointData")) {
    const std::string path = "VTKHDF/PointData/" + name;
    const std::size_t count = reader.read<double>(path).size();
    fields[name] = {{"components", points > 0 ? count / points : 0},
                    {"unit", reader.read_text_attribute(path, "units")}};
  }
  return FileFacts{
      .what = "frame",
      .facts = {
          {"time",
           {{"value", reader.read<double>("VTKHDF/FieldData/TimeValue").at(0)}, {"unit", "s"}}},
          {"points", points},
          {"fields", fields},
          {"use", "perifrac export; ParaView 5.11 or later opens the .hdf.series beside it"}}};
}

}  // namespace perifrac
