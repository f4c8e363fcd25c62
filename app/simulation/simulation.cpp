#include "app/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/simulation/register_modules.hpp"
#include "app/simulation/scene_checks.hpp"
#include "core/base/errors.hpp"
#include "core/config/mistakes.hpp"
#include "core/profile/profile.hpp"
#include "coupling/coupling_keys.hpp"

namespace perifrac {

namespace {

const ModuleType& type_of(const std::string& physics, const std::string& name) {
  return *std::ranges::find_if(module_types(), [&](const ModuleType& type) {
    return type.section == physics && type.name == name;
  });
}

AnyBody make_body_if_any(const Section& scene) {
  const ProfilePart profiled("body");
  const int dimension = scene.integer("dimension");
  if (scene.has("body")) return make_body(scene.at("body"), dimension);
  if (dimension == 2) return std::shared_ptr<const Body<2>>();
  return std::shared_ptr<const Body<3>>();
}

std::unique_ptr<PhysicsModule> make_module(const Section& scene, const std::string& physics,
                                           const AnyBody& body) {
  const ProfilePart profiled(physics);
  const Section section = scene.at(physics);
  const ModuleType& type = type_of(physics, section.word("type"));
  if (type.needs_body && !scene.has("body")) {
    scene.fail(physics, "the scene has no body", "a section 'body'");
  }
  try {
    return type.make(section, body);
  } catch (const BodyError& error) {
    scene.fail("body", error.what(), error.expected());
  }
}

/// What several modules hand over to one in-port has one name.
void tell_apart(std::vector<Field>& fields, const std::vector<std::string>& of_module) {
  std::vector<std::string> names;
  for (const Field& field : fields) names.push_back(field.port.name);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (std::ranges::count(names, names[k]) > 1) fields[k].port.name += "_from_" + of_module[k];
  }
}

}  // namespace

bool Simulation::has_body() const {
  return std::visit([](const auto& b) { return b != nullptr; }, body);
}

const PointSet& Simulation::points() const {
  if (!has_body()) throw std::logic_error("the points of a body that the scene has not");
  return std::visit([](const auto& b) -> const PointSet& { return b->point_set(); }, body);
}

Simulation make_simulation(const Section& scene, std::vector<ModuleSlot> modules) {
  Simulation simulation;
  simulation.end = scene.number("time.end");
  Mistakes mistakes;
  const bool fits = check_sections_together(scene, mistakes);
  const bool has_body = mistakes.note([&] { simulation.body = make_body_if_any(scene); });
  for (const std::string& physics : physics_of(scene)) {
    if (!fits || !has_body) break;
    mistakes.note([&] {
      modules.push_back({physics, make_module(scene, physics, simulation.body)});
    });
  }
  if (physics_of(scene).empty()) {
    mistakes.note([&] {
      scene.fail("", "no physics is named",
                 fmt::format("at least one of the sections {}", fmt::join(physics_order(), ", ")));
    });
  }
  mistakes.throw_if_any();
  simulation.manager = std::make_unique<CouplingManager>(
      std::move(modules), read_coupling_options(scene.at("coupling"), simulation.end));
  return simulation;
}

void initialize(const Section& scene, Simulation& simulation) {
  try {
    simulation.manager->initialize(0.0);
  } catch (const BodyError& error) {
    scene.fail("body", error.what(), error.expected());
  }
  if (simulation.manager->split_is_unusable()) {
    scene.fail("coupling.split",
               fmt::format("`{}` suits none of the modules that depend on each other",
                           scene.word("coupling.split")),
               "automatic; fixed_stress for a quasi-static solid, undrained for a dynamic one");
  }
}

Index facet_count(const Simulation& simulation) {
  return std::visit(
      [](const auto& body) {
        return body ? static_cast<Index>(body->bond_state().facets().size()) : Index{0};
      },
      simulation.body);
}

double facet_size(const Simulation& simulation) {
  return std::visit(
      []<int D>(const std::shared_ptr<const Body<D>>& body) {
        return std::pow(body->spacing(), D - 1);
      },
      simulation.body);
}

std::vector<Field> fields_of(const CouplingManager& manager) {
  std::vector<Field> fields;
  std::vector<std::string> of_module;
  for (const ModuleSlot& slot : manager.modules()) {
    const auto ports = slot.module->ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      if (ports[id].direction != PortDirection::out || ports[id].role != PortRole::field) continue;
      fields.push_back({slot.module.get(), static_cast<PortId>(id), ports[id]});
      of_module.push_back(slot.name);
    }
  }
  tell_apart(fields, of_module);
  return fields;
}

std::optional<Field> find_field(const CouplingManager& manager, const std::string& name) {
  for (const Field& field : fields_of(manager)) {
    if (field.port.name == name) return field;
  }
  return {};
}

Field field_named(const CouplingManager& manager, const std::string& name) {
  const auto field = find_field(manager, name);
  if (!field) throw std::logic_error("no field " + name);
  return *field;
}

}  // namespace perifrac
