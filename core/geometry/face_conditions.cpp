#include "core/geometry/face_conditions.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

std::vector<FaceCondition> read_face_conditions(const Section& section, std::span<const Face> faces,
                                                const std::vector<std::string>& curved_types) {
  std::vector<FaceCondition> conditions;
  if (!section.has("boundary")) return conditions;
  std::vector<std::string> known;
  for (const Face& face : faces) known.push_back(face.name);
  for (const std::string& name : section.names("boundary")) {
    const std::string path = "boundary." + name;
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) section.fail_unknown(path, name, known);
    const int face = static_cast<int>(found - known.begin());
    const std::string type = section.word(path + ".type");
    if (faces[face].curved() && std::ranges::find(curved_types, type) == curved_types.end()) {
      section.fail(path + ".type", fmt::format("'{}' on a curved face", type),
                   fmt::format("one of: {}", fmt::join(curved_types, ", ")));
    }
    conditions.push_back({face, type, path});
  }
  return conditions;
}

}  // namespace perifrac
