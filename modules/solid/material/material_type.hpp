#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/bonds/family.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// What a material is made of.
template <int D>
struct MaterialParts {
  const Section& section;  ///< the solid's; the material's own keys are below `material`
  std::shared_ptr<const Family<D>> family;
  const MirrorCondition<D, D>& mirror;
  LawByRegion<IsotropicElasticity<D>> rock;  ///< of the two elastic constants that each scene gives
  std::optional<Vector<D>> initial_stress;   ///< normal stresses at rest, tension positive [Pa]
};

/// One word that a scene may put after `solid.material.type`, and what it stands for. All of them
/// are listed in modules/solid/material/material.cpp.
struct MaterialType {
  std::string name;
  std::string meaning;
  /// Beside the elastic constants, which each material has; paths seen from `material`.
  KeyTable keys{};
  bool is_linear = true;  ///< forces follow displacements linearly, whatever came before

  /// Make the operator that a solid moves by; throw InputError.
  std::unique_ptr<ElasticOperator<2>> (*make_2d)(const MaterialParts<2>&);
  std::unique_ptr<ElasticOperator<3>> (*make_3d)(const MaterialParts<3>&);
};

/// Those that a scene may name.
const std::vector<MaterialType>& material_types();

/// Adds one from outside this tree. What tables of keys were made before lacks it.
void add_material_type(MaterialType type);

/// Its keys as they stand in a solid's section.
KeyTable keys_of(const MaterialType& type);

}  // namespace perifrac
