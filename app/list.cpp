#include "app/list.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/run/scene_keys.hpp"
#include "app/simulation/register_modules.hpp"
#include "app/study/study_keys.hpp"
#include "core/config/reference_page.hpp"

namespace perifrac {

namespace {

nlohmann::json keys_as_json() {
  nlohmann::json keys = nlohmann::json::array();
  for (const KeyReference& key : list_keys(scene_catalogue())) {
    keys.push_back({{"section", key.section},
                    {"type", key.type},
                    {"path", key.path},
                    {"kind", key.kind},
                    {"words", key.words},
                    {"unit", key.unit},
                    {"range", key.range},
                    {"default", key.fallback},
                    {"required", key.required},
                    {"when", key.when},
                    {"meaning", key.meaning}});
  }
  return keys;
}

}  // namespace

int list_modules(bool json) {
  if (json) {
    nlohmann::json modules = nlohmann::json::array();
    for (const ModuleType& type : module_types()) {
      modules.push_back(
          {{"section", type.section}, {"type", type.name}, {"meaning", type.meaning}});
    }
    fmt::print("{}\n", nlohmann::json{{"modules", modules}, {"keys", keys_as_json()}}.dump(2));
    return 0;
  }
  for (const ModuleType& type : module_types()) {
    fmt::print("{}: {}\n    {}\n", type.section, type.name, type.meaning);
  }
  fmt::print("\nkeys\n");
  for (const KeyReference& key : list_keys(scene_catalogue())) {
    const std::string section = key.section.empty() ? "" : key.section + ".";
    const std::string type = key.type.empty() ? "" : fmt::format(" ({})", key.type);
    fmt::print("  {}{}{}{}\n      {}\n", section, key.path, type,
               key.unit.empty() ? "" : " [" + key.unit + "]", key.meaning);
  }
  return 0;
}

int print_reference_page() {
  fmt::print("{}", reference_page(scene_catalogue()));
  fmt::print(
      "\n# Studies\n\nWhat a file of `perifrac study` may say ([studies.md](studies.md)).\n{}",
      reference_tables(study_catalogue()));
  return 0;
}

}  // namespace perifrac
