#include "modules/pore_flow/material/pore_material.hpp"

#include <fmt/format.h>

#include "modules/pore_flow/material/region_path.hpp"

namespace perifrac {

namespace {

PoreMaterial read_material(const Section& section, const PoreFluid& fluid,
                           const std::string& region) {
  const std::string porosity_path = path_in_region(section, region, "porosity");
  const std::string alpha_path = path_in_region(section, region, "biot_coefficient");
  const std::string grain_path = path_in_region(section, region, "grain_bulk_modulus");
  PoreMaterial material{.biot_coefficient = section.number(alpha_path),
                        .porosity = section.number(porosity_path),
                        .grain_storage = 0.0,
                        .storage = 0.0};
  const double alpha = material.biot_coefficient, porosity = material.porosity;
  if (porosity > alpha && porosity_path.starts_with(region)) {
    section.fail(porosity_path,
                 fmt::format("{:g} is above the Biot coefficient, {:g}", porosity, alpha),
                 "a porosity at most biot_coefficient");
  }
  if (porosity > alpha) {
    section.fail(alpha_path, fmt::format("{:g} is below the porosity, {:g}", alpha, porosity),
                 "a Biot coefficient at least porosity");
  }
  if (section.has(grain_path)) {
    material.grain_storage = (alpha - porosity) / section.number(grain_path);
  }
  material.storage = porosity / fluid.bulk_modulus + material.grain_storage;
  return material;
}

}  // namespace

std::vector<PoreMaterial> read_pore_materials(const Section& section, const PoreFluid& fluid) {
  std::vector<PoreMaterial> materials;
  for (const std::string& region : region_prefixes(section)) {
    materials.push_back(read_material(section, fluid, region));
  }
  return materials;
}

KeyTable pore_material_keys() {
  return {
      {.path = "biot_coefficient",
       .range = "(0, 1]",
       .fallback = "1",
       .meaning = "Biot coefficient, the part of pore pressure that loads the rock."},
      {.path = "porosity",
       .range = "(0, 1)",
       .required = true,
       .meaning = "Volume of pores over volume of rock."},
      {.path = "grain_bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "Bulk modulus of the grains; incompressible where left out."},
      {.path = "regions.*.biot_coefficient",
       .range = "(0, 1]",
       .meaning = "In a region of the body; as outside it where left out."},
      {.path = "regions.*.porosity",
       .range = "(0, 1)",
       .meaning = "In a region of the body; as outside it where left out."},
      {.path = "regions.*.grain_bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "In a region of the body; as outside it where left out."},
  };
}

}  // namespace perifrac
