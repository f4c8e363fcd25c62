#include "modules/solid/dynamic_solid.hpp"

namespace perifrac {

namespace {

const PointSet whole_body{.name = "solid"};

}  // namespace

template <int D>
DynamicSolid<D>::DynamicSolid(std::shared_ptr<const Body<D>> body,
                              std::shared_ptr<ElasticOperator<D>> elastic,
                              const SolidBoundary<D>& boundary, double density, double damping,
                              double safety, std::unique_ptr<CriticalStretch<D>> breaking)
    : body_(std::move(body)),
      breaking_(std::move(breaking)),
      system_(std::make_unique<ElasticDynamics<D>>(*body_, std::move(elastic), boundary, density)),
      verlet_(std::make_unique<VelocityVerlet>(*system_, damping, safety)) {
  if (breaking_) {
    breaking_->cut_seeds();
    system_->set_fracture(*breaking_);
  }
  const auto vector = [](const char* name, const char* unit) {
    return Port{name, unit, PortDirection::out, PortKind::intensive, PortRole::field, D};
  };
  const auto energy = [](const char* name, PortRole role) {
    return Port{name, unit_of_total("J", D), PortDirection::out, PortKind::extensive, role};
  };
  ports_ = {
      {"pore_stress", "Pa", PortDirection::in},
      InterfaceForce::port(D),
      vector("displacement", "m"),
      vector("velocity", "m/s"),
      {"dilatation", "1", PortDirection::out},
      {"effective_stress", "Pa", PortDirection::out, PortKind::intensive, PortRole::field, D * D},
      energy("elastic_energy", PortRole::energy_stored),
      energy("kinetic_energy", PortRole::energy_stored),
      energy("external_work", PortRole::energy_gained),
      energy("damped_energy", PortRole::energy_dissipated),
      {"integrator_steps", "1", PortDirection::out, PortKind::extensive, PortRole::work},
  };
  const auto mirror = boundary.mirror_condition(*body_->family(boundary.mirrored()));
  for (const auto& plate : boundary.plates(mirror)) {
    ports_.push_back({plate.face + "_plate_displacement", "m", PortDirection::out});
  }
  if (!breaking_) return;
  ports_.push_back({"damage", "1", PortDirection::out});
  ports_.push_back(energy("fracture_energy", PortRole::energy_dissipated));
}

template <int D>
PortId DynamicSolid<D>::first_of_breaking() const {
  return static_cast<PortId>(first_plate + system_->plate_unknowns().size());
}

template <int D>
PortView DynamicSolid<D>::breaking_port(PortId id) {
  if (id == first_of_breaking()) {
    damage_.resize(body_->points().size());
    breaking_->damage(damage_);
    return {&body_->point_set(), damage_};
  }
  fracture_energy_ = breaking_->released_energy();
  return {&whole_body, {&fracture_energy_, 1}};
}

template <int D>
std::span<const Port> DynamicSolid<D>::ports() const {
  return ports_;
}

template <int D>
PortView DynamicSolid<D>::port(PortId id) {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = body_->points().size();
  switch (id) {
    case pore_stress:
      return {points, pore_stress_, pore_stress_rate_, pore_stress_slope_};
    case interface_impulse:
      return {points, interface_.impulse()};
    case displacement:
      return {points, std::span(system_->unknowns()).first(D * count)};
    case velocity:
      velocity_.resize(D * count);
      system_->point_velocity(time_, verlet_->longest_step(time_), motion_.velocity, velocity_);
      return {points, velocity_};
    case dilatation:
      return {points, system_->dilatation()};
    case effective_stress:
      effective_stress_.resize(D * D * count);
      system_->effective_stress(effective_stress_);
      return {points, effective_stress_};
    default:
      if (id >= first_of_breaking()) return breaking_port(id);
      if (id >= first_plate) {
        const Index unknown = system_->plate_unknowns()[id - first_plate];
        return {&whole_body, {&system_->unknowns()[unknown], 1}};
      }
      double& value = scalars_[id - elastic_energy];
      value = scalar(id);
      return {&whole_body, {&value, 1}};
  }
}

template <int D>
double DynamicSolid<D>::scalar(PortId id) {
  switch (id) {
    case elastic_energy:
      return system_->elastic_energy();
    case kinetic_energy:
      return perifrac::kinetic_energy(system_->mass(), motion_.velocity);
    case external_work:
      return system_->external_work();
    case damped_energy:
      return motion_.damped_energy;
    default:
      return static_cast<double>(verlet_->steps());
  }
}

template <int D>
void DynamicSolid<D>::initialize(double t) {
  time_ = t;
  system_->start();
  const std::size_t size = system_->mass().size();
  motion_ = {std::vector<double>(size, 0.0), std::vector<double>(size, 0.0), {}};
}

template <int D>
void DynamicSolid<D>::connect(PortId in) {
  const std::size_t count = body_->points().size();
  if (in == pore_stress) {
    for (auto* input : {&pore_stress_, &pore_stress_rate_, &pore_stress_slope_}) {
      input->resize(count);
    }
  }
  if (in == interface_impulse) interface_.connect(D * count);
}

template <int D>
double DynamicSolid<D>::stable_time_step() const {
  return verlet_->longest_step(time_);
}

template <int D>
double DynamicSolid<D>::advance(const TimeWindow& window) {
  system_->set_pore_stress({pore_stress_, pore_stress_rate_, pore_stress_slope_, window.end});
  interface_.begin(window);
  if (interface_.is_linked()) system_->set_interface_force(interface_.force());
  // An input may jump where windows meet. The step before must end with the old one and this step
  // begin with the new: one force for both feeds energy into the fastest vibrations.
  const bool linked = !pore_stress_.empty() || interface_.is_linked();
  const bool jumps = linked || !(window.length() > 0.0);
  if (jumps || motion_.acceleration.empty()) verlet_->evaluate(window.begin, motion_);
  verlet_->advance(window.begin, window.end, motion_);
  time_ = window.end;
  return window.end;
}

template <int D>
void DynamicSolid<D>::visit_state(StateVisitor& visitor) {
  system_->visit_state(visitor);
  if (breaking_) breaking_->visit_state(visitor);
  interface_.visit_state(visitor);
  visitor.visit("velocity", motion_.velocity);
  visitor.visit("acceleration", motion_.acceleration);
  visitor.visit("damped_energy", motion_.damped_energy);
}

template <int D>
void DynamicSolid<D>::on_restored(double t) {
  time_ = t;
  motion_.position = system_->position();
  system_->set_interface_force(interface_.force());
  system_->note_reference();
  // The stable step is that of the body without broken bonds, which a restart begins with.
  if (system_->may_break()) verlet_->stable_step(t);
  system_->derive();
}

template class DynamicSolid<2>;
template class DynamicSolid<3>;

}  // namespace perifrac
