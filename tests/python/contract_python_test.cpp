// The contract of modules, held to the pore flow of python/examples/own_flow.py.
#include <pybind11/embed.h>

#include <gtest/gtest.h>

#include "app/run/scene_keys.hpp"
#include "app/simulation/register_modules.hpp"
#include "core/config/scene.hpp"
#include "python/bindings/bindings.hpp"
#include "tests/contract/module_contract.hpp"

PYBIND11_EMBEDDED_MODULE(_perifrac, module) { perifrac::bind_all(module); }

namespace perifrac {
namespace {

std::unique_ptr<PhysicsModule> make_own_flow() {
  const Section scene =
      read_scene(PERIFRAC_SOURCE_DIR "/python/examples/own_flow.yaml", {}, scene_catalogue());
  const auto type = std::ranges::find(module_types(), "own_flow", &ModuleType::name);
  return type->make(scene.at("pore_flow"), make_body(scene.at("body"), 2));
}

INSTANTIATE_TEST_SUITE_P(InPython, ModuleContract,
                         testing::Values(ModuleCase{
                             "OwnFlow", make_own_flow, 1.0, {{"dilatation", 1e-5}}}),
                         case_name);

}  // namespace
}  // namespace perifrac

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const pybind11::scoped_interpreter interpreter;
  const auto path = pybind11::module_::import("sys").attr("path");
  path.attr("insert")(0, PERIFRAC_PACKAGE);
  path.attr("insert")(0, PERIFRAC_SOURCE_DIR "/python/examples");
  // The package finds what this program holds in place of the extension.
  const auto modules = pybind11::module_::import("sys").attr("modules");
  modules["perifrac._perifrac"] = pybind11::module_::import("_perifrac");
  pybind11::module_::import("own_flow");
  const pybind11::gil_scoped_release modules_take_it;
  return RUN_ALL_TESTS();
}
