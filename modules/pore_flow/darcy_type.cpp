#include "modules/pore_flow/darcy_type.hpp"

#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/conservative_flow.hpp"
#include "modules/pore_flow/darcy_cvode.hpp"
#include "modules/pore_flow/darcy_flow.hpp"
#include "modules/pore_flow/pore_boundary.hpp"
#include "modules/pore_flow/pore_material.hpp"

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

template <int D>
std::unique_ptr<PhysicsModule> make_darcy(const Section& section,
                                          std::shared_ptr<const Body<D>> body) {
  const PoreBoundary<D> boundary = read_pore_boundary<D>(section, *body);
  const PoreMaterial material = read_pore_material(section);
  const auto family = body->family(boundary.mirrored());
  const auto mirror = boundary.mirror_condition(*family);
  LinearExactOperator<D, DarcyLaw<D>> op(family, mirror, DarcyLaw<D>{material.mobility});
  Eigen::VectorXd sources;
  if (boundary.has_sources()) sources = boundary.sources(op.gradient_matrix());
  DarcySystem<D> system(std::make_unique<ConservativeFlow<D, DarcyLaw<D>>>(std::move(op)), material,
                        boundary.face_pressures(mirror), sources);
  return std::make_unique<DarcyFlow<D>>(body, std::move(system), section.number("initial_pressure"),
                                        read_integrator<D>(section));
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
       .meaning = "Uniform pore pressure at the start."},
  };
  for (const KeyTable& part : {pore_material_keys(), pore_boundary_keys()}) {
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
