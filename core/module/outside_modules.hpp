#pragma once

#include <vector>

#include "core/module/build_stamp.hpp"
#include "core/module/module_type.hpp"

/// How a shared library of modules outside this tree shows what it holds: in one of its sources
///   PERIFRAC_MODULES(perifrac::mine_type())
/// Scenes name the library under `modules` (docs/add_a_module.md).

namespace {

/// Found in the file before it is loaded.
[[gnu::used]] const char perifrac_built_as[] = "perifrac-module-built-as:" PERIFRAC_STAMP;

}  // namespace

#define PERIFRAC_MODULES(...)                                      \
  extern "C" [[gnu::visibility("default")]] void perifrac_modules( \
      std::vector<perifrac::ModuleType>& types) {                  \
    types = {__VA_ARGS__};                                         \
  }
