#include "modules/pore_flow/flow_in_scene.hpp"

#include <algorithm>

#include "core/geometry/scatter.hpp"
#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/as_published/smoothed_euler.hpp"
#include "modules/pore_flow/boundary/pore_gravity.hpp"
#include "modules/pore_flow/darcy_cvode.hpp"
#include "modules/pore_flow/darcy_flow.hpp"
#include "modules/pore_flow/material/mobility.hpp"
#include "modules/pore_flow/storage/storage_choice.hpp"

namespace perifrac {

namespace {

template <int D>
DarcyIntegratorMaker<D> read_integrator(const Section& section, Index points) {
  if (section.word("integrator.type") == "explicit") {
    const double safety = section.number("integrator.safety");
    return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
      if (!system.smooths()) return std::make_unique<ForwardEuler>(system, safety);
      return std::make_unique<SmoothedEuler>(
          system, safety, [&system](double t, std::span<double> y) { system.smooth(t, y); });
    };
  }
  using Systems = typename DarcyCvode<D>::Systems;
  const Systems systems = factors_flow(section, points) ? Systems::factored : Systems::iterated;
  const double tolerance = section.number("integrator.tolerance");
  return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
    return std::make_unique<DarcyCvode<D>>(system, systems, tolerance);
  };
}

template <int D>
InitialPressure<D> read_initial_pressure(const Section& section) {
  InitialPressure<D> initial{.value = section.number("initial_pressure"),
                             .is_hydrostatic = section.word("initial_state") == "hydrostatic"};
  if (section.has("initial_gradient")) {
    std::ranges::copy(section.numbers("initial_gradient"), initial.gradient.begin());
  }
  return initial;
}

}  // namespace

bool factors_flow(const Section& flow, double points) {
  constexpr double points_worth_iteration = 1000.0;
  if (flow.word("integrator.type") != "cvode") return false;
  const std::string solver = flow.word("integrator.linear_solver");
  if (solver != "automatic") return solver == "direct";
  const bool is_nested = flow.has("operator") && flow.word("operator") == "nested";
  return !is_nested && points < points_worth_iteration;
}

template <int D>
FlowInScene<D> read_flow(const Section& section, const Body<D>& body) {
  PoreBoundary<D> boundary = read_pore_boundary<D>(section, body);
  const PoreFluid fluid = read_pore_fluid(section);
  std::vector<std::uint8_t> region = region_of_points<D>(section, body.regions(), body.points());
  PoreMaterials materials{read_pore_materials(section, fluid), std::move(region)};
  return {std::move(boundary), fluid, std::move(materials),
          read_mobilities<D>(section, fluid.viscosity)};
}

template <int D>
LawByRegion<AnisotropicDarcyLaw<D>> read_law(const Section& section, const Body<D>& body,
                                             const FlowInScene<D>& scene) {
  LawByRegion<AnisotropicDarcyLaw<D>> law{.laws = {}, .law_of_point = scene.region()};
  for (const Tensor<D, D>& mobility : scene.mobilities) law.laws.push_back({mobility});
  const auto scatter = read_scatter<D>(section, "permeability_scatter");
  if (!scatter) return law;
  return scattered(law, *scatter, body.points(),
                   [](const auto& rock, double factor) { return rock.times(factor); });
}

template <int D>
DarcySystem<D> make_equations(const Section& section, const std::shared_ptr<const Body<D>>& body,
                              const FlowInScene<D>& scene, const MirrorCondition<D, 1>& mirror,
                              Discretisation<D> space) {
  const auto& [boundary, fluid, materials, mobilities] = scene;
  auto storage = make_storage(section, *body, fluid, materials);
  Eigen::VectorXd gravity;
  if (const Vector<D> g = read_gravity<D>(section); g != Vector<D>{}) {
    gravity = PoreGravity<D>(*body, g, fluid.density).values(mirror, boundary.pressure_layers());
  }
  DarcySystem<D> system(std::move(space.flow), std::move(storage), fluid,
                        boundary.face_pressures(mirror), std::move(space.sources), gravity,
                        boundary.held_points(mirror));
  system.let_storage_be_chosen(storage_choice(section, body, materials));
  return system;
}

