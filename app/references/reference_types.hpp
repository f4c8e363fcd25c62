#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A word of `reference.type` and what makes the comparison. `make` throws InputError where the
/// scene is not the problem that was solved; the manager must be initialised.
struct ReferenceType {
  std::string name;
  std::unique_ptr<Reference> (*make)(const Section& scene, const Simulation& simulation);
};

/// All references.
const std::vector<ReferenceType>& reference_types();

/// The one that `reference.type` names; none where the scene has no such section.
std::unique_ptr<Reference> make_reference(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
