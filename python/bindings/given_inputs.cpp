#include "python/bindings/given_inputs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"

namespace perifrac {

namespace {

/// Some module writes the in-port.
bool is_written(const CouplingManager& manager, const std::string& name) {
  return std::ranges::any_of(manager.modules(), [&](const ModuleSlot& slot) {
    return slot.name != GivenInputs::module_name &&
           std::ranges::any_of(slot.module->ports(), [&](const Port& port) {
             return port.direction == PortDirection::out && port.name == name;
           });
  });
}

/// Those that nobody writes, as `solid.interface_impulse`.
std::vector<std::string> free_inputs(const CouplingManager& manager) {
  std::vector<std::string> names;
  for (const ModuleSlot& slot : manager.modules()) {
    for (const Port& port : slot.module->ports()) {
      if (port.direction == PortDirection::in && !is_written(manager, port.name)) {
        names.push_back(slot.name + "." + port.name);
      }
    }
  }
  return names;
}

}  // namespace

void GivenInputs::find(const CouplingManager& manager) {
  for (const std::string& name : names_) add(name, manager);
}

void GivenInputs::add(const std::string& name, const CouplingManager& manager) {
  const auto known = free_inputs(manager);
  if (std::ranges::find(known, name) == known.end()) {
    throw InputError(fmt::format(
        "inputs: {} is no in-port that the scene leaves unlinked; {}", in_quotes(name),
        known.empty() ? "expected none, for it has no such port" : expected_one_of(known, name)));
  }
  for (const ModuleSlot& slot : manager.modules()) {
    const auto ports = slot.module->ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      if (ports[id].direction != PortDirection::in || slot.name + "." + ports[id].name != name) {
        continue;
      }
      ports_.push_back(ports[id]);
      ports_.back().direction = PortDirection::out;
      ports_.back().role = PortRole::property;
      targets_.push_back({slot.module.get(), static_cast<PortId>(id)});
    }
  }
}

PortView GivenInputs::port(PortId id) {
  Target& target = targets_[id];
  const PointSet* const points = target.module->port(target.port).points;
  target.values.resize(ports_[id].components * points->count);
  return {points, target.values};
}

std::size_t GivenInputs::place_of(const std::string& name) const {
  const auto place = std::ranges::find(names_, name);
  if (place == names_.end()) {
    throw InputError(
        fmt::format("inputs: {} was not asked for; expected it in inputs=[...]", in_quotes(name)));
  }
  return place - names_.begin();
}

std::span<double> GivenInputs::values(const std::string& name) {
  return port(static_cast<PortId>(place_of(name))).value;
}

void GivenInputs::visit_state(StateVisitor& visitor) {
  for (std::size_t k = 0; k < targets_.size(); ++k) visitor.visit(names_[k], targets_[k].values);
}

}  // namespace perifrac
