#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Says which crack begins so slanted on a face that the solid mirrors that bonds of one of its
/// sides go on to their own images through the rock on the other: bonds of two points break with
/// those of their images, and those two are on one side.
std::optional<std::string> slanted_at_mirror_warning(const Section& scene);

}  // namespace perifrac
