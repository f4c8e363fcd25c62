#include "modules/solid/dynamic_fracture.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/solvers/complementarity.hpp"
#include "core/time/equal_steps.hpp"

namespace perifrac {

namespace {

const PointSet whole_body{.name = "solid"};

/// Bonds let go while sound passes so many spacings: the more, the less a step of growth shakes the
/// body; the tip goes no faster than sound divided by it.
constexpr double spacings_of_release = 10.0;

double release_time(const Body<2>& body, const BreakableElasticity<2>& elastic, double density) {
  const IsotropicElasticity<2>& law = elastic.law(0);
  const double speed = std::sqrt((law.lame_lambda + 2.0 * law.shear_modulus) / density);
  return spacings_of_release * body.spacing() / speed;
}

std::span<double> view(Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

enum CrackPort : PortId {
  crack_pressure,
  crack_viscosity,
  crack_leak_off,
  damage,
  crack_opening,
  free_crack_opening,
  crack_length,
  fracture_energy
};

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
      first_port_(static_cast<PortId>(ports_.size())) {
  system_->set_fracture(cracks_);
  using enum PortDirection;
  for (const Port& port : std::initializer_list<Port>{
           {"crack_pressure", "Pa", in},
           {"crack_viscosity", "Pa s", in, PortKind::intensive, PortRole::property},
           {"crack_leak_off", "m/s^0.5", in, PortKind::intensive, PortRole::property},
           {"damage", "1", out},
           {"crack_opening", "m", out},
           {"free_crack_opening", "m", out, PortKind::intensive, PortRole::property},
           {"crack_length", "m", out},
           {"fracture_energy", "J/m", out, PortKind::extensive, PortRole::energy_dissipated}}) {
    ports_.push_back(port);
  }
}

void DynamicFracture::connect(PortId in) {
  if (in < first_port_) return DynamicSolid<2>::connect(in);
  connected_.set(in - first_port_);
}

/// An input on facets, to which cracks that grow have added.
std::span<double> DynamicFracture::of_facets(PortId in, std::vector<double>& values) {
  if (connected_[in - first_port_]) values.resize(bonds_.facet_points().count);
  return values;
}

PortView DynamicFracture::port(PortId id) {
  const PointSet* const facets = &bonds_.facet_points();
  switch (id - first_port_) {
    case crack_pressure:
      return {facets, of_facets(id, crack_pressure_)};
    case crack_viscosity:
      return {facets, of_facets(id, crack_viscosity_)};
    case crack_leak_off:
      return {facets, of_facets(id, crack_leak_off_)};
    case damage:
      damage_.resize(body_->points().size());
      find_damage(cracks_.family(), damage_);
      return {&body_->point_set(), damage_};
    case crack_opening:
      return {facets, view(cracks_.opening())};
    case free_crack_opening:
      return {facets, view(cracks_.opening()), {}, cracks_.slope(), cracks_.forecast()};
    case crack_length:
      crack_length_ = 0.0;
      for (const FaceJump<2>& jump : cracks_.jumps()) crack_length_ += jump.area;
      return {&whole_body, {&crack_length_, 1}};
    case fracture_energy:
      fracture_energy_ = cracks_.spent_energy();
      return {&whole_body, {&fracture_energy_, 1}};
    default:
      return DynamicSolid<2>::port(id);
  }
}

double DynamicFracture::scalar(PortId id) {
  const double own = DynamicSolid<2>::scalar(id);
  if (id == external_work) return own + cracks_.relief_work();
  if (id == damped_energy) return own + cracks_.contact_loss();
  return own;
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
  crack_pressure_.resize(bonds_.facet_points().count, 0.0);
  const std::int64_t steps = equal_steps(window.length(), verlet_->longest_step(window.begin));
  double begin = window.begin;
  for (std::int64_t n = 1; n <= steps; ++n) {
    const double part = static_cast<double>(n) / static_cast<double>(steps);
    const double end = n == steps ? window.end : window.begin + part * window.length();
    foretell(begin, end - begin);
    try {
      cracks_.press(crack_pressure_);
    } catch (const NoContact& error) {
      throw NumericalError("crack_opening", "the faces of the cracks", end, error.what());
    }
    DynamicSolid<2>::advance({begin, end});
    begin = end;
  }
  return window.end;
}

double DynamicFracture::conclude(const TimeWindow& window) {
  if (!(window.length() > 0.0) || tips_.find_readiness(crack_state()) < ready) return window.end;
  if (tips_.grow(crack_state()) == 0.0) return window.end;
  system_->note_broken_bonds();
  cracks_.find_answers();
  verlet_->evaluate(time_, motion_);
  return window.end;
}

CrackState<2> DynamicFracture::crack_state() {
  const std::span<const double> on_faces = cracks_.face_force();
  return {.t = time_,
          .opening = cracks_.opening(),
          .pressure = cracks_.pressure(),
          .viscosity = crack_viscosity_,
          .leak_off = crack_leak_off_,
          .pore_stress = system_->acting_pore_stress(),
          .unknowns = [this](const UnknownNames&) -> std::span<const double> {
            return system_->unknowns();
          },
          .jumps = [this] { return cracks_.jumps_at(system_->unknowns()); },
          .inertia =
              [this, on_faces](Index i) {
                Vector<2> force{};
                for (int a = 0; a < 2; ++a) {
                  const Index unknown = a * body_->points().size() + i;
                  const Index moved = system_->moved_by(unknown);
                  if (moved < 0) continue;
                  force[a] =
                      system_->mass()[moved] * motion_.acceleration[moved] + on_faces[unknown];
                }
                return force;
              },
          .pause = cracks_.release()};
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
