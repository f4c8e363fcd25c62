#include "modules/fluid/semi_lagrangian_fluid.hpp"

#include "core/time/equal_steps.hpp"

namespace perifrac {

namespace {

const PointSet whole_fluid{.name = "fluid_total"};

}  // namespace

template <int D>
SemiLagrangianFluid<D>::SemiLagrangianFluid(std::shared_ptr<const Body<D>> body, bool exchanges,
                                            std::unique_ptr<FluidDynamics<D>> dynamics)
    : body_(std::move(body)), dynamics_(std::move(dynamics)) {
  using enum PortDirection;
  using enum PortKind;
  const auto total = [](const char* unit) { return unit_of_total(unit, D); };
  add_port(Quantity::pressure, {"fluid_pressure", "Pa", out});
  add_port(Quantity::velocity, {"fluid_velocity", "m/s", out, intensive, PortRole::field, D});
  add_port(Quantity::density, {"fluid_density", "kg/m^3", out});
  add_port(Quantity::mass, {"fluid_mass", total("kg"), out, extensive});
  add_port(Quantity::free_mass,
           {"free_fluid_mass", total("kg"), out, extensive, PortRole::mass_stored});
  const FluidOpenings<D>& openings = dynamics_->openings();
  if (openings.inlets) {
    add_port(Quantity::injected_mass,
             {"injected_fluid_mass", total("kg"), out, extensive, PortRole::mass_gained});
  }
  if (openings.may_lose()) {
    add_port(Quantity::removed_mass,
             {"removed_fluid_mass", total("kg"), out, extensive, PortRole::mass_gained});
  }
  if (openings.domain.may_lose()) {
    add_port(Quantity::points_left, {"points_left", "1", out, extensive, PortRole::work});
  }
  add_port(Quantity::steps, {"integrator_steps", "1", out, extensive, PortRole::work});
  add_port(Quantity::searches, {"neighbour_searches", "1", out, extensive, PortRole::work});
  if (body_) {
    add_port(Quantity::displacement, {"displacement", "m", in, intensive, PortRole::field, D});
    add_port(Quantity::interface_impulse,
             {"interface_impulse", total("N s"), out, extensive, PortRole::field, D});
  }
  if (dynamics_->enters_damaged_walls()) add_port(Quantity::damage, {"damage", "1", in});
  if (exchanges) {
    add_port(Quantity::pore_pressure, {"pore_pressure", "Pa", in});
    add_port(Quantity::pore_mobility, {"pore_mobility", "m^2/(Pa s)", in});
    add_port(Quantity::exchanged_mass, {"exchanged_mass", total("kg"), out, extensive});
    if (!dynamics_->exchange_keeps_mass()) {
      add_port(Quantity::made_mass,
               {"mass_made_by_exchange", total("kg"), out, extensive, PortRole::mass_artificial});
    }
    add_port(Quantity::merged, {"merged_points", "1", out, extensive, PortRole::work});
    // Where nobody writes them, the pores are empty and closed.
    for (auto* input :
         {&pore_pressure_, &pore_pressure_rate_, &pore_pressure_slope_, &pore_mobility_}) {
      input->resize(body_->points().size());
    }
  }
  if (openings.mouths) {
    using enum PortRole;
    add_port(Quantity::mouth_pressure, {"mouth_pressure", "Pa", out, intensive, property});
    add_port(Quantity::mouth_stiffness,
             {"mouth_stiffness", D == 2 ? "Pa m/kg" : "Pa/kg", out, intensive, property});
    add_port(Quantity::mouth_intake, {"mouth_intake", total("kg"), in, extensive, property});
    add_port(Quantity::given_mass,
             {"mass_given_to_cracks", total("kg"), out, extensive, mass_stored});
  }
  for (const RigidWall<D>& wall : dynamics_->rigid_walls()) {
    if (wall.motion != RigidWall<D>::Motion::piston) continue;
    add_port(Quantity::piston,
             {wall.name + "_displacement", "m", out, intensive, PortRole::field, D});
  }
  scalars_.resize(ports_.size() * D);
  point_set_ = {.name = "fluid", .dimension = D};
}

template <int D>
void SemiLagrangianFluid<D>::add_port(Quantity quantity, Port port) {
  quantities_.push_back(quantity);
  ports_.push_back(std::move(port));
}

template <int D>
const PointSet& SemiLagrangianFluid<D>::moving_points() {
  const FluidPoints<D>& points = dynamics_->points();
  point_set_.version = dynamics_->version() + restored_;
  point_set_.count = points.count;
  for (int a = 0; a < D; ++a) {
    point_set_.position[a] = std::span(points.position[a]).first(points.count);
  }
  return point_set_;
}

template <int D>
std::vector<double>& SemiLagrangianFluid<D>::field(Quantity quantity) {
  const FluidPoints<D>& points = dynamics_->points();
  const auto first = [&](const std::vector<double>& values) {
    return std::span(values).first(points.count);
  };
  switch (quantity) {
    case Quantity::pressure:
      pressure_.resize(points.count);
      for (Index i = 0; i < points.count; ++i) {
        pressure_[i] = dynamics_->fluid().pressure(points.density[i]);
      }
      return pressure_;
    case Quantity::velocity:
      velocity_.clear();
      for (int a = 0; a < D; ++a) {
        const auto values = first(points.velocity[a]);
        velocity_.insert(velocity_.end(), values.begin(), values.end());
      }
      return velocity_;
    case Quantity::density: {
      const auto values = first(points.density);
      density_.assign(values.begin(), values.end());
      return density_;
    }
    default:
      mass_ = points.mass;
      return mass_;
  }
}

template <int D>
double SemiLagrangianFluid<D>::scalar(Quantity quantity, PortId) {
  const FluidOpenings<D>& openings = dynamics_->openings();
  switch (quantity) {
    case Quantity::injected_mass:
      return openings.inlets->injected();
    case Quantity::removed_mass:
      return -openings.domain.removed() - (openings.outlets ? openings.outlets->removed() : 0.0);
    case Quantity::points_left:
      return static_cast<double>(openings.domain.points_left());
    case Quantity::free_mass: {
      double sum = 0.0;
      for (const double mass : dynamics_->points().mass) sum += mass;
      return sum;
    }
    case Quantity::given_mass:
      return openings.mouths->given();
    case Quantity::steps:
      return static_cast<double>(steps_);
    case Quantity::made_mass:
      return dynamics_->made_mass();
    case Quantity::merged:
      return static_cast<double>(dynamics_->merged());
    default:
      return static_cast<double>(dynamics_->searches());
  }
}

template <int D>
PortView SemiLagrangianFluid<D>::mouth_port(Quantity quantity) {
  FluidMouths<D>& mouths = *dynamics_->mouths();
  if (quantity == Quantity::mouth_intake) return {&mouths.points(), mouths.intake()};
  if (quantity == Quantity::mouth_stiffness) {
    return {&mouths.points(), mouths.stiffness(dynamics_->points(), dynamics_->fluid())};
  }
  return {&mouths.points(), mouths.pressure(dynamics_->points(), dynamics_->fluid())};
}

template <int D>
PortView SemiLagrangianFluid<D>::port(PortId id) {
  const Quantity quantity = quantities_[id];
  const PointSet* const body = body_ ? &body_->point_set() : nullptr;
  switch (quantity) {
    case Quantity::pressure:
    case Quantity::velocity:
    case Quantity::density:
    case Quantity::mass: {
      std::vector<double>& values = field(quantity);
      return {&moving_points(), values};
    }
    case Quantity::displacement:
      return {body, displacement_, displacement_rate_};
    case Quantity::damage:
      return {body, damage_, damage_rate_};
    case Quantity::pore_pressure:
      return {body, pore_pressure_, pore_pressure_rate_, pore_pressure_slope_};
    case Quantity::pore_mobility:
      return {body, pore_mobility_};
    case Quantity::interface_impulse:
      impulse_ = dynamics_->impulse();
      return {body, impulse_};
    case Quantity::exchanged_mass:
      exchanged_mass_ = dynamics_->exchanged_mass();
      return {body, exchanged_mass_};
    case Quantity::mouth_pressure:
    case Quantity::mouth_stiffness:
    case Quantity::mouth_intake:
      return mouth_port(quantity);
    case Quantity::piston: {
      int piston = static_cast<int>(ports_.size()) - 1 - id;
      const auto& walls = dynamics_->rigid_walls();
      for (std::size_t r = walls.size(); r-- > 0;) {
        if (walls[r].motion != RigidWall<D>::Motion::piston || piston-- > 0) continue;
        std::copy_n(walls[r].displacement.begin(), D, scalars_.begin() + id * D);
        break;
      }
      return {&whole_fluid, std::span(scalars_).subspan(id * D, D)};
    }
    default:
      scalars_[id * D] = scalar(quantity, id);
      return {&whole_fluid, std::span(scalars_).subspan(id * D, 1)};
  }
}

template <int D>
void SemiLagrangianFluid<D>::initialize(double t) {
  time_ = t;
  dynamics_->start_totals();
}

template <int D>
void SemiLagrangianFluid<D>::connect(PortId in) {
  const auto make_room = [](std::size_t count, std::initializer_list<std::vector<double>*> inputs) {
    for (std::vector<double>* input : inputs) input->resize(count);
  };
  const std::size_t points = body_ ? body_->points().size() : 0;
  switch (quantities_[in]) {
    case Quantity::displacement:
      return make_room(D * points, {&displacement_, &displacement_rate_});
    case Quantity::damage:
      return make_room(points, {&damage_, &damage_rate_});
    default:  // others have room from the start
      return;
  }
}

template <int D>
double SemiLagrangianFluid<D>::stable_time_step() const {
  return dynamics_->longest_step(time_);
}

template <int D>
double SemiLagrangianFluid<D>::advance(const TimeWindow& window) {
  dynamics_->set_body({displacement_, displacement_rate_, window.end});
  if (!damage_.empty()) {
    // Bonds break at once: what is known is the window's beginning.
    for (std::size_t i = 0; i < damage_.size(); ++i)
      damage_[i] -= window.length() * damage_rate_[i];
    dynamics_->set_damage(damage_);
  }
  dynamics_->start_totals();
  if (dynamics_->mouths() != nullptr) dynamics_->mouths()->begin_window(window.length());
  dynamics_->set_pores(
      {pore_pressure_, pore_pressure_rate_, pore_pressure_slope_, pore_mobility_, window.end});
  double t = window.begin;
  std::int64_t left = 0;
  while (t < window.end) {
    left = equal_steps(window.end - t, dynamics_->longest_step(t));
    const double length = (window.end - t) / static_cast<double>(left);
    dynamics_->step(t, length);
    t = left == 1 ? window.end : t + length;
    ++steps_;
  }
  time_ = window.end;
  return window.end;
}

template <int D>
void SemiLagrangianFluid<D>::visit_state(StateVisitor& visitor) {
  dynamics_->visit_state(visitor);
}

template <int D>
void SemiLagrangianFluid<D>::on_restored(double t) {
  time_ = t;
  ++restored_;
  dynamics_->forget();
}

template class SemiLagrangianFluid<2>;
template class SemiLagrangianFluid<3>;

}  // namespace perifrac
