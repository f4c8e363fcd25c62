#include "modules/pore_flow/darcy_type.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/body/crack_seeds.hpp"
#include "core/geometry/face_conditions.hpp"
#include "modules/pore_flow/boundary/pore_boundary.hpp"
#include "modules/pore_flow/flow_in_scene.hpp"
#include "modules/pore_flow/make_flow.hpp"
#include "modules/pore_flow/material/anisotropic_darcy_law.hpp"
#include "modules/pore_flow/material/mobility.hpp"

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
                 "automatic or krylov, or the explicit integrator");
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
  std::vector<Index> points, held_points;
  if (where == "boundary") {
    points = points_near_surfaces(body);
  } else {
    points.resize(family->point_count);
    std::iota(points.begin(), points.end(), 0);
  }
  for (const HeldPoint& point : held) held_points.push_back(point.point);
  return PressureSmoothing<D>(std::move(family), mirror, std::move(points), held_points,
                              section.word("nested.compensation") == "neighbours");
}

template <int D, class Law>
Discretisation<D> discretise(FlowScheme scheme, const Body<D>& body,
                             const PoreBoundary<D>& boundary, Law law) {
  const auto family = body.family(boundary.mirrored(), boundary.sealed_layers());
  LinearExactOperator<D, Law> op(family, boundary.mirror_condition(*family), std::move(law));
  Discretisation<D> made;
  if (boundary.has_sources())
    made.sources =
        boundary.sources([&](const Eigen::VectorXd& flux) { return op.force_of_stress(flux); });
  made.flow = make_flow(scheme, std::move(op));
  return made;
}

/// A scalar mobility that is the same everywhere stays the simple law that it is.
template <int D>
Discretisation<D> discretise(const Section& section, const Body<D>& body,
                             const FlowInScene<D>& scene) {
  const auto& [boundary, fluid, materials, mobilities] = scene;
  const FlowScheme scheme = read_scheme(section);
  if (scheme == FlowScheme::bond && std::ranges::any_of(mobilities, [](const auto& mobility) {
        return isotropic_part<D>(mobility) < 0.0;
      })) {
    section.fail("operator", "'bond' cannot carry a permeability tensor", "conservative or nested");
  }
  auto law = read_law(section, body, scene);
  const double scalar = isotropic_part<D>(mobilities[0]);
  if (fluid.is_linear() && law.laws.size() == 1 && scalar >= 0.0) {
    return discretise(scheme, body, boundary, DarcyLaw<D>{scalar});
  }
  if (fluid.is_linear()) return discretise(scheme, body, boundary, std::move(law));
  std::vector<double> ones(law.law_of_point.size(), 1.0);
  return discretise(scheme, body, boundary, ScaledDarcyLaw<D>{std::move(law), std::move(ones)});
}

template <int D>
std::unique_ptr<PhysicsModule> make_darcy(const Section& section,
                                          std::shared_ptr<const Body<D>> body) {
  const FlowScheme scheme = read_scheme(section);
  if (scheme != FlowScheme::conservative && std::ranges::any_of(body->faces(), &Face::curved)) {
    section.fail("operator",
                 fmt::format("'{}' on a body with a curved face", section.word("operator")),
                 "conservative, or a body with plane faces");
  }
  if (scheme == FlowScheme::nested) check_nested(section, *body);
  const FlowInScene<D> scene = read_flow(section, *body);
  Discretisation<D> space = discretise<D>(section, *body, scene);
  const PoreBoundary<D>& boundary = scene.boundary;
  const auto family = body->family(boundary.mirrored(), boundary.sealed_layers());
  const auto is_sphere = [](const Face& face) { return face.curved() && !face.is_hole(); };
  if (std::ranges::any_of(body->faces(), is_sphere) && has_cracks(section.scene())) {
    section.fail("boundary", "bonds that break beside a mirrored sphere",
                 "a sphere that it does not name");
  }
  const auto mirror = boundary.mirror_condition(*family);
  DarcySystem<D> equations = make_equations(section, body, scene, mirror, std::move(space));
  if (auto smoothing = read_smoothing(section, *body, family, mirror, equations.held_points())) {
    equations.set_smoothing(std::move(*smoothing));
  }
  return make_flow_module(section, std::move(body), std::move(equations));
}

KeyTable darcy_keys() {
  KeyTable keys = darcy_operator_keys();
  const KeyTable shared = flow_keys();
  keys.insert(std::prev(keys.end()), shared.begin(), shared.end());
  return keys;
}

}  // namespace

KeyTable darcy_operator_keys() {
  return {
      {.path = "operator",
       .type = KeyType::word,
       .fallback = "conservative",
       .words = {"conservative", "bond", "nested"},
       .meaning =
           "conservative: bond fluxes, equal and opposite; stable, fourth order inside. bond: "
           "one flux a bond, first order at no-flux surfaces. nested: the paper's divergence "
           "of velocities, unstable at cut surfaces, for comparison only."},
      {.path = "nested.smoothing",
       .type = KeyType::word,
       .fallback = "boundary",
       .words = {"none", "boundary", "everywhere"},
       .meaning =
           "nested: points whose pressure is averaged over their neighbours after each "
           "explicit step; boundary: within a horizon of a face or a cutout, and the ends of "
           "broken bonds."},
      {.path = "nested.compensation",
       .type = KeyType::word,
       .fallback = "neighbours",
       .words = {"neighbours", "none"},
       .meaning = "Who gives what a smoothed point gains. neighbours: those of its mean, by their "
                  "weights in it. none: nobody; fluid is made and lost."},
  };
}

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
