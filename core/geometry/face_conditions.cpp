#include "core/geometry/face_conditions.hpp"

#include <algorithm>

namespace perifrac {

std::vector<FaceCondition> read_face_conditions(const Section& section,
                                                std::span<const Face> faces) {
  std::vector<FaceCondition> conditions;
  if (!section.has("boundary")) return conditions;
  if (faces.empty()) section.fail("boundary", "a ball has no faces", "a body of shape box");
  std::vector<std::string> known;
  for (const Face& face : faces) known.push_back(face.name);
  for (const std::string& name : section.names("boundary")) {
    const std::string path = "boundary." + name;
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) section.fail_unknown(path, name, known);
    conditions.push_back(
        {static_cast<int>(found - known.begin()), section.word(path + ".type"), path});
  }
  return conditions;
}

}  // namespace perifrac
