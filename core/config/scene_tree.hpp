#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/config/key_tree.hpp"
#include "core/config/key_value.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A validated scene: what every path holds, defaults included, and which paths there may be.
struct SceneTree {
  struct Entry {
    KeyValue value{};
    std::string place{};                  ///< empty: a default, written nowhere
    std::vector<std::string> children{};  ///< of a map, in the file's order; `[i]` of a list
  };

  KeyNode keys;
  std::string folder{};  ///< of the scene's file; files that it names are beside it
  std::map<std::string, Entry, std::less<>> entries{};  ///< by full path; the root's is empty
  GivenFactors given{};                                 ///< none but where a scene is run by hand
};

}  // namespace perifrac
