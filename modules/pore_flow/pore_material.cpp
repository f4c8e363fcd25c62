#include "modules/pore_flow/pore_material.hpp"

#include <fmt/format.h>

namespace perifrac {

PoreMaterial read_pore_material(const Section& section) {
  const double alpha = section.number("biot_coefficient");
  const double porosity = section.number("porosity");
  if (porosity > alpha) {
    section.fail("porosity",
                 fmt::format("{:g} is above the Biot coefficient, {:g}", porosity, alpha),
                 "a porosity at most biot_coefficient");
  }
  PoreMaterial material{};
  material.biot_coefficient = alpha;
  material.storage = porosity / section.number("fluid.bulk_modulus");
  if (section.has("grain_bulk_modulus")) {
    material.storage += (alpha - porosity) / section.number("grain_bulk_modulus");
  }
  material.mobility = section.number("permeability") / section.number("fluid.viscosity");
  material.fluid_density = section.number("fluid.density");
  return material;
}

KeyTable pore_material_keys() {
  return {
      {.path = "permeability",
       .unit = "m^2",
       .range = "[0, inf)",
       .required = true,
       .meaning = "Intrinsic permeability."},
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
      {.path = "fluid.bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Bulk modulus of the pore fluid."},
      {.path = "fluid.viscosity",
       .unit = "Pa s",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Dynamic viscosity of the pore fluid."},
      {.path = "fluid.density",
       .unit = "kg/m^3",
       .range = "(0, inf)",
       .fallback = "1000 kg/m^3",
       .meaning = "Density of the pore fluid, for the mass ledger."},
  };
}

}  // namespace perifrac
