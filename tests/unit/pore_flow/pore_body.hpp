#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/as_published/smoothed_euler.hpp"
#include "modules/pore_flow/boundary/pore_boundary.hpp"
#include "modules/pore_flow/darcy_cvode.hpp"
#include "modules/pore_flow/darcy_flow.hpp"
#include "modules/pore_flow/make_flow.hpp"
#include "modules/pore_flow/storage/linear_storage.hpp"
#include "tests/port_named.hpp"
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
  const auto family = body.family(boundary.mirrored(), boundary.sealed_layers());
  return {family, boundary.mirror_condition(*family), DarcyLaw<D>{mobility}};
}

/// The equations of a rock that is the same everywhere.
template <int D>
DarcySystem<D> darcy_system(const PoreBoundary<D>& boundary, FlowScheme scheme,
                            LinearExactOperator<D, DarcyLaw<D>> flow, const Rock& rock) {
  const std::vector<HeldPoint> held = boundary.held_points(flow.mirror());
  const ScheduledVector pressures = boundary.face_pressures(flow.mirror());
  ScheduledVector sources(0);
  if (boundary.has_sources()) sources = boundary.sources(test::force_of(flow));
  PoreMaterials materials{{{rock.biot_coefficient, 0.2, 0.0, rock.storage}},
                          std::vector<std::uint8_t>(flow.family().point_count, 0)};
  return {make_flow(scheme, std::move(flow)),
          std::make_unique<LinearStorage>(std::move(materials)),
          PoreFluid{.bulk_modulus = 1.0, .viscosity = 1.0, .density = rock.fluid_density},
          pressures,
          sources,
          {},
          held};
}

template <int D>
DarcySystem<D> darcy_system(const Body<D>& body, const PoreBoundary<D>& boundary,
                            const Rock& rock = some_rock,
                            FlowScheme scheme = FlowScheme::conservative) {
  return darcy_system(boundary, scheme, flow_operator<D>(body, boundary, rock.mobility), rock);
}

[[maybe_unused]] constexpr std::array schemes = {FlowScheme::conservative, FlowScheme::bond,
                                                 FlowScheme::nested};

inline const char* name_of(FlowScheme scheme) {
  constexpr std::array names = {"conservative", "bond", "nested"};
  return names[static_cast<std::size_t>(scheme)];
}

/// A box on a lattice whose last face, at the top, has a bonded layer behind it.
template <int D>
std::shared_ptr<const Body<D>> body_with_layer_on_top(const std::array<int, D>& counts,
                                                      double spacing) {
  return layered_body<D>(counts, spacing, face_bit(2 * D - 1));
}

/// A column of height 1, of pressure 1 at the start, drained at z = 1 and sealed at z = 0:
/// Terzaghi's series.
inline double drained_column(double z, double time_factor) {
  double p = 0.0;
  for (int n = 0; n < 60; ++n) {
    const double k = (n + 0.5) * std::numbers::pi;
    p += 2.0 / k * (n % 2 == 0 ? 1.0 : -1.0) * std::cos(k * z) * std::exp(-k * k * time_factor);
  }
  return p;
}

enum class Method { forward_euler, direct, krylov };
inline constexpr std::array methods = {Method::forward_euler, Method::direct, Method::krylov};
inline constexpr std::array method_names = {"forward_euler", "direct", "krylov"};
inline constexpr std::array symmetric_schemes = {FlowScheme::conservative, FlowScheme::bond};

template <int D>
DarcyIntegratorMaker<D> integrator_maker(Method method, double tolerance, double safety = 0.9) {
  return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
    using Systems = typename DarcyCvode<D>::Systems;
    if (method == Method::forward_euler) return std::make_unique<ForwardEuler>(system, safety);
    return std::make_unique<DarcyCvode<D>>(
        system, method == Method::direct ? Systems::factored : Systems::iterated, tolerance);
  };
}

inline PortView port(PhysicsModule& module, const std::string& name) {
  return test::port_named(module, name);
}

inline double scalar(PhysicsModule& module, const std::string& name) {
  return port(module, name).value[0];
}

}  // namespace perifrac::test
