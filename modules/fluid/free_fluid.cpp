#include "modules/fluid/free_fluid.hpp"

#include "core/time/equal_steps.hpp"

namespace perifrac {

namespace {

const PointSet whole_fluid{.name = "fluid_total"};

}  // namespace

template <int D>
FreeFluid<D>::FreeFluid(std::shared_ptr<const Body<D>> body, bool exchanges,
                        std::unique_ptr<FluidDynamics<D>> dynamics)
    : body_(std::move(body)), dynamics_(std::move(dynamics)) {
  point_set_ = {.name = "fluid", .dimension = D};
  make_ports(exchanges);
}

template <int D>
void FreeFluid<D>::make_ports(bool exchanges) {
  make_point_ports();
  make_total_ports();
  make_energy_ports();
  if (body_) make_body_ports();
  if (exchanges) make_pore_ports();
  if (dynamics_->openings().mouths) make_mouth_ports();
  make_piston_ports();
}

/// On its own moving points.
template <int D>
void FreeFluid<D>::make_point_ports() {
  const auto found = [this](Port port, auto find) {
    ports_.out(std::move(port), [this, find, values = std::vector<double>()]() mutable {
      values.clear();
      find(dynamics_->points(), values);
      return PortView{&moving_points(), values};
    });
  };
  const auto append = [](std::vector<double>& values, const std::vector<double>& more,
                         Index count) {
    values.insert(values.end(), more.begin(), more.begin() + count);
  };
  found({"fluid_pressure", "Pa"}, [this](const FluidPoints<D>& points, auto& values) {
    for (Index i = 0; i < points.count; ++i) {
      values.push_back(dynamics_->fluid().pressure(points.density[i]));
    }
  });
  found({.name = "fluid_velocity", .unit = "m/s", .components = D},
        [append](const FluidPoints<D>& points, auto& values) {
          for (int a = 0; a < D; ++a) append(values, points.velocity[a], points.count);
        });
  found({"fluid_density", "kg/m^3"}, [append](const FluidPoints<D>& points, auto& values) {
    append(values, points.density, points.count);
  });
  found({.name = "fluid_mass", .unit = unit_of_total("kg", D), .kind = PortKind::extensive},
        [](const FluidPoints<D>& points, auto& values) { values = points.mass; });
}

template <int D>
void FreeFluid<D>::make_total_ports() {
  const FluidOpenings<D>& openings = dynamics_->openings();
  const auto mass = [this](const char* name, PortRole role, std::function<double()> find) {
    ports_.total(total_port(name, "kg", role, D), whole_fluid, std::move(find));
  };
  mass("free_fluid_mass", PortRole::mass_stored, [this] {
    double sum = 0.0;
    for (const double of_point : dynamics_->points().mass) sum += of_point;
    return sum;
  });
  if (openings.inlets) {
    mass("injected_fluid_mass", PortRole::mass_gained,
         [&openings] { return openings.inlets->injected(); });
  }
  if (openings.may_lose()) {
    mass("removed_fluid_mass", PortRole::mass_gained, [&openings] {
      return -openings.domain.removed() - (openings.outlets ? openings.outlets->removed() : 0.0);
    });
  }
  if (openings.domain.may_lose()) {
    ports_.total(work_port("points_left"), whole_fluid,
                 [&openings] { return static_cast<double>(openings.domain.points_left()); });
  }
  ports_.total(work_port("integrator_steps"), whole_fluid,
               [this] { return static_cast<double>(steps_); });
  ports_.total(work_port("neighbour_searches"), whole_fluid,
               [this] { return static_cast<double>(dynamics_->searches()); });
}

/// The fluid's own balance of energy. It is no part of the ledger's: points make and lose volume,
/// which under pressure is much beside what all else stores.
template <int D>
void FreeFluid<D>::make_energy_ports() {
  const auto shown = [this](const char* name, auto find) {
    ports_.found({.name = name, .unit = unit_of_total("J", D), .kind = PortKind::extensive},
                 whole_fluid, [this, find](std::vector<double>& value) {
                   value.assign(1, find(dynamics_->energy(), dynamics_->points()));
                 });
  };
  using Energy = FluidEnergy<D>;
  using Points = FluidPoints<D>;
  shown("free_fluid_energy",
        [](const Energy& energy, const Points& points) { return energy.stored(points); });
  shown("free_fluid_work", [](const Energy& energy, const Points&) { return energy.gained(); });
  shown("free_fluid_heat", [](const Energy& energy, const Points&) { return energy.heat(); });
  shown("free_fluid_energy_made",
        [](const Energy& energy, const Points& points) { return energy.made(points); });
}

template <int D>
void FreeFluid<D>::make_body_ports() {
  const PointSet* const body = &body_->point_set();
  const std::size_t count = body_->points().size();
  ports_.in(
      {.name = "displacement", .unit = "m", .components = D},
      [this, count] {
        displacement_.resize(D * count);
        displacement_rate_.resize(D * count);
      },
      [this, body] {
        return PortView{body, displacement_, displacement_rate_};
      });
  ports_.found({.name = "interface_impulse",
                .unit = unit_of_total("N s", D),
                .kind = PortKind::extensive,
                .components = D},
               *body, [this](std::vector<double>& impulse) { impulse = dynamics_->impulse(); });
  if (!dynamics_->enters_damaged_walls()) return;
  ports_.in(
      {"damage", "1"},
      [this, count] {
        damage_.resize(count);
        damage_rate_.resize(count);
      },
      [this, body] {
        return PortView{body, damage_, damage_rate_};
      });
}

template <int D>
void FreeFluid<D>::make_pore_ports() {
  const PointSet* const body = &body_->point_set();
  // Where nobody writes them, the pores are empty and closed.
  for (auto* input :
       {&pore_pressure_, &pore_pressure_rate_, &pore_pressure_slope_, &pore_mobility_}) {
    input->resize(body_->points().size());
  }
  ports_.in(
      {"pore_pressure", "Pa"}, [] {},
      [this, body] {
        return PortView{body, pore_pressure_, pore_pressure_rate_, pore_pressure_slope_};
      });
  ports_.in(
      {"pore_mobility", "m^2/(Pa s)"}, [] {},
      [this, body] {
        return PortView{body, pore_mobility_};
      });
  ports_.found(
      {.name = "exchanged_mass", .unit = unit_of_total("kg", D), .kind = PortKind::extensive},
      *body, [this](std::vector<double>& mass) { mass = dynamics_->exchanged_mass(); });
  if (!dynamics_->exchange_keeps_mass()) {
    ports_.total(total_port("mass_made_by_exchange", "kg", PortRole::mass_artificial, D),
                 whole_fluid, [this] { return dynamics_->made_mass(); });
  }
  ports_.total(work_port("merged_points"), whole_fluid,
               [this] { return static_cast<double>(dynamics_->merged()); });
}

/// Where cracks open into it.
template <int D>
void FreeFluid<D>::make_mouth_ports() {
  FluidMouths<D>* const mouths = dynamics_->mouths();
  const auto property = [](const char* name, const std::string& unit, PortKind kind) {
    return Port{.name = name, .unit = unit, .kind = kind, .role = PortRole::property};
  };
  Port pressure = property("mouth_pressure", "Pa", PortKind::intensive);
  pressure.negligible = negligible_pressure;
  ports_.out(std::move(pressure), [this, mouths] {
    return PortView{&mouths->points(), mouths->pressure(dynamics_->points(), dynamics_->fluid())};
  });
  const char* const stiffness_unit = D == 2 ? "Pa m/kg" : "Pa/kg";
  ports_.out(property("mouth_stiffness", stiffness_unit, PortKind::intensive), [this, mouths] {
    return PortView{&mouths->points(), mouths->stiffness(dynamics_->points(), dynamics_->fluid())};
  });
  ports_.out(property("mouth_volume_stiffness", stiffness_unit, PortKind::intensive),
             [this, mouths] {
               return PortView{&mouths->points(),
                               mouths->volume_stiffness(dynamics_->points(), dynamics_->fluid())};
             });
  ports_.out(property("mouth_relaxation", "s", PortKind::intensive), [this, mouths] {
    return PortView{&mouths->points(), mouths->relaxation(dynamics_->fluid())};
  });
  const std::string kilograms = unit_of_total("kg", D);
  ports_.out(property("mouth_given", kilograms, PortKind::intensive), [mouths] {
    return PortView{&mouths->points(), mouths->given_by_mouth()};
  });
  ports_.in(
      property("mouth_taken", kilograms, PortKind::intensive), [] {},
      [mouths] {
        return PortView{&mouths->points(), mouths->taken()};
      });
  ports_.total(total_port("mass_given_to_cracks", "kg", PortRole::mass_stored, D), whole_fluid,
               [mouths] { return mouths->given(); });
}

template <int D>
void FreeFluid<D>::make_piston_ports() {
  for (const RigidWall<D>& wall : dynamics_->rigid_walls()) {
    if (wall.motion != RigidWall<D>::Motion::piston) continue;
    ports_.found({.name = wall.name + "_displacement", .unit = "m", .components = D}, whole_fluid,
                 [&wall](std::vector<double>& displacement) {
                   displacement.assign(wall.displacement.begin(), wall.displacement.end());
                 });
  }
}

template <int D>
const PointSet& FreeFluid<D>::moving_points() {
  const FluidPoints<D>& points = dynamics_->points();
  point_set_.version = dynamics_->version() + restored_;
  point_set_.count = points.count;
  for (int a = 0; a < D; ++a) {
    point_set_.position[a] = std::span(points.position[a]).first(points.count);
  }
  return point_set_;
}

template <int D>
void FreeFluid<D>::initialize(double t) {
  time_ = t;
  dynamics_->start_totals();
}

template <int D>
double FreeFluid<D>::stable_time_step() const {
  return dynamics_->longest_step(time_);
}

template <int D>
double FreeFluid<D>::advance(const TimeWindow& window) {
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
void FreeFluid<D>::visit_state(StateVisitor& visitor) {
  dynamics_->visit_state(visitor);
}

template <int D>
void FreeFluid<D>::on_restored(double t) {
  time_ = t;
  ++restored_;
  dynamics_->forget();
}

template class FreeFluid<2>;
template class FreeFluid<3>;

}  // namespace perifrac
