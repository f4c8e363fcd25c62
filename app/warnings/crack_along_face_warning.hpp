#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Says which crack in 2D runs so near along a free face that the rock between is a beam of few
/// points, which bends too easily.
std::optional<std::string> crack_along_face_warning(const Section& scene);

}  // namespace perifrac
