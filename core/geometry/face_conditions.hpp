#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/config/section.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

/// What a scene asks of one face: the subsection `boundary.<face>` of a physics.
struct FaceCondition {
  int face;
  std::string type;
  std::string path;  ///< `boundary.<face>`
};

/// The conditions under `boundary`, in the file's order. Throws InputError for a face the body does
/// not have, and for a type on a curved face that is none of `curved_types`.
std::vector<FaceCondition> read_face_conditions(const Section& section, std::span<const Face> faces,
                                                const std::vector<std::string>& curved_types);

}  // namespace perifrac
