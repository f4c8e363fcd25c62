#pragma once

#include "core/config/catalogue.hpp"

namespace perifrac {

/// All that a scene may say: the app's own keys, the body's, the coupling's and every module's.
const Catalogue& scene_catalogue();

}  // namespace perifrac
