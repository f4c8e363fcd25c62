#include "modules/pore_flow/darcy_flow.hpp"

#include <numeric>

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
        {"pore_pressure", "Pa", PortDirection::out},
        {"pore_stress", "Pa", PortDirection::out},
        {"fluid_content", "1", PortDirection::out},
        {"darcy_velocity", "m/s", PortDirection::out, PortKind::intensive, PortRole::field, d},
        total("pore_fluid_mass", "kg", PortRole::mass_stored),
        total("pore_fluid_gained", "kg", PortRole::mass_gained),
        total("pore_fluid_energy", "J", PortRole::energy_stored),
        total("pore_fluid_work", "J", PortRole::energy_gained),
        total("darcy_dissipation", "J", PortRole::energy_dissipated),
        count("integrator_steps"),
        count("rhs_evaluations"),
        count("newton_iterations"),
        count("matrix_set_ups"),
        count("linear_iterations"),
    };
  };
  static const std::vector<Port> in_2d = make(2), in_3d = make(3);
  return dimension == 2 ? in_2d : in_3d;
}

const PointSet whole_body{.name = "pore_flow"};

}  // namespace

template <int D>
DarcyFlow<D>::DarcyFlow(std::shared_ptr<const Body<D>> body, DarcySystem<D> system,
                        double initial_pressure, const DarcyIntegratorMaker<D>& make_integrator)
    : body_(std::move(body)),
      system_(std::make_unique<DarcySystem<D>>(std::move(system))),
      integrator_(make_integrator(*system_)),
      initial_pressure_(initial_pressure) {}

template <int D>
std::span<const Port> DarcyFlow<D>::ports() const {
  return darcy_ports(D);
}

template <int D>
PortView DarcyFlow<D>::port(PortId id) {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = system_->points();
  switch (id) {
    case dilatation:
      dilatation_.resize(count);
      dilatation_rate_.resize(count);
      dilatation_slope_.resize(count);
      return {points, dilatation_, dilatation_rate_, dilatation_slope_};
    case pore_pressure:
      return {points, pressure_};
    case pore_stress:
      return {points, pore_stress_, {}, pore_stress_slope_};
    case fluid_content:
      return {points, std::span(unknowns_).first(count)};
    case darcy_velocity:
      velocity_.resize(D * count);
      system_->darcy_velocity(pressure_, velocity_);
      return {points, velocity_};
    default: {
      double& value = scalars_[id - mass_stored];
      value = id < integrator_steps ? scalar(id) : work(id);
      return {&whole_body, {&value, 1}};
    }
  }
}

template <int D>
void DarcyFlow<D>::initialize(double t) {
  const PoreMaterial& material = system_->material();
  const double alpha = material.biot_coefficient;
  start_ = time_ = t;
  unknowns_.assign(system_->size(), 0.0);
  std::fill_n(unknowns_.begin(), system_->points(), material.storage * initial_pressure_);
  pressure_.assign(system_->points(), initial_pressure_);
  pore_stress_.assign(system_->points(), alpha * initial_pressure_);
  pore_stress_slope_.assign(system_->points(), -alpha * alpha / material.storage);
  restart_integrator_ = true;
}

template <int D>
double DarcyFlow<D>::stable_time_step() const {
  if (restart_integrator_) integrator_->reset(time_, unknowns_);
  return integrator_->longest_step();
}

template <int D>
double DarcyFlow<D>::advance(const TimeWindow& window) {
  system_->set_dilatation({dilatation_, dilatation_rate_, dilatation_slope_, window.end});
  if (window.length() > 0.0) {
    if (restart_integrator_) integrator_->reset(window.begin, unknowns_);
    integrator_->advance(window.end, unknowns_);
  }
  // A window of no length changes pressures at once, which no history survives.
  restart_integrator_ = !(window.length() > 0.0);
  time_ = window.end;
  update_pressure();
  return window.end;
}

template <int D>
void DarcyFlow<D>::update_pressure() {
  system_->pressure(time_, unknowns_, pressure_);
  const double alpha = system_->material().biot_coefficient;
  for (std::size_t i = 0; i < pressure_.size(); ++i) pore_stress_[i] = alpha * pressure_[i];
}

template <int D>
double DarcyFlow<D>::scalar(PortId id) const {
  const std::size_t points = system_->points();
  const std::vector<double>& volume = system_->volume();
  const Eigen::VectorXd& face_pressures = system_->face_pressures();
  const double* const accumulated = unknowns_.data() + points;  // by faces, dissipated, by sources
  const std::size_t faces = face_pressures.size();
  double sum = 0.0;
  switch (id) {
    case mass_stored:
      for (std::size_t i = 0; i < points; ++i) sum += volume[i] * unknowns_[i];
      return system_->material().fluid_density * sum;
    case mass_gained:
      sum = std::accumulate(accumulated, accumulated + faces, 0.0);
      if (system_->sources().size() > 0) sum += (time_ - start_) * system_->sources().sum();
      return system_->material().fluid_density * sum;
    case energy_stored:
      for (std::size_t i = 0; i < points; ++i) sum += volume[i] * pressure_[i] * pressure_[i];
      return 0.5 * system_->material().storage * sum;
    case energy_gained:
      for (std::size_t f = 0; f < faces; ++f) sum += face_pressures[f] * accumulated[f];
      return system_->sources().size() > 0 ? sum + accumulated[faces + 1] : sum;
    default:
      return accumulated[faces];
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
}

template <int D>
void DarcyFlow<D>::on_restored(double t) {
  time_ = t;
  restart_integrator_ = true;
  const double alpha = system_->material().biot_coefficient;
  for (std::size_t i = 0; i < pressure_.size(); ++i) pore_stress_[i] = alpha * pressure_[i];
}

template class DarcyFlow<2>;
template class DarcyFlow<3>;

}  // namespace perifrac
