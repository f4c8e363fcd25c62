#include "core/geometry/face_conditions.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

namespace {

void refuse_foreign_keys(const Section& section, const FaceCondition& condition,
                         std::span<const FaceConditionType> types) {
  const auto own = std::ranges::find(types, condition.type, &FaceConditionType::name);
  for (const FaceConditionType& other : types) {
    for (const std::string& key : other.keys) {
      const std::string path = condition.path + "." + key;
      if (!section.has(path) || std::ranges::count(own->keys, key) > 0) continue;
      section.fail(
          path, fmt::format("does not belong to a face of type '{}'", condition.type),
          own->keys.empty() ? "no key but type" : fmt::format("{}", fmt::join(own->keys, ", ")));
    }
  }
}

}  // namespace

std::vector<FaceCondition> read_face_conditions(const Section& section, std::span<const Face> faces,
                                                std::span<const FaceConditionType> types) {
  std::vector<FaceCondition> conditions;
  if (!section.has("boundary")) return conditions;
  std::vector<std::string> known;
  for (const Face& face : faces) known.push_back(face.name);
  for (const std::string& name : section.names("boundary")) {
    const std::string path = "boundary." + name;
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) section.fail_unknown(path, name, known);
    const FaceCondition condition{static_cast<int>(found - known.begin()),
                                  section.word(path + ".type"), path};
    refuse_foreign_keys(section, condition, types);
    conditions.push_back(condition);
  }
  return conditions;
}

}  // namespace perifrac
