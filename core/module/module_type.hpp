#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/module/physics_module.hpp"

namespace perifrac {

/// One word that a scene may put after `type:` in a physics section, and what it stands for.
/// All of them are listed in app/simulation/register_modules.cpp.
struct ModuleType {
  std::string section;  ///< the physics: `solid`, `pore_flow`, ...
  std::string name;     ///< the word: `quasi_static`
  std::string meaning;
  KeyTable keys;  ///< of the section, `type` apart

  /// Makes the module that the section describes; throws InputError. `body` is null in a scene
  /// without one.
  std::function<std::unique_ptr<PhysicsModule>(const Section& section, const AnyBody& body)> make;

  bool needs_body = true;  ///< is refused in a scene without one
};

}  // namespace perifrac
