// A solid that moves on its own: no program, no coupling, no other physics is linked to it.
//   perifrac_solid_step SCENE STEPS          so many steps of the solid, within one window
//   perifrac_solid_step SCENE STEPS forces   so many times the forces of its bonds, and nothing
//   else
// Two counts of steps, subtracted, leave a step (instructions.py).
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "core/body/crack_seeds.hpp"
#include "core/config/scene.hpp"
#include "modules/solid/boundary/solid_boundary_keys.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/material.hpp"
#include "modules/solid/solid_types.hpp"

namespace {

using namespace perifrac;

/// All that a scene of a solid alone may say.
Catalogue catalogue() {
  KeyTable top_level = crack_seed_keys();
  top_level.push_back({.path = "dimension",
                       .type = KeyType::integer,
                       .range = "[2, 3]",
                       .required = true,
                       .meaning = "2."});
  top_level.push_back({.path = "gravity",
                       .type = KeyType::vector,
                       .unit = "m/s^2",
                       .meaning = "Acceleration of gravity."});
  const KeyTable time = {
      {.path = "end", .unit = "s", .required = true, .meaning = "Not used: steps are counted."}};
  const ModuleType solid = dynamic_solid_type();
  return {{"", "", top_level},
          {"body", "", body_keys()},
          {solid.section, solid.name, solid.keys},
          {"damage", "", damage_keys(), "", true},
          {"time", "", time}};
}

void move(const Section& section, const AnyBody& body, int steps) {
  const auto solid = dynamic_solid_type().make(section, body);
  solid->initialize(0.0);
  const double end = steps * solid->stable_time_step() * (1.0 - 1e-9);
  solid->advance({0.0, end});
}

void find_forces(const Section& section, const Body<2>& body, int times) {
  const auto boundary = read_solid_boundary<2>(section, body);
  const auto elastic = read_material<2>(section, body, boundary);
  std::vector<double> u(elastic->size(), 0.0), force(elastic->size());
  for (int n = 0; n < times; ++n) elastic->apply(u, {}, force, {});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: perifrac_solid_step SCENE STEPS [forces]\n", stderr);
    return 2;
  }
  try {
    const Section scene = read_scene(argv[1], {}, catalogue());
    const AnyBody body = make_body(scene.at("body"), 2);
    const int steps = std::atoi(argv[2]);
    if (argc > 3 && std::string_view(argv[3]) == "forces") {
      find_forces(scene.at("solid"), *std::get<std::shared_ptr<const Body<2>>>(body), steps);
    } else {
      move(scene.at("solid"), body, steps);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
