#include "modules/pore_flow/material/pore_fluid.hpp"

#include <cmath>

namespace perifrac {

double PoreFluid::density_ratio(double p) const {
  if (is_linear()) return 1.0;
  return std::pow(1.0 + tait_exponent * p / bulk_modulus, 1.0 / tait_exponent);
}

double PoreFluid::potential(double p) const {
  if (is_linear()) return p;
  // K / (gamma - 1) [ratio^(gamma - 1) - 1], written so that small pressures keep their digits.
  const double exponent = 1.0 - 1.0 / tait_exponent;
  return bulk_modulus / (tait_exponent - 1.0) *
         std::expm1(exponent * std::log1p(tait_exponent * p / bulk_modulus));
}

double PoreFluid::pressure_of(double potential) const {
  if (is_linear()) return potential;
  const double exponent = tait_exponent / (tait_exponent - 1.0);
  return bulk_modulus / tait_exponent *
         std::expm1(exponent * std::log1p((tait_exponent - 1.0) * potential / bulk_modulus));
}

PoreFluid read_pore_fluid(const Section& section) {
  PoreFluid fluid{.bulk_modulus = section.number("fluid.bulk_modulus"),
                  .viscosity = section.number("fluid.viscosity"),
                  .density = section.number("fluid.density")};
  if (section.word("fluid.equation_of_state") == "tait") {
    fluid.tait_exponent = section.number("fluid.tait_exponent");
  }
  return fluid;
}

KeyTable pore_fluid_keys() {
  return {
      {.path = "fluid.bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Bulk modulus of the pore fluid, with tait at zero pressure."},
      {.path = "fluid.viscosity",
       .unit = "Pa s",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Dynamic viscosity of the pore fluid."},
      {.path = "fluid.density",
       .unit = "kg/m^3",
       .range = "(0, inf)",
       .fallback = "1000 kg/m^3",
       .meaning = "Density of the pore fluid at zero pressure, for the mass ledger and gravity."},
      {.path = "fluid.cavitation_pressure",
       .unit = "Pa",
       .meaning = "A run warns where pore pressure falls below it: the fluid would boil, and pores "
                  "that are simulated stay full. Left out: any suction is taken."},
      {.path = "fluid.equation_of_state",
       .type = KeyType::word,
       .fallback = "linear",
       .words = {"linear", "tait"},
       .meaning = "linear: constant storage, for pressures far below the bulk modulus. tait: "
                  "density, storage and mass flux follow the pressure."},
      {.path = "fluid.tait_exponent",
       .range = "(1, inf)",
       .fallback = "7.5",
       .meaning = "tait: how fast the fluid stiffens under pressure."},
  };
}

}  // namespace perifrac
