#include <string>

#include <gtest/gtest.h>

#include "app/references/reference_types.hpp"
#include "app/simulation/simulation.hpp"
#include "core/base/errors.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac {
namespace {

TEST(RadialReference, RefusesAPlaneScene) {
  const Section scene = read_scene_text(R"(
dimension: 2
body: {shape: box, size: [4 m, 6 m], spacing: 1 m}
solid: {type: rigid}
time: {end: 1 s}
reference: {type: radial}
)",
                                        {});
  const Simulation simulation = make_simulation(scene);
  try {
    make_reference(scene, simulation);
    FAIL() << "a plane scene was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected dimension: 3"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace perifrac
