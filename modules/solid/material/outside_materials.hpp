#pragma once

#include <vector>

#include "core/module/outside_modules.hpp"
#include "modules/solid/material/material_type.hpp"

/// How a shared library of materials outside this tree shows what it holds: in one of its sources
///   PERIFRAC_MATERIALS(perifrac::mine_material())
/// Scenes name the library under `modules` (docs/add_a_material.md).
#define PERIFRAC_MATERIALS(...)                                      \
  extern "C" [[gnu::visibility("default")]] void perifrac_materials( \
      std::vector<perifrac::MaterialType>& types) {                  \
    types = {__VA_ARGS__};                                           \
  }
