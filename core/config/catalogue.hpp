#pragma once

#include <string>
#include <vector>

#include "core/config/key.hpp"

namespace perifrac {

/// The keys of one top-level section of a scene (of the top level itself: `section` is empty).
/// With a `type`, they are those of one implementation: the section gets a key `type` that picks
/// it. A section with a key `type`, so made or declared, and an optional one are off where the
/// scene leaves them out; the keys of all others hold in every scene.
struct SectionKeys {
  std::string section;
  std::string type;
  KeyTable keys;
  std::string meaning{};  ///< of the type, or of the section
  bool optional = false;
};

/// All that a scene, or another file of ours, may say. Where keys are vectors or have a unit by
/// dimension, the top level declares an integer `dimension`, 2 or 3.
using Catalogue = std::vector<SectionKeys>;

}  // namespace perifrac
