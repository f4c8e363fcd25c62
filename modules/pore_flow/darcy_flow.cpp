#include "modules/pore_flow/darcy_flow.hpp"

#include "core/state/compensated_sum.hpp"

namespace perifrac {

namespace {

const std::vector<Port>& darcy_ports(int dimension) {
  static const auto make = [](int d) -> std::vector<Port> {
    const auto total = [d](const char* name, const char* unit, PortRole role) {
      return Port{name, unit_of_total(unit, d), PortDirection::out, PortKind::extensive, role};
    };
    const auto count = [](const char* name) {
      return Port{name, "1", PortDirection::out, PortKind::extensive, PortRole::work};
    };
    return {
        {"dilatation", "1", PortDirection::in},
        {"exchanged_mass", unit_of_total("kg", d), PortDirection::in, PortKind::extensive},
        {"pore_pressure", "Pa", PortDirection::out},
        {"pore_stress", "Pa", PortDirection::out},
        {"fluid_content", "1", PortDirection::out},
        {"darcy_velocity", "m/s", PortDirection::out, PortKind::intensive, PortRole::field, d},
        {"pore_mobility", "m^2/(Pa s)", PortDirection::out, PortKind::intensive,
         PortRole::property},
        total("pore_fluid_mass", "kg", PortRole::mass_stored),
        total("pore_fluid_at_rest", "kg", PortRole::mass_reference),
        total("pore_fluid_gained", "kg", PortRole::mass_gained),
        total("pore_fluid_energy", "J", PortRole::energy_stored),
        total("pore_fluid_work", "J", PortRole::energy_gained),
        total("darcy_dissipation", "J", PortRole::energy_dissipated),
        count("integrator_steps"),
        count("rhs_evaluations"),
        count("newton_iterations"),
        count("matrix_set_ups"),
        count("linear_iterations"),
        total("artificial_fluid_mass", "kg", PortRole::mass_artificial),
    };
  };
  static const std::vector<Port> in_2d = make(2), in_3d = make(3);
  return dimension == 2 ? in_2d : in_3d;
}

const PointSet whole_body{.name = "pore_flow"};

}  // namespace

template <int D>
DarcyFlow<D>::DarcyFlow(std::shared_ptr<const Body<D>> body, DarcySystem<D> system,
                        InitialPressure<D> initial_pressure,
                        const DarcyIntegratorMaker<D>& make_integrator)
    : body_(std::move(body)),
      system_(std::make_unique<DarcySystem<D>>(std::move(system))),
      integrator_(make_integrator(*system_)),
      initial_pressure_(initial_pressure) {}

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
std::span<const Port> DarcyFlow<D>::ports() const {
  return std::span(darcy_ports(D)).first(system_->smooths() ? port_count : artificial_mass);
}

template <int D>
PortView DarcyFlow<D>::port(PortId id) {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = system_->points();
  switch (id) {
    case dilatation:
      return {points, dilatation_, dilatation_rate_, dilatation_slope_};
    case exchanged_mass:
      return {points, system_->exchange().mass()};
    case pore_pressure:
      return {points, pressure_, {}, pressure_slope_};
    case pore_stress:
      if (!system_->storage().is_local()) return {points, pore_stress_};
      return {points, pore_stress_, {}, pore_stress_slope_};
    case fluid_content:
      return {points, content()};
    case darcy_velocity:
      velocity_.resize(D * count);
      system_->darcy_velocity(time_, pressure_, velocity_);
      return {points, velocity_};
    case pore_mobility:
      if (mobility_.empty()) find_mobility();
      return {points, mobility_};
    default: {
      double& value = scalars_[id - mass_stored];
      value = id < integrator_steps || id == artificial_mass ? scalar(id) : work(id);
      return {&whole_body, {&value, 1}};
    }
  }
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
void DarcyFlow<D>::connect(PortId in) {
  if (in == dilatation) {
    for (auto* input : {&dilatation_, &dilatation_rate_, &dilatation_slope_}) {
      input->resize(system_->points());
    }
  }
  if (in == exchanged_mass) {
    system_->exchange().connect(system_->points());
    find_pressure_slope();
  }
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
void DarcyFlow<D>::prepare(const TimeWindow& window) {
  if (system_->choose_storage(dilatation_slope_)) restart_integrator_ = true;
  // Fluid may hold energy by the slope, which is asked for before any window too.
  system_->set_dilatation({dilatation_, dilatation_rate_, dilatation_slope_, window.begin});
}

template <int D>
double DarcyFlow<D>::advance(const TimeWindow& window) {
  follow_bonds();
  system_->set_dilatation({dilatation_, dilatation_rate_, dilatation_slope_, window.end});
  if (window.length() > 0.0) integrate(window);
  // A window of no length changes pressures at once, which no history survives.
  restart_integrator_ = !(window.length() > 0.0);
  if (restart_integrator_) note_jump(window.end);
  time_ = window.end;
  update_content();
  system_->pressure(time_, unknowns_, pressure_);
  update_pore_stress();
  find_pressure_slope();
  return window.end;
}

template <int D>
void DarcyFlow<D>::integrate(const TimeWindow& window) {
  if (restart_integrator_) system_->renew(unknowns_);
  MassExchange& exchange = system_->exchange();
  if (!exchange.is_linked()) return flow(window);
  const auto way =
      integrator_->is_multistep() ? MassExchange::Way::beside : MassExchange::Way::by_rate;
  exchange.begin(window, way, system_->volume(), system_->fluid().density);
  double energy = 0.5 * system_->exchanged_energy(window.begin, unknowns_);
  flow(window);
  energy += 0.5 * system_->exchanged_energy(window.end, unknowns_);
  exchange.end(energy);
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
void DarcyFlow<D>::find_mobility() {
  for (Index i = 0; i < system_->points(); ++i) mobility_.push_back(system_->flow().mobility(i));
  for (const auto& [i, face_value] : system_->held_points()) {
    if (face_value < 0) mobility_[i] = 0.0;
  }
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
double DarcyFlow<D>::scalar(PortId id) {
  const double density = system_->fluid().density;
  const std::vector<double>& volume = system_->volume();
  const std::span<const double> zeta = content();
  CompensatedSum sum;
  switch (id) {
    case mass_stored:
      for (Index i = 0; i < system_->points(); ++i) sum.add(volume[i] * zeta[i]);
      return density * sum.value();
    case mass_reference:
      for (Index i = 0; i < system_->points(); ++i) {
        sum.add(volume[i] * system_->storage().materials().at(i).porosity);
      }
      return density * sum.value();
    case mass_gained:
      return density * system_->gained_volume(start_, time_, unknowns_);
    case energy_stored:
      return system_->stored_energy(zeta, pressure_);
    case energy_gained:
      return system_->gained_energy(unknowns_) + system_->exchange().energy();
    case artificial_mass:
      return density * system_->artificial_volume(unknowns_);
    default:
      return system_->dissipated_energy(unknowns_);
  }
}

template <int D>
double DarcyFlow<D>::work(PortId id) const {
  const IntegratorStatistics done = integrator_->statistics();
  switch (id) {
    case integrator_steps:
      return static_cast<double>(done.steps);
    case rhs_evaluations:
      return static_cast<double>(done.rhs_evaluations);
    case newton_iterations:
      return static_cast<double>(done.newton_iterations);
    case matrix_set_ups:
      return static_cast<double>(done.matrix_set_ups);
    default:
      return static_cast<double>(done.linear_iterations);
  }
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
