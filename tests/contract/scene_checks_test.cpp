#include "app/simulation/scene_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac {
namespace {

const std::string with_fluid = box_2d + rigid + darcy + R"(
fluid: {type: stand_in, density: 1000 kg/m^3}
)";

/// The catalogue, and as much of a fluid as the checks ask for.
std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Catalogue catalogue = scene_catalogue();
  std::erase_if(catalogue, [](const SectionKeys& entry) {
    return entry.section == "fluid" || entry.section == "interface";
  });
  catalogue.push_back(
      {"fluid", "stand_in", {{.path = "density", .unit = "kg/m^3", .meaning = "Density."}}});
  catalogue.push_back({"interface",
                       "",
                       {{.path = "exchange",
                         .type = KeyType::word,
                         .fallback = "bond_flux",
                         .words = {"bond_flux", "none"},
                         .meaning = "Exchange of mass."}},
                       "",
                       true});
  try {
    Mistakes mistakes;
    check_sections_together(read_scene_text(text, overrides, catalogue), mistakes);
    mistakes.throw_if_any();
    return "";
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.substr(what.find(": ") + 2);
  }
}

TEST(SceneChecks, AFluidOnABodyNeedsAnInterface) {
  EXPECT_EQ(complaint(with_fluid),
            "fluid: a fluid beside a body, and nothing says how they meet; expected a section "
            "interface");
  EXPECT_EQ(complaint(with_fluid + "interface: {exchange: bond_flux}\n"), "");
}

TEST(SceneChecks, AnInterfaceNeedsFluidAndBody) {
  const auto message = [](const std::string& side) {
    return "interface: the scene has no section '" + side +
           "'; expected an interface where free fluid meets a body";
  };
  EXPECT_EQ(complaint(box_2d + rigid + "interface: {}\n"), message("fluid"));
  EXPECT_EQ(complaint("dimension: 2\ntime: {end: 1 s}\nfluid: {type: stand_in}\ninterface: {}\n"),
            message("body"));
  EXPECT_EQ(complaint("dimension: 2\ntime: {end: 1 s}\nfluid: {type: stand_in}\n"), "");
}

TEST(SceneChecks, FluidsThatMixHaveOneDensity) {
  const std::string scene = with_fluid + "interface: {exchange: bond_flux}\n";
  EXPECT_EQ(complaint(scene, {"fluid.density=1030 kg/m^3"}),
            "fluid.density: 1030 kg/m^3 of the fluid that flows into the pores; expected "
            "pore_flow.fluid.density, 1000 kg/m^3");
  EXPECT_EQ(complaint(scene, {"fluid.density=1030 kg/m^3", "interface.exchange=none"}), "");
  EXPECT_EQ(complaint(scene, {"fluid.density=0.9 g/cm^3", "pore_flow.fluid.density=900 kg/m^3"}),
            "");
}

}  // namespace
}  // namespace perifrac
