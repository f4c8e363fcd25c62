#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Says where windows are so long beside free fluid that more mass of it answers a solid with
/// inertia within one, as far as sound comes, than the points at its surface have: what each sends
/// the other late then swings, and grows (Causin, Gerbeau & Nobile 2005).
std::optional<std::string> light_solid_warning(const Section& scene);

}  // namespace perifrac
