#include "modules/pore_flow/darcy_type.hpp"

#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/anisotropic_darcy_law.hpp"
#include "modules/pore_flow/conservative_flow.hpp"
#include "modules/pore_flow/darcy_cvode.hpp"
#include "modules/pore_flow/darcy_flow.hpp"
#include "modules/pore_flow/linear_storage.hpp"
#include "modules/pore_flow/mobility.hpp"
#include "modules/pore_flow/pore_boundary.hpp"
#include "modules/pore_flow/pore_gravity.hpp"
#include "modules/pore_flow/tait_storage.hpp"

namespace perifrac {

namespace {

template <int D>
DarcyIntegratorMaker<D> read_integrator(const Section& section) {
  if (section.word("integrator.type") == "explicit") {
    const double safety = section.number("integrator.safety");
    return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
      return std::make_unique<ForwardEuler>(system, safety);
    };
  }
  using Method = typename DarcyNewtonMatrix<D>::Method;
  const Method method = section.word("integrator.linear_solver") == "direct"
                            ? Method::direct
                            : Method::preconditioner;
  const double tolerance = section.number("integrator.tolerance");
  return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
    return std::make_unique<DarcyCvode<D>>(system, method, tolerance);
  };
}

/// The flow in space, and the sources that its gradient spreads over the points near a face.
template <int D>
struct Discretisation {
  std::unique_ptr<FlowOperator<D>> flow;
  ScheduledVector sources{0};
};

template <int D, class Law>
Discretisation<D> conservative_flow(const Body<D>& body, const PoreBoundary<D>& boundary, Law law) {
  const auto family = body.family(boundary.mirrored());
  LinearExactOperator<D, Law> op(family, boundary.mirror_condition(*family), std::move(law));
  Discretisation<D> made;
  if (boundary.has_sources()) made.sources = boundary.sources(op.gradient_matrix());
  made.flow = std::make_unique<ConservativeFlow<D, Law>>(std::move(op));
  return made;
}

/// A scalar mobility that is the same everywhere stays the simple law that it is.
template <int D>
Discretisation<D> discretise(const Section& section, const Body<D>& body,
                             const PoreBoundary<D>& boundary, const PoreFluid& fluid,
                             std::vector<std::uint8_t> region) {
  const std::vector<Tensor<D, D>> mobilities = read_mobilities<D>(section, fluid.viscosity);
  const double scalar = isotropic_part<D>(mobilities[0]);
  if (fluid.is_linear() && mobilities.size() == 1 && scalar >= 0.0) {
    return conservative_flow<D>(body, boundary, DarcyLaw<D>{scalar});
  }
  LawByRegion<AnisotropicDarcyLaw<D>> law{.laws = {}, .law_of_point = std::move(region)};
  for (const Tensor<D, D>& mobility : mobilities) law.laws.push_back({mobility});
  if (fluid.is_linear()) return conservative_flow<D>(body, boundary, std::move(law));
  std::vector<double> ones(law.law_of_point.size(), 1.0);
  return conservative_flow<D>(body, boundary, ScaledDarcyLaw<D>{std::move(law), std::move(ones)});
}

template <int D>
std::unique_ptr<PhysicsModule> make_darcy(const Section& section,
                                          std::shared_ptr<const Body<D>> body) {
  const PoreBoundary<D> boundary = read_pore_boundary<D>(section, *body);
  const PoreFluid fluid = read_pore_fluid(section);
  std::vector<std::uint8_t> region = region_of_points<D>(section, body->regions(), body->points());
  PoreMaterials materials{read_pore_materials(section, fluid), region};
  Discretisation<D> space = discretise<D>(section, *body, boundary, fluid, std::move(region));
  std::unique_ptr<PoreStorage> storage;
  if (fluid.is_linear()) {
    storage = std::make_unique<LinearStorage>(std::move(materials));
  } else {
    storage = std::make_unique<TaitStorage>(std::move(materials), fluid);
  }
  const auto mirror = boundary.mirror_condition(space.flow->family());
  Eigen::VectorXd gravity;
  if (const Vector<D> g = read_gravity<D>(section); g != Vector<D>{}) {
    gravity = PoreGravity<D>(*body, g, fluid.density).values(mirror);
  }
  DarcySystem<D> system(std::move(space.flow), std::move(storage), fluid,
                        boundary.face_pressures(mirror), std::move(space.sources), gravity);
  const auto initial_state = section.word("initial_state") == "hydrostatic"
                                 ? InitialState::hydrostatic
                                 : InitialState::uniform;
  return std::make_unique<DarcyFlow<D>>(body, std::move(system), section.number("initial_pressure"),
                                        read_integrator<D>(section), initial_state);
}

KeyTable darcy_keys() {
  // Keys of one integrator may stand beside another, so that one word swaps them.
  KeyTable keys = {
      {.path = "operator",
       .type = KeyType::word,
       .fallback = "conservative",
       .words = {"conservative"},
       .meaning = "conservative: bond fluxes, equal and opposite; stable, fourth order inside."},
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
       .fallback = "direct",
       .words = {"direct", "krylov"},
       .meaning = "cvode: factor the flow, or iterate with GMRES, preconditioned by the bonds."},
      {.path = "integrator.tolerance",
       .range = "(0, 0.1]",
       .fallback = "1e-5",
       .meaning = "cvode: largest error of a step over the largest pressure."},
      {.path = "initial_pressure",
       .unit = "Pa",
       .fallback = "0 Pa",
       .meaning = "Pore pressure at the start, if hydrostatic at the highest corner of the body."},
      {.path = "initial_state",
       .type = KeyType::word,
       .fallback = "uniform",
       .words = {"uniform", "hydrostatic"},
       .meaning = "hydrostatic: the pressure grows downwards by the fluid's weight."},
  };
  for (const KeyTable& part :
       {permeability_keys(), pore_material_keys(), pore_fluid_keys(), pore_boundary_keys()}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

}  // namespace

ModuleType darcy_type() {
  return {.section = "pore_flow",
          .name = "darcy",
          .meaning = "Pore flow after Darcy, with fluid content as its state.",
          .keys = darcy_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_darcy(section, body); }, any);
          }};
}

}  // namespace perifrac
