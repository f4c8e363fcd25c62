#include "modules/solid/dynamic_solid.hpp"

#include "modules/solid/memory_ports.hpp"
#include "modules/solid/whole_solid.hpp"

namespace perifrac {

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
  make_ports(boundary);
}

template <int D>
void DynamicSolid<D>::make_ports(const SolidBoundary<D>& boundary) {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = body_->points().size();
  const auto energy = [this](const char* name, PortRole role, std::function<double()> find) {
    ports_.total(total_port(name, "J", role, D), whole_solid, std::move(find));
  };
  ports_.in(
      {"pore_stress", "Pa"},
      [this, count] {
        for (auto* input : {&pore_stress_, &pore_stress_rate_, &pore_stress_slope_})
          input->resize(count);
      },
      [this, points] {
        return PortView{points, pore_stress_, pore_stress_rate_, pore_stress_slope_};
      });
  ports_.in(
      InterfaceForce::port(D), [this] { connect_interface(); },
      [this, points] {
        return PortView{points, interface_.impulse()};
      });
  ports_.out({.name = "displacement", .unit = "m", .components = D}, [this, points, count] {
    return PortView{points, std::span(system_->unknowns()).first(D * count)};
  });
  ports_.found({.name = "velocity", .unit = "m/s", .components = D}, *points,
               [this, count](std::vector<double>& velocity) {
                 velocity.resize(D * count);
                 system_->point_velocity(time_, verlet_->longest_step(time_), motion_.velocity,
                                         velocity);
               });
  ports_.out({.name = "dilatation", .unit = "1", .negligible = negligible_strain}, [this, points] {
    return PortView{points, system_->dilatation()};
  });
  ports_.found({.name = "effective_stress", .unit = "Pa", .components = D * D}, *points,
               [this, count](std::vector<double>& stress) {
                 stress.resize(D * D * count);
                 system_->effective_stress(stress);
               });
  energy("elastic_energy", PortRole::energy_stored, [this] { return system_->elastic_energy(); });
  energy("kinetic_energy", PortRole::energy_stored,
         [this] { return kinetic_energy(system_->mass(), motion_.velocity); });
  energy("external_work", PortRole::energy_gained, [this] { return external_work(); });
  energy("damped_energy", PortRole::energy_dissipated, [this] { return damped_energy(); });
  if (auto* const rock = system_->remembers()) add_memory_ports(*rock, *points, D, ports_);
  ports_.total(work_port("integrator_steps"), whole_solid,
               [this] { return static_cast<double>(verlet_->steps()); });
  const auto mirror = boundary.mirror_condition(*body_->family(boundary.mirrored()));
  std::size_t plate = 0;
  for (const auto& [face, column] : boundary.plates(mirror)) {
    const Index unknown = system_->plate_unknowns()[plate++];
    ports_.total({face + "_plate_displacement", "m"}, whole_solid,
                 [this, unknown] { return system_->unknowns()[unknown]; });
  }
  if (!breaking_) return;
  ports_.found({.name = "damage", .unit = "1", .negligible = negligible_strain}, *points,
               [this, count](std::vector<double>& damage) {
                 damage.resize(count);
                 breaking_->damage(damage);
               });
  energy("fracture_energy", PortRole::energy_dissipated,
         [this] { return breaking_->released_energy(); });
}

template <int D>
void DynamicSolid<D>::connect_interface() {
  if (interface_.is_linked()) return;
  interface_.connect(D * body_->points().volume.size());
  system_->expect_interface_force();
}

template <int D>
void DynamicSolid<D>::initialize(double t) {
  time_ = t;
  system_->start();
  const std::size_t size = system_->mass().size();
  motion_ = {std::vector<double>(size, 0.0), std::vector<double>(size, 0.0), {}};
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
