#pragma once

#include <string>

namespace perifrac {

/// Takes a scene file the way of `perifrac check`, up to its first window. What is refused as it
/// should be (InputError, NumericalError) is fine; whatever else happens is a fault. Bodies and
/// fluids of more than some hundred points are left unmade: they only take longer.
void read_any_scene(const std::string& file);

}  // namespace perifrac
