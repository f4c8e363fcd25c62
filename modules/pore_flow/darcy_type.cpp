#include "modules/pore_flow/darcy_type.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/geometry/face_conditions.hpp"
#include "core/geometry/scatter.hpp"
#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/as_published/smoothed_euler.hpp"
#include "modules/pore_flow/boundary/pore_boundary.hpp"
#include "modules/pore_flow/boundary/pore_gravity.hpp"
#include "modules/pore_flow/darcy_cvode.hpp"
#include "modules/pore_flow/darcy_flow.hpp"
#include "modules/pore_flow/make_flow.hpp"
#include "modules/pore_flow/material/anisotropic_darcy_law.hpp"
#include "modules/pore_flow/material/mobility.hpp"
#include "modules/pore_flow/storage/storage_choice.hpp"

namespace perifrac {

namespace {

FlowScheme read_scheme(const Section& section) {
  const std::string word = section.word("operator");
  if (word == "bond") return FlowScheme::bond;
  return word == "nested" ? FlowScheme::nested : FlowScheme::conservative;
}

/// What the nested operator cannot do: it is neither symmetric nor does it know a natural boundary.
template <int D>
void check_nested(const Section& section, const Body<D>& body) {
  const bool implicit = section.word("integrator.type") == "cvode";
  if (implicit && section.word("integrator.linear_solver") == "direct") {
    section.fail("integrator.linear_solver", "operator 'nested' has no symmetric matrix to factor",
                 "krylov, or the explicit integrator");
  }
  const std::string smoothing = section.word("nested.smoothing");
  if (implicit && smoothing != "none") {
    section.fail("nested.smoothing", "smoothing follows the steps of the explicit integrator",
                 "none, or the explicit integrator");
  }
  for (const auto& [face, type, path] : read_face_conditions(section, body.faces(), {})) {
    if (type == "flux" && body.layer(face).empty()) {
      section.fail(path + ".type", "operator 'nested' takes no inflow at a face",
                   "sealed, pressure, or a bonded layer behind the face");
    }
  }
}

/// Nothing where the scene does not smooth.
template <int D>
std::optional<PressureSmoothing<D>> read_smoothing(const Section& section, const Body<D>& body,
                                                   std::shared_ptr<const Family<D>> family,
                                                   const MirrorCondition<D, 1>& mirror,
                                                   std::span<const HeldPoint> held) {
  const std::string where = section.word("nested.smoothing");
  if (section.word("operator") != "nested" || where == "none") return std::nullopt;
  std::vector<Index> points;
  if (where == "boundary") {
    points = points_near_faces(body);
  } else {
    points.resize(family->point_count);
    std::iota(points.begin(), points.end(), 0);
  }
  std::erase_if(
      points, [&](Index i) { return std::ranges::binary_search(held, i, {}, &HeldPoint::point); });
  return PressureSmoothing<D>(std::move(family), mirror, std::move(points));
}

template <int D>
DarcyIntegratorMaker<D> read_integrator(const Section& section) {
  if (section.word("integrator.type") == "explicit") {
    const double safety = section.number("integrator.safety");
    return [=](DarcySystem<D>& system) -> std::unique_ptr<Integrator> {
      if (!system.smooths()) return std::make_unique<ForwardEuler>(system, safety);
      return std::make_unique<SmoothedEuler>(
          system, safety, [&system](double t, std::span<double> y) { system.smooth(t, y); });
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
Discretisation<D> discretise(FlowScheme scheme, const Body<D>& body,
                             const PoreBoundary<D>& boundary, Law law) {
  const auto family = body.family(boundary.mirrored(), boundary.sealed_layers());
  LinearExactOperator<D, Law> op(family, boundary.mirror_condition(*family), std::move(law));
  Discretisation<D> made;
  if (boundary.has_sources()) made.sources = boundary.sources(op.transposed_gradient());
  made.flow = make_flow(scheme, std::move(op));
  return made;
}

/// A scalar mobility that is the same everywhere stays the simple law that it is.
template <int D>
Discretisation<D> discretise(const Section& section, const Body<D>& body,
                             const PoreBoundary<D>& boundary, const PoreFluid& fluid,
                             std::vector<std::uint8_t> region) {
  const std::vector<Tensor<D, D>> mobilities = read_mobilities<D>(section, fluid.viscosity);
  const FlowScheme scheme = read_scheme(section);
  if (scheme == FlowScheme::bond && std::ranges::any_of(mobilities, [](const auto& mobility) {
        return isotropic_part<D>(mobility) < 0.0;
      })) {
    section.fail("operator", "'bond' cannot carry a permeability tensor", "conservative or nested");
  }
  const double scalar = isotropic_part<D>(mobilities[0]);
  const auto scatter = read_scatter<D>(section, "permeability_scatter");
  if (fluid.is_linear() && mobilities.size() == 1 && scalar >= 0.0 && !scatter) {
    return discretise(scheme, body, boundary, DarcyLaw<D>{scalar});
  }
  LawByRegion<AnisotropicDarcyLaw<D>> law{.laws = {}, .law_of_point = std::move(region)};
  for (const Tensor<D, D>& mobility : mobilities) law.laws.push_back({mobility});
  if (scatter) {
    law = scattered(law, *scatter, body.points(),
                    [](const auto& rock, double factor) { return rock.times(factor); });
  }
  if (fluid.is_linear()) return discretise(scheme, body, boundary, std::move(law));
  std::vector<double> ones(law.law_of_point.size(), 1.0);
  return discretise(scheme, body, boundary, ScaledDarcyLaw<D>{std::move(law), std::move(ones)});
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

template <int D>
std::unique_ptr<PhysicsModule> make_darcy(const Section& section,
                                          std::shared_ptr<const Body<D>> body) {
  const FlowScheme scheme = read_scheme(section);
  if (scheme != FlowScheme::conservative && std::ranges::any_of(body->faces(), &Face::curved)) {
    section.fail("operator",
                 fmt::format("'{}' on a body with a curved face", section.word("operator")),
                 "conservative, or a body of shape box");
  }
  if (scheme == FlowScheme::nested) check_nested(section, *body);
  const PoreBoundary<D> boundary = read_pore_boundary<D>(section, *body);
  const PoreFluid fluid = read_pore_fluid(section);
  std::vector<std::uint8_t> region = region_of_points<D>(section, body->regions(), body->points());
  PoreMaterials materials{read_pore_materials(section, fluid), region};
  Discretisation<D> space = discretise<D>(section, *body, boundary, fluid, std::move(region));
  const Section scene = section.scene();
  if (space.flow->family().curved && (scene.has("damage") || scene.count("cracks") > 0)) {
    section.fail("boundary", "bonds that break beside a mirrored sphere",
                 "a sphere that it does not name");
  }
  auto storage = make_storage(section, *body, fluid, materials);
  const auto mirror = boundary.mirror_condition(space.flow->family());
  Eigen::VectorXd gravity;
  if (const Vector<D> g = read_gravity<D>(section); g != Vector<D>{}) {
    gravity = PoreGravity<D>(*body, g, fluid.density).values(mirror, boundary.pressure_layers());
  }
  const auto family = body->family(boundary.mirrored(), boundary.sealed_layers());
  const std::vector<HeldPoint> held = boundary.held_points(mirror);
  DarcySystem<D> system(std::move(space.flow), std::move(storage), fluid,
                        boundary.face_pressures(mirror), std::move(space.sources), gravity, held);
  system.let_storage_be_chosen(storage_choice(section, body, std::move(materials)));
  if (auto smoothing = read_smoothing(section, *body, family, mirror, held)) {
    system.set_smoothing(std::move(*smoothing));
  }
  return std::make_unique<DarcyFlow<D>>(body, std::move(system), read_initial_pressure<D>(section),
                                        read_integrator<D>(section));
}

KeyTable darcy_keys() {
  // Keys of one integrator may stand beside another, so that one word swaps them.
  KeyTable keys = {
      {.path = "operator",
       .type = KeyType::word,
       .fallback = "conservative",
       .words = {"conservative", "bond", "nested"},
       .meaning =
           "conservative: bond fluxes, equal and opposite; stable, fourth order inside. bond: "
           "one flux a bond, first order at no-flux surfaces. nested: the paper's divergence "
           "of velocities, unstable at cut surfaces, for comparison only."},
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
  keys.push_back({.path = "nested.smoothing",
                  .type = KeyType::word,
                  .fallback = "boundary",
                  .words = {"none", "boundary", "everywhere"},
                  .meaning =
                      "nested: points whose pressure is averaged over their neighbours after each "
                      "explicit step; boundary: within a horizon of a face."});
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
