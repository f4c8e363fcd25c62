#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/body/body.hpp"
#include "core/config/section.hpp"
#include "coupling/manager.hpp"

namespace perifrac {

/// What a scene makes: a body, the physics on it, and the manager that couples them.
struct Simulation {
  AnyBody body;  ///< null where the scene has none
  std::unique_ptr<CouplingManager> manager;
  double end;  ///< [s]

  bool has_body() const;
  const PointSet& points() const;  ///< of the body, which the scene must have
};

/// Builds all that the scene calls for and nothing else, beside modules that are there already:
/// those advance first. Throws InputError.
Simulation make_simulation(const Section& scene, std::vector<ModuleSlot> modules = {});

/// Makes it ready at t = 0. Throws InputError where no modules can use the scene's split, and
/// NumericalError.
void initialize(const Section& scene, Simulation& simulation);

/// Of the cracks that there are by now; 0 without a body.
Index facet_count(const Simulation& simulation);
/// How long a facet is [m], in 3D its area [m^2].
double facet_size(const Simulation& simulation);

/// An out-port that lives on points.
struct Field {
  PhysicsModule* module;
  PortId id;
  Port port;

  std::span<const double> values() const { return module->port(id).value; }
  const PointSet& points() const { return *module->port(id).points; }
};

/// Every field of every module, in the modules' order; one that several have is
/// `<name>_from_<module>`.
std::vector<Field> fields_of(const CouplingManager& manager);

/// The first field of that name, if any.
std::optional<Field> find_field(const CouplingManager& manager, const std::string& name);

/// The field of that name; throws std::logic_error where there is none.
Field field_named(const CouplingManager& manager, const std::string& name);

}  // namespace perifrac
