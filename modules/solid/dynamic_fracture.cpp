#include "modules/solid/dynamic_fracture.hpp"

#include <cmath>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/solvers/complementarity.hpp"
#include "core/time/equal_steps.hpp"
#include "modules/solid/whole_solid.hpp"

namespace perifrac {

namespace {

/// Bonds let go while sound passes so many spacings: the more, the less a step of growth shakes the
/// body; the tip goes no faster than sound divided by it.
constexpr double spacings_of_release = 10.0;

double release_time(const Body<2>& body, const BreakableElasticity<2>& elastic, double density) {
  const IsotropicElasticity<2>& law = elastic.law(0);
  const double speed = std::sqrt((law.lame_lambda + 2.0 * law.shear_modulus) / density);
  return spacings_of_release * body.spacing() / speed;
}

}  // namespace

DynamicFracture::DynamicFracture(std::shared_ptr<const Body<2>> body,
                                 std::shared_ptr<Family<2>> family,
                                 std::shared_ptr<BreakableElasticity<2>> elastic,
                                 const SolidBoundary<2>& boundary, double density, double damping,
                                 double safety, std::optional<InitialStress<2>> initial_stress,
                                 std::vector<CrackFacet<2>> seeds,
                                 FractureEnergy<2> fracture_energy)
    : DynamicSolid<2>(body, elastic, boundary, density, damping, safety),
      damping_(damping),
      seeds_(seeds),
      bonds_(body->claim_bond_state()),
      cracks_(family, body->spacing(), elastic, bonds_, initial_stress, std::move(seeds),
              release_time(*body, *elastic, density)),
      tips_(*body, cracks_, std::move(fracture_energy)),
      fluid_(bonds_.facet_points()) {
  system_->set_fracture(cracks_);
  add_ports();
}

void DynamicFracture::add_ports() {
  const PointSet* const facets = &bonds_.facet_points();
  fluid_.add_ports(ports_);
  ports_.found({.name = "damage", .unit = "1", .negligible = negligible_strain}, body_->point_set(),
               [this](std::vector<double>& damage) {
                 damage.resize(body_->points().size());
                 find_damage(cracks_.family(), damage);
               });
  ports_.out({"crack_opening", "m"}, [this, facets] {
    return PortView{facets, view(cracks_.opening())};
  });
  ports_.out(
      {.name = "free_crack_opening", .unit = "m", .role = PortRole::property}, [this, facets] {
        return PortView{facets, view(cracks_.opening()), {}, cracks_.slope(), cracks_.forecast()};
      });
  ports_.total({"crack_length", "m"}, whole_solid, [this] {
    double length = 0.0;
    for (const FaceJump<2>& jump : cracks_.jumps()) length += jump.area;
    return length;
  });
  ports_.total(total_port("fracture_energy", "J", PortRole::energy_dissipated, 2), whole_solid,
               [this] { return cracks_.spent_energy(); });
}

double DynamicFracture::external_work() const {
  return DynamicSolid<2>::external_work() + cracks_.relief_work();
}

double DynamicFracture::damped_energy() const {
  return DynamicSolid<2>::damped_energy() + cracks_.contact_loss();
}

void DynamicFracture::initialize(double t) {
  DynamicSolid<2>::initialize(t);
  cracks_.start(*system_, t);
  tips_.start(seeds_, t);
}

void DynamicFracture::prepare(const TimeWindow& window) { foretell(window.begin, window.length()); }

void DynamicFracture::foretell(double t, double step) {
  if (motion_.acceleration.empty()) verlet_->evaluate(t, motion_);
  cracks_.foretell(step, std::exp(-0.5 * damping_ * step), motion_.velocity, motion_.acceleration);
}

double DynamicFracture::advance(const TimeWindow& window) {
  const std::int64_t steps = equal_steps(window.length(), verlet_->longest_step(window.begin));
  double begin = window.begin;
  for (std::int64_t n = 1; n <= steps; ++n) {
    const double part = static_cast<double>(n) / static_cast<double>(steps);
    const double end = n == steps ? window.end : window.begin + part * window.length();
    foretell(begin, end - begin);
    try {
      cracks_.press(fluid_.pressure());
    } catch (const NoContact& error) {
      throw NumericalError("crack_opening", "the faces of the cracks", end, error.what());
    }
    DynamicSolid<2>::advance({begin, end});
    begin = end;
  }
  return window.end;
}

double DynamicFracture::conclude(const TimeWindow& window) {
  if (!(window.length() > 0.0) || tips_.find_readiness(state_of_cracks()) < ready)
    return window.end;
  if (tips_.grow(state_of_cracks()) == 0.0) return window.end;
  system_->note_broken_bonds();
  cracks_.find_answers();
  verlet_->evaluate(time_, motion_);
  return window.end;
}

CrackState<2> DynamicFracture::state_of_cracks() {
  return crack_state<2>(
      time_, fluid_, cracks_.opening(), cracks_.pressure(), {}, {}, system_->acting_pore_stress(),
      [this](const UnknownNames&) -> std::span<const double> { return system_->unknowns(); },
      [this] { return cracks_.jumps_at(system_->unknowns()); },
      [this](Index i) { return inertia(i); }, cracks_.release());
}

/// What accelerates point i beside its bonds and loads [N/m].
Vector<2> DynamicFracture::inertia(Index i) {
  Vector<2> force{};
  for (int a = 0; a < 2; ++a) {
    const Index unknown = a * body_->points().size() + i;
    const Index moved = system_->moved_by(unknown);
    if (moved < 0) continue;
    force[a] = system_->mass()[moved] * motion_.acceleration[moved] + cracks_.face_force()[unknown];
  }
  return force;
}

void DynamicFracture::visit_state(StateVisitor& visitor) {
  DynamicSolid<2>::visit_state(visitor);
  cracks_.visit_state(visitor);
  tips_.visit_state(visitor);
}

void DynamicFracture::on_restored(double t) {
  DynamicSolid<2>::on_restored(t);
  cracks_.read_jumps();
}

}  // namespace perifrac
