#include "modules/solid/fracture/crack_friction_keys.hpp"

namespace perifrac {

namespace {

constexpr const char* name = "crack_friction";

}  // namespace

Key crack_friction_key() {
  return {.path = name,
          .range = "[0, inf)",
          .meaning =
              "quasi_static, 2D, cracks and rock without fluid: Coulomb's coefficient of friction "
              "between faces that touch; left out, they bear no shear."};
}

void refuse_crack_friction(const Section& section, const std::string& where,
                           const std::string& instead) {
  if (!section.has(name)) return;
  section.fail(name, where, instead + ", or a solid without crack_friction");
}

template <int D>
std::unique_ptr<CrackFriction> read_crack_friction(const Section& section) {
  if (!section.has(name)) return nullptr;
  if (D == 3) refuse_crack_friction(section, "in 3D", "dimension: 2");
  if (section.scene().has("crack_fluid")) {
    refuse_crack_friction(section, "beside fluid in cracks", "dry cracks");
  }
  if (section.scene().has("pore_flow")) {
    refuse_crack_friction(section, "beside pore flow, whose pressure faces do not feel",
                          "dry rock");
  }
  return std::make_unique<CrackFriction>(section.number(name));
}

template std::unique_ptr<CrackFriction> read_crack_friction<2>(const Section&);
template std::unique_ptr<CrackFriction> read_crack_friction<3>(const Section&);

}  // namespace perifrac
