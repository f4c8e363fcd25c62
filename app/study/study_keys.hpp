#pragma once

#include "core/config/catalogue.hpp"

namespace perifrac {

/// What a study file may say.
const Catalogue& study_catalogue();

}  // namespace perifrac