template <int D>
std::unique_ptr<PhysicsModule> make_flow_module(const Section& section,
                                                std::shared_ptr<const Body<D>> body,
                                                DarcySystem<D> equations) {
  return std::make_unique<DarcyFlow<D>>(std::move(body), std::move(equations),
                                        read_initial_pressure<D>(section),
                                        read_integrator<D>(section, body->points().size()));
}

KeyTable flow_keys() {
  // Keys of one integrator may stand beside another, so that one word swaps them.
  KeyTable keys = {
      {.path = "integrator.type",
       .type = KeyType::word,
       .fallback = "cvode",
       .words = {"explicit", "cvode"},
       .meaning = "explicit: forward Euler, sub-steps at the stable limit. cvode: implicit BDF."},
      {.path = "integrator.safety",
       .range = "(0, 1)",
       .fallback = "0.9",
       .meaning = "explicit: sub-step over the stable limit."},
      {.path = "integrator.linear_solver",
       .type = KeyType::word,
       .fallback = "automatic",
       .words = {"automatic", "direct", "krylov"},
       .meaning =
           "cvode: direct factors the flow; krylov iterates with GMRES, preconditioned by "
           "multigrid, at a price in proportion to the points; automatic takes krylov from 1000 "
           "points on, and for the nested operator."},
      {.path = "integrator.tolerance",
       .range = "(0, 0.1]",
       .fallback = "1e-5",
       .meaning = "cvode: largest error of a step over the largest pressure."},
      {.path = "initial_pressure",
       .unit = "Pa",
       .fallback = "0 Pa",
       .meaning =
           "Pore pressure at the start, if hydrostatic at the highest corner of the body, if "
           "linear at the origin."},
      {.path = "initial_state",
       .type = KeyType::word,
       .fallback = "uniform",
       .words = {"uniform", "hydrostatic", "linear"},
       .meaning = "hydrostatic: the pressure grows downwards by the fluid's weight. linear: by "
                  "initial_gradient."},
      {.path = "initial_gradient",
       .type = KeyType::vector,
       .unit = "Pa/m",
       .required = true,
       .when = "initial_state=linear",
       .meaning = "Pressure grows by it along each axis."},
  };
  for (const KeyTable& part : {permeability_keys(), pore_material_keys(), pore_fluid_keys(),
                               pore_boundary_keys(), storage_choice_keys()}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

template FlowInScene<2> read_flow<2>(const Section&, const Body<2>&);
template FlowInScene<3> read_flow<3>(const Section&, const Body<3>&);
template LawByRegion<AnisotropicDarcyLaw<2>> read_law<2>(const Section&, const Body<2>&,
                                                         const FlowInScene<2>&);
template LawByRegion<AnisotropicDarcyLaw<3>> read_law<3>(const Section&, const Body<3>&,
                                                         const FlowInScene<3>&);
template DarcySystem<2> make_equations<2>(const Section&, const std::shared_ptr<const Body<2>>&,
                                          const FlowInScene<2>&, const MirrorCondition<2, 1>&,
                                          Discretisation<2>);
template DarcySystem<3> make_equations<3>(const Section&, const std::shared_ptr<const Body<3>>&,
                                          const FlowInScene<3>&, const MirrorCondition<3, 1>&,
                                          Discretisation<3>);
template std::unique_ptr<PhysicsModule> make_flow_module<2>(const Section&,
                                                            std::shared_ptr<const Body<2>>,
                                                            DarcySystem<2>);
template std::unique_ptr<PhysicsModule> make_flow_module<3>(const Section&,
                                                            std::shared_ptr<const Body<3>>,
                                                            DarcySystem<3>);

}  // namespace perifrac
