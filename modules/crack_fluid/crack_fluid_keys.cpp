#include "modules/crack_fluid/crack_fluid_keys.hpp"

#include <optional>

#include <fmt/format.h>

#include "core/config/mistakes.hpp"
#include "modules/crack_fluid/carter_leak_off.hpp"
#include "modules/crack_fluid/crack_fluid.hpp"
#include "modules/crack_fluid/crack_inlet_keys.hpp"
#include "modules/crack_fluid/crack_places.hpp"

namespace perifrac {

namespace {

template <int D>
std::vector<CrackFilling<D>> read_fillings(const Section& section, const CrackLiquid& liquid) {
  std::vector<CrackFilling<D>> fillings;
  for (std::size_t k = 0; k < section.count("filled"); ++k) {
    const std::string path = fmt::format("filled[{}]", k);
    CrackFilling<D> filling{.box = {}, .pressure = section.number(path + ".pressure")};
    if (filling.pressure < liquid.vapour_pressure) {
      section.fail(path + ".pressure", "a full crack under less than the vapour pressure",
                   "vapour_pressure or more");
    }
    std::ranges::copy(section.numbers(path + ".from"), filling.box.from.begin());
    std::ranges::copy(section.numbers(path + ".to"), filling.box.to.begin());
    fillings.push_back(filling);
  }
  return fillings;
}

template <int D>
SealedWalls<D> read_sealed_walls(const Section& section) {
  std::vector<Region<D>> boxes;
  for (std::size_t k = 0; k < section.count("sealed"); ++k) {
    Region<D> box;
    std::ranges::copy(section.numbers(fmt::format("sealed[{}].from", k)), box.from.begin());
    std::ranges::copy(section.numbers(fmt::format("sealed[{}].to", k)), box.to.begin());
    boxes.push_back(box);
  }
  if (!boxes.empty() && section.word("leak_off") == "none") {
    section.fail("sealed", "nothing leaks off", "leak_off: carter or pores");
  }
  return SealedWalls<D>(std::move(boxes));
}

/// Carter's, of the whole rock and of regions of the body.
template <int D>
ByRegion<D, double> read_leak_off_coefficient(const Section& section, const Body<D>& body) {
  ByRegion<D, double> coefficient{section.number("leak_off_coefficient")};
  if (!section.has("regions")) return coefficient;
  region_of_points<D>(section, body.regions(), body.points());  // says which do not exist
  for (const std::string& name : section.names("regions")) {
    coefficient.inside.emplace_back(*std::ranges::find(body.regions(), name, &Region<D>::name),
                                    section.number("regions." + name + ".leak_off_coefficient"));
  }
  return coefficient;
}

/// Null where the rock takes nothing.
template <int D>
std::unique_ptr<LeakOff> read_leak_off(const Section& section, std::shared_ptr<const Body<D>> body,
                                       const CrackLiquid& liquid) {
  const std::string word = section.word("leak_off");
  SealedWalls<D> sealed = read_sealed_walls<D>(section);
  if (section.has("regions") && word != "carter") {
    section.fail(
        "regions", fmt::format("beside leak_off: {}", word),
        word == "pores" ? "pore_flow.regions, which the crack leaks into" : "leak_off: carter");
  }
  if (word == "none") return nullptr;
  if (word == "pores") {
    return std::make_unique<PoreLeakOff<D>>(std::move(body), liquid.density, liquid.vapour_pressure,
                                            std::move(sealed), read_gravity<D>(section));
  }
  return std::make_unique<CarterLeakOff<D>>(read_leak_off_coefficient(section, *body),
                                            section.number("density"), std::move(sealed));
}

}  // namespace

CrackLiquid read_crack_liquid(const Section& section, double viscosity) {
  const CrackLiquid liquid{.density = section.number("density"),
                           .viscosity = viscosity,
                           .bulk_modulus = section.number("bulk_modulus"),
                           .vapour_pressure = section.number("vapour_pressure"),
                           .residual_aperture = section.number("residual_aperture")};
  if (liquid.vapour_pressure <= -liquid.bulk_modulus) {
    section.fail("vapour_pressure", "there is no fluid that far under tension",
                 "above -bulk_modulus");
  }
  return liquid;
}

template <int D>
std::unique_ptr<PhysicsModule> make_crack_fluid(const Section& section,
                                                std::shared_ptr<const Body<D>> body,
                                                const CrackLiquid& liquid,
                                                std::unique_ptr<CrackFlow> flow) {
  std::unique_ptr<LeakOff> leak_off;
  std::optional<CrackInlets> inlets;
  std::vector<CrackFilling<D>> fillings;
  std::unique_ptr<CrackOutlets<D>> outlets;
  Mistakes mistakes;
  mistakes.note([&] { check_crack_places(section, *body); });
  mistakes.note([&] { leak_off = read_leak_off(section, body, liquid); });
  mistakes.note([&] { inlets = read_crack_inlets(section, liquid); });
  mistakes.note([&] { fillings = read_fillings<D>(section, liquid); });
  mistakes.note([&] {
    outlets = std::make_unique<CrackOutlets<D>>(body, read_behind_faces<D>(section.scene(), *body));
  });
  mistakes.throw_if_any();
  return std::make_unique<CrackFluid<D>>(
      std::move(body), liquid, std::move(flow), std::move(*inlets), std::move(fillings),
      std::move(leak_off), std::move(outlets), read_gravity<D>(section));
}

template std::unique_ptr<PhysicsModule> make_crack_fluid<2>(const Section&,
                                                            std::shared_ptr<const Body<2>>,
                                                            const CrackLiquid&,
                                                            std::unique_ptr<CrackFlow>);
template std::unique_ptr<PhysicsModule> make_crack_fluid<3>(const Section&,
                                                            std::shared_ptr<const Body<3>>,
                                                            const CrackLiquid&,
                                                            std::unique_ptr<CrackFlow>);

// NOLINTNEXTLINE(readability-function-size): a table
KeyTable crack_fluid_keys() {
  KeyTable keys = {
      {.path = "density",
       .unit = "kg/m^3",
       .range = "(0, inf)",
       .fallback = "1000 kg/m^3",
       .meaning = "Density at zero pressure."},
      {.path = "bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Bulk modulus at zero pressure."},
      {.path = "vapour_pressure",
       .unit = "Pa",
       .fallback = "0 Pa",
       .meaning = "Pressure in a crack that is not full of fluid, the least there is."},
      {.path = "residual_aperture",
       .unit = "m",
       .range = "(0, inf)",
       .fallback = "2 um",
       .meaning = "Width of a closed crack, which fluid is stored in and flows through."},
      {.path = "filled[].from",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Low corner of a box whose cracks are full at the start; others are dry."},
      {.path = "filled[].to",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its high corner."},
      {.path = "filled[].pressure",
       .unit = "Pa",
       .fallback = "0 Pa",
       .meaning = "The pressure in them."},
      {.path = "leak_off",
       .type = KeyType::word,
       .fallback = "none",
       .words = {"none", "carter", "pores"},
       .meaning = "What the rock takes. carter: Carter's law, where no pore flow is simulated. "
                  "pores: what pore_flow takes."},
      {.path = "leak_off_coefficient",
       .unit = "m/s*sqrt(s)",
       .range = "[0, inf)",
       .required = true,
       .when = "leak_off=carter",
       .meaning = "Carter's coefficient of one side of a crack."},
      {.path = "regions.*.leak_off_coefficient",
       .unit = "m/s*sqrt(s)",
       .range = "[0, inf)",
       .required = true,
       .meaning = "carter: the same in a region of the body (body.regions); a facet is where its "
                  "middle is."},
      {.path = "sealed[].from",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Low corner of a box whose cracks have walls that nothing leaks through."},
      {.path = "sealed[].to",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its high corner."},
  };
  const KeyTable inlets = crack_inlet_keys();
  keys.insert(keys.end(), inlets.begin(), inlets.end());
  return keys;
}

}  // namespace perifrac
