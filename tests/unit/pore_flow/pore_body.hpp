#pragma once

#include <algorithm>
#include <string>

#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/conservative_flow.hpp"
#include "modules/pore_flow/darcy_cvode.hpp"
#include "modules/pore_flow/darcy_flow.hpp"
#include "modules/pore_flow/linear_storage.hpp"
#include "modules/pore_flow/pore_boundary.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac::test {

struct Rock {
  double biot_coefficient;
  double storage;
  double mobility;
  double fluid_density;
};

constexpr Rock some_rock{
    .biot_coefficient = 0.8, .storage = 0.3, .mobility = 0.7, .fluid_density = 1.5};

template <int D>
LinearExactOperator<D, DarcyLaw<D>> flow_operator(const Body<D>& body,
                                                  const PoreBoundary<D>& boundary,
                                                  double mobility) {
  const auto family = body.family(boundary.mirrored());
  return {family, boundary.mirror_condition(*family), DarcyLaw<D>{mobility}};
}

template <int D>
DarcySystem<D> darcy_system(const Body<D>& body, const PoreBoundary<D>& boundary,
                            const Rock& rock = some_rock) {
  auto flow = flow_operator<D>(body, boundary, rock.mobility);
  const ScheduledVector pressures = boundary.face_pressures(flow.mirror());
  ScheduledVector sources(0);
  if (boundary.has_sources()) sources = boundary.sources(flow.gradient_matrix());
  PoreMaterials materials{{{rock.biot_coefficient, 0.2, 0.0, rock.storage}},
                          std::vector<std::uint8_t>(body.points().size(), 0)};
  return {std::make_unique<ConservativeFlow<D, DarcyLaw<D>>>(std::move(flow)),
          std::make_unique<LinearStorage>(std::move(materials)),
          PoreFluid{.bulk_modulus = 1.0, .viscosity = 1.0, .density = rock.fluid_density},
          pressures, sources};
}

enum class Method { forward_euler, direct, krylov };

template <int D>
DarcyIntegratorMaker<D> integrator_maker(Method method, double tolerance, double safety = 0.9) {
  return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
    using Matrix = DarcyNewtonMatrix<D>;
    if (method == Method::forward_euler) return std::make_unique<ForwardEuler>(system, safety);
    return std::make_unique<DarcyCvode<D>>(
        system, method == Method::direct ? Matrix::Method::direct : Matrix::Method::preconditioner,
        tolerance);
  };
}

inline PortView port(PhysicsModule& module, const std::string& name) {
  const auto ports = module.ports();
  const auto found = std::ranges::find(ports, name, &Port::name);
  return module.port(static_cast<PortId>(found - ports.begin()));
}

inline double scalar(PhysicsModule& module, const std::string& name) {
  return port(module, name).value[0];
}

}  // namespace perifrac::test
