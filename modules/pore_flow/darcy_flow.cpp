#include "modules/pore_flow/darcy_flow.hpp"

#include "core/state/compensated_sum.hpp"

namespace perifrac {

namespace {

const PointSet whole_body{.name = "pore_flow"};

}  // namespace

template <int D>
DarcyFlow<D>::DarcyFlow(std::shared_ptr<const Body<D>> body, DarcySystem<D> system,
                        InitialPressure<D> initial_pressure,
                        const DarcyIntegratorMaker<D>& make_integrator)
    : body_(std::move(body)),
      system_(std::make_unique<DarcySystem<D>>(std::move(system))),
      integrator_(make_integrator(*system_)),
      initial_pressure_(initial_pressure) {
  make_ports();
}

template <int D>
double DarcyFlow<D>::initial_pressure(Index i) const {
  const auto& [value, gradient, is_hydrostatic] = initial_pressure_;
  const PoreFluid& fluid = system_->fluid();
  if (is_hydrostatic) return fluid.pressure_of(fluid.potential(value) - system_->gravity(i));
  double sum = value;
  for (int a = 0; a < D; ++a) sum += gradient[a] * body_->points().position[a][i];
  return sum;
}

template <int D>
void DarcyFlow<D>::make_ports() {
  make_in_ports();
  make_field_ports();
  make_ledger_ports();
  make_work_ports();
  if (!system_->smooths()) return;
  ports_.total(total_port("artificial_fluid_mass", "kg", PortRole::mass_artificial, D), whole_body,
               [this] { return system_->fluid().density * system_->artificial_volume(unknowns_); });
}

template <int D>
void DarcyFlow<D>::make_in_ports() {
  const PointSet* const points = &body_->point_set();
  ports_.in(
      {"dilatation", "1"},
      [this] {
        for (auto* input : {&dilatation_, &dilatation_rate_, &dilatation_slope_}) {
          input->resize(system_->points());
        }
      },
      [this, points] {
        return PortView{points, dilatation_, dilatation_rate_, dilatation_slope_};
      });
  ports_.in(
      {.name = "exchanged_mass", .unit = unit_of_total("kg", D), .kind = PortKind::extensive},
      [this] {
        system_->exchange().connect(system_->points());
        find_pressure_slope();
      },
      [this, points] {
        return PortView{points, system_->exchange().mass()};
      });
}

template <int D>
void DarcyFlow<D>::make_field_ports() {
  const PointSet* const points = &body_->point_set();
  ports_.out({.name = "pore_pressure", .unit = "Pa", .negligible = negligible_pressure},
             [this, points] {
               return PortView{points, pressure_, {}, pressure_slope_};
             });
  ports_.out({.name = "pore_stress", .unit = "Pa", .negligible = negligible_pressure},
             [this, points] {
               if (!system_->storage().is_local()) return PortView{points, pore_stress_};
               return PortView{points, pore_stress_, {}, pore_stress_slope_};
             });
  ports_.out({"fluid_content", "1"}, [this, points] { return PortView{points, content()}; });
  ports_.found({.name = "darcy_velocity", .unit = "m/s", .components = D}, *points,
               [this](std::vector<double>& velocity) {
                 velocity.resize(D * system_->points());
                 system_->darcy_velocity(time_, pressure_, velocity);
               });
  ports_.found({.name = "pore_mobility", .unit = "m^2/(Pa s)", .role = PortRole::property}, *points,
               [this](std::vector<double>& values) {
                 if (values.empty()) values = mobility();
               });
}

template <int D>
void DarcyFlow<D>::make_ledger_ports() {
  const auto total = [this](const char* name, const char* unit, PortRole role,
                            std::function<double()> find) {
    ports_.total(total_port(name, unit, role, D), whole_body, std::move(find));
  };
  using enum PortRole;
  total("pore_fluid_mass", "kg", mass_stored, [this] {
    CompensatedSum volume;
    const std::span<const double> zeta = content();
    for (Index i = 0; i < system_->points(); ++i) volume.add(system_->volume()[i] * zeta[i]);
    return system_->fluid().density * volume.value();
  });
  total("pore_fluid_at_rest", "kg", mass_reference, [this] {
    CompensatedSum volume;
    for (Index i = 0; i < system_->points(); ++i) {
      volume.add(system_->volume()[i] * system_->storage().materials().at(i).porosity);
    }
    return system_->fluid().density * volume.value();
  });
  total("pore_fluid_gained", "kg", mass_gained, [this] {
    return system_->fluid().density * system_->gained_volume(start_, time_, unknowns_);
  });
  total("pore_fluid_energy", "J", energy_stored,
        [this] { return system_->stored_energy(content(), pressure_); });
  total("pore_fluid_work", "J", energy_gained,
        [this] { return system_->gained_energy(unknowns_) + system_->exchange().energy(); });
  total("darcy_dissipation", "J", energy_dissipated,
        [this] { return system_->dissipated_energy(unknowns_); });
}

template <int D>
void DarcyFlow<D>::make_work_ports() {
  const auto count = [this](const char* name, std::int64_t IntegratorStatistics::*of) {
    ports_.total(work_port(name), whole_body,
                 [this, of] { return static_cast<double>(integrator_->statistics().*of); });
  };
  count("integrator_steps", &IntegratorStatistics::steps);
  count("rhs_evaluations", &IntegratorStatistics::rhs_evaluations);
  count("newton_iterations", &IntegratorStatistics::newton_iterations);
  count("matrix_set_ups", &IntegratorStatistics::matrix_set_ups);
  count("linear_iterations", &IntegratorStatistics::linear_iterations);
}

template <int D>
void DarcyFlow<D>::initialize(double t) {
  follow_bonds();
  start_ = time_ = t;
  unknowns_.assign(system_->size(), 0.0);
  system_->start();
  pressure_.resize(system_->points());
  pore_stress_.resize(system_->points());
  pore_stress_slope_.resize(system_->points());
  for (Index i = 0; i < system_->points(); ++i) {
    pressure_[i] = initial_pressure(i);
    unknowns_[i] = system_->storage().content(i, pressure_[i]);
    pore_stress_slope_[i] = system_->storage().undrained_slope(i, unknowns_[i], pressure_[i]);
  }
  for (const HeldPoint& held : system_->held_points()) {
    pressure_[held.point] = system_->held_pressure(t, held);
    unknowns_[held.point] = system_->storage().content(held.point, pressure_[held.point]);
    pore_stress_slope_[held.point] = 0.0;
  }
  update_pore_stress();
  restart_integrator_ = true;
  note_jump(t);
}

template <int D>
void DarcyFlow<D>::note_jump(double t) {
  last_jump_ = t;
  integrator_->note_jump(t);
}

/// No history goes across bonds that break.
template <int D>
void DarcyFlow<D>::follow_bonds() {
  if (system_->follow(body_->bond_state())) restart_integrator_ = true;
}

template <int D>
double DarcyFlow<D>::stable_time_step() const {
  if (restart_integrator_) integrator_->reset(time_, unknowns_);
  return integrator_->longest_step();
}

template <int D>
std::string DarcyFlow<D>::path() const {
  const std::string loops = system_->path(), systems = integrator_->path();
  return systems.empty() ? loops : loops + "; " + systems;
}

template <int D>
void DarcyFlow<D>::prepare(const TimeWindow& window) {
  if (system_->choose_storage(dilatation_slope_)) restart_integrator_ = true;
  // Fluid may hold energy by the slope, which is asked for before any window too.
  system_->set_dilatation({dilatation_, dilatation_rate_, dilatation_slope_, window.begin});
}

template <int D>
double DarcyFlow<D>::advance(const TimeWindow& window) {
  follow_bonds();
  system_->set_dilatation({dilatation_, dilatation_rate_, dilatation_slope_, window.end});
  if (window.length() > 0.0) {
    integrate(window);
  } else {
    find_pressure(window.end);
  }
  // A window of no length changes pressures at once, which no history survives.
  restart_integrator_ = !(window.length() > 0.0);
  if (restart_integrator_) note_jump(window.end);
  time_ = window.end;
  update_content();
  update_pore_stress();
  find_pressure_slope();
  return window.end;
}

template <int D>
void DarcyFlow<D>::integrate(const TimeWindow& window) {
  if (restart_integrator_) system_->renew(unknowns_);
  MassExchange& exchange = system_->exchange();
  if (!exchange.is_linked()) {
    flow(window);
    return find_pressure(window.end);
  }
  const auto way =
      integrator_->is_multistep() ? MassExchange::Way::beside : MassExchange::Way::by_rate;
  exchange.begin(window, way, system_->volume(), system_->fluid().density);
  const double energy = system_->exchanged_energy(pressure_);  // at the potentials of its beginning
  flow(window);
  find_pressure(window.end);
  exchange.end(0.5 * (energy + system_->exchanged_energy(pressure_)));
}

template <int D>
void DarcyFlow<D>::find_pressure(double t) {
  system_->pressure(t, unknowns_, pressure_);
}

/// In parts between which schedules are smooth: no step, and no history, goes across a kink. What
/// changes between two kinks within a step jumps.
template <int D>
void DarcyFlow<D>::flow(const TimeWindow& window) {
  system_->lead_held_points(window, unknowns_);
  double begin = window.begin;
  const auto up_to = [&](double end) {
    if (restart_integrator_) integrator_->reset(begin, unknowns_);
    integrator_->advance(end, unknowns_);
    restart_integrator_ = false;
    begin = end;
  };
  const std::vector<double>& kinks = system_->break_points();
  for (std::size_t k = 0; k < kinks.size(); ++k) {
    const double kink = kinks[k];
    const double rounding = 1e-12 * kink;  // a kink where windows meet is no part of either
    if (kink < begin - rounding || kink >= window.end - rounding) continue;
    if (kink > begin + rounding) up_to(kink);
    if (restart_integrator_) integrator_->reset(begin, unknowns_);  // then it knows its step
    restart_integrator_ = true;
    const double step = integrator_->longest_step();
    const bool after = k > 0 && kink - kinks[k - 1] <= step;
    const bool ahead = k + 1 < kinks.size() && kinks[k + 1] - kink <= step;
    if (after || ahead) note_jump(kink);
  }
  up_to(window.end);
}

template <int D>
void DarcyFlow<D>::update_content() {
  if (!system_->exchange().is_beside()) return;
  const std::span<const double> zeta = system_->fluid_content(time_, unknowns_);
  content_.assign(zeta.begin(), zeta.end());
}

template <int D>
std::span<double> DarcyFlow<D>::content() {
  return content_.empty() ? std::span(unknowns_).first(system_->points()) : content_;
}

/// Nothing flows in or out of a sealed layer.
template <int D>
std::vector<double> DarcyFlow<D>::mobility() const {
  std::vector<double> values;
  for (Index i = 0; i < system_->points(); ++i) values.push_back(system_->flow().mobility(i));
  for (const auto& [i, face_value] : system_->held_points()) {
    if (face_value < 0) values[i] = 0.0;
  }
  return values;
}

/// While no fluid moves, and the rock answers as the dilatation's slope says; empty where nobody
/// hands over mass.
template <int D>
void DarcyFlow<D>::find_pressure_slope() {
  if (!system_->exchange().is_linked()) return;
  const PoreFluid& fluid = system_->fluid();
  const std::span<const double> storage = system_->effective_storage(time_, unknowns_);
  pressure_slope_.resize(system_->points());
  for (Index i = 0; i < system_->points(); ++i) {
    const double mass = fluid.density * system_->volume()[i];
    pressure_slope_[i] = fluid.density_ratio(pressure_[i]) / (storage[i] * mass);
  }
  for (const HeldPoint& held : system_->held_points()) pressure_slope_[held.point] = 0.0;
}

template <int D>
void DarcyFlow<D>::update_pore_stress() {
  const PoreStorage& storage = system_->storage();
  const std::span<const double> zeta = content();
  for (Index i = 0; i < system_->points(); ++i) {
    pore_stress_[i] = system_->biot_coefficient(i) * pressure_[i];
  }
  if (system_->fluid().is_linear()) return;
  for (Index i = 0; i < system_->points(); ++i) {
    pore_stress_slope_[i] = storage.undrained_slope(i, zeta[i], pressure_[i]);
  }
  for (const HeldPoint& held : system_->held_points()) pore_stress_slope_[held.point] = 0.0;
}

template <int D>
void DarcyFlow<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("fluid_content", unknowns_);
  visitor.visit("pore_pressure", pressure_);
  visitor.visit("start", start_);
  visitor.visit("last_jump", last_jump_);
  // Follows the slope of the dilatation, which a link has yet to bring after a restart.
  visitor.visit("pore_pressure_slope", pressure_slope_);
  system_->visit_state(visitor);
}

template <int D>
void DarcyFlow<D>::on_restored(double t) {
  follow_bonds();
  time_ = t;
  note_jump(last_jump_);
  restart_integrator_ = true;
  system_->exchange().on_restored();
  update_content();
  update_pore_stress();
}

template class DarcyFlow<2>;
template class DarcyFlow<3>;

}  // namespace perifrac
