#include "modules/fluid/fluid_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/profile/profile.hpp"
#include "modules/fluid/particle_shifting.hpp"
#include "modules/fluid/points/merge_points.hpp"
#include "modules/fluid/points/split_points.hpp"
#include "modules/fluid/soak_points.hpp"
#include "modules/fluid/walls/wall_contact.hpp"

namespace perifrac {

namespace {

/// How much farther than the horizon neighbour lists reach, in spacings: wider lists hold for
/// longer and cost more in every step.
constexpr double skin = 0.25;

/// A point with less than this part of a lattice's shape tensor lies at a free surface: fluid there
/// bears no tension. A flat surface has .64, the row below it .95.
constexpr double surface_shape = 0.8;

/// Continuity alone forgets how densely points lie, and in long flows with free surfaces they end
/// up ever closer. Where their shape tensor is above a lattice's, density is raised at this rate
/// times the excess, in units of sound speed over spacing, so that pressure parts them again.
constexpr double unpacking_rate = 0.01;

/// Part of its mass below which a point is given up to the pores, so small that they hardly notice.
constexpr double remnant = 1e-6;

}  // namespace

template <int D>
FluidDynamics<D>::FluidDynamics(FluidProperties fluid, FluidScheme scheme,
                                std::unique_ptr<FluidMethod<D>> method, Vector<D> gravity,
                                Period<D> period, FluidPoints<D> points, WallCloud<D> cloud,
                                std::vector<RigidWall<D>> rigid, std::size_t body_points,
                                FluidOpenings<D> openings, std::unique_ptr<WallForce<D>> wall_force,
                                std::unique_ptr<Exchange<D>> exchange,
                                std::unique_ptr<DamagedWalls<D>> damaged_walls)
    : fluid_(fluid),
      scheme_(scheme),
      method_(std::move(method)),
      gravity_(gravity),
      points_(std::move(points)),
      wall_motion_(std::move(cloud), std::move(rigid), body_points, period),
      openings_(std::move(openings)),
      wall_force_(std::move(wall_force)),
      exchange_{.law = std::move(exchange)},
      damaged_walls_(std::move(damaged_walls)),
      neighbours_(scheme.horizon, skin * scheme.spacing, std::move(period)) {
  moments_.bulk_trace = lattice_trace<D>(scheme.spacing, scheme.horizon, method_->influence());
}

template <int D>
void FluidDynamics<D>::start_totals() {
  const std::size_t points = wall_motion_.body_points();
  if (points == 0) return;
  impulse_.assign(D * points, 0.0);
  if (exchange_.law) exchange_.mass.assign(points, 0.0);
}

/// A fluid point's pressure and that of the pores about it approach each other at a rate of up to
/// 4 kappa (K + 1/S) / (0.4 horizon)^2, with the moments of the Gaussian taken over all space.
template <int D>
void FluidDynamics<D>::set_pores(const PoreInput& pores) {
  const ProfileScope profiled("exchange with pores");
  exchange_.pores = pores;
  if (pores.mobility.empty()) return;
  exchange_.pores.mass = exchange_.mass;
  const WallCloud<D>& cloud = wall_motion_.cloud();
  double fastest = 0.0;
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) {
    const Index i = cloud.owner[w];
    const double of_pores = fluid_.density * cloud.volume[w] * pores.slope[i];
    fastest = std::max(fastest, pores.mobility[i] * (fluid_.bulk_modulus + of_pores));
  }
  const double width = 0.4 * scheme_.horizon;
  exchange_.longest_step = width * width / (4.0 * fastest);
}

template <int D>
double FluidDynamics<D>::longest_step(double t) const {
  const Index fastest = fastest_point();
  const double square = fastest < 0 ? 0.0 : squared_norm(vector_at(points_.velocity, fastest));
  if (!std::isfinite(square)) stop_at(fastest, t);
  const double speed = fluid_.sound_speed() + std::sqrt(square);
  const double kinematic =
      std::max(fluid_.viscosity / fluid_.density,
               scheme_.artificial_viscosity * fluid_.sound_speed() * scheme_.spacing);
  const double diffusion =
      std::max(kinematic, scheme_.density_diffusion * fluid_.sound_speed() * scheme_.spacing);
  const double spacing = scheme_.spacing;
  return std::min({scheme_.courant * spacing / speed, exchange_.longest_step,
                   diffusion > 0.0 ? 0.25 / D * spacing * spacing / diffusion : 1e300});
}

/// The first of those that are not a number; -1 where there is none at all.
template <int D>
Index FluidDynamics<D>::fastest_point() const {
  Index fastest = -1;
  double most = -1.0;
  for (Index i = 0; i < points_.count; ++i) {
    const double square = squared_norm(vector_at(points_.velocity, i));
    if (std::isnan(square)) return i;
    if (square <= most) continue;
    most = square;
    fastest = i;
  }
  return fastest;
}

template <int D>
void FluidDynamics<D>::stop_at(Index i, double t) const {
  throw NumericalError("fluid_velocity", describe_point(i, points_.at(i)), t,
                       "is not a finite number");
}

template <int D>
void FluidDynamics<D>::step(double t, double length) {
  const double middle = t + 0.5 * length;
  wall_motion_.follow(middle);
  drift(0.5 * length);
  wall_motion_.place(middle, neighbours_.wall_images(), walls_);
  if (neighbours_.outdated(points_, walls_)) find_neighbours(middle);
  copy_to_images();
  if (exchange_.law || openings_.mouths) remove_small_points(middle);
  method_->find_moments(points_, walls_, neighbours_, moments_);
  find_densities(middle, length);
  kick(middle, length);
  if (scheme_.shifting > 0.0) {
    shift_points<D>(step_view(), walls_, scheme_.shifting, length, points_);
  }
  drift(0.5 * length);
  if (openings_.inlets || exchange_.law || openings_.mouths) insert_points(t + length);
}

template <int D>
void FluidDynamics<D>::remove_small_points(double t) {
  const double whole = fluid_.density * std::pow(scheme_.spacing, D);
  const Index soaked = exchange_.law ? soak_points<D>(step_view(), walls_, remnant * whole, points_,
                                                      exchange_.mass, impulse_)
                                     : 0;
  const Index merged =
      merge_points(points_, neighbours_, method_->influence(), scheme_.merge_below * whole);
  if (soaked + merged == 0) return;
  points_.remove_if([&](Index i) { return points_.mass[i] == 0.0; });
  merged_ += merged;
  find_neighbours(t);
  copy_to_images();
}

template <int D>
void FluidDynamics<D>::drift(double length) {
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < points_.count; ++i) {
      points_.position[a][i] += length * points_.velocity[a][i];
    }
  }
  wall_motion_.drift(length);
}

template <int D>
void FluidDynamics<D>::find_neighbours(double t) {
  const ProfileScope profiled("neighbours");
  const auto search = [&] {
    if (openings_.outlets) openings_.outlets->remove(points_);
    openings_.domain.remove(points_, t);
    neighbours_.find(points_, wall_motion_.positions(t), walls_);
  };
  if (openings_.may_lose() || neighbours_.wraps_along(gravity_)) {
    energy_.gain_by(points_, search);
  } else {
    search();
  }
  wall_motion_.copy_volumes(walls_);
  wall_motion_.place(t, neighbours_.wall_images(), walls_);
  ++version_;
}

template <int D>
void FluidDynamics<D>::copy_to_images() {
  const PeriodicImages<D>& images = neighbours_.images();
  points_.volume.resize(points_.count);
  points_.pressure.resize(points_.count);
  for (Index i = 0; i < points_.count; ++i) {
    points_.volume[i] = points_.mass[i] / points_.density[i];
    points_.pressure[i] = fluid_.pressure(points_.density[i]);
  }
  images.copy_positions(points_.position, points_.count);
  for (int a = 0; a < D; ++a) images.copy(points_.velocity[a], points_.count);
  images.copy(points_.density, points_.count);
  images.copy(points_.volume, points_.count);
  images.copy(points_.pressure, points_.count);
}

template <int D>
FluidStep<D> FluidDynamics<D>::step_view() const {
  return {points_, wall_motion_.cloud(), neighbours_, moments_, fluid_,
          scheme_, method_->influence(), gravity_,    stress_};
}

template <int D>
void FluidDynamics<D>::exchange_mass(double t, double length) {
  const ProfileScope profiled("exchange with pores");
  exchange_.mass_rate.assign(points_.count, 0.0);
  walls_.mass_rate.assign(walls_.count, 0.0);
  for (auto& values : walls_.momentum_rate) values.assign(walls_.count, 0.0);
  exchange_.law->find(step_view(), exchange_.pores, t, length, walls_, exchange_.mass_rate);
  for (Index i = 0; i < points_.count; ++i) {
    const double gained = length * exchange_.mass_rate[i];
    points_.density[i] += gained / points_.volume[i];
    points_.mass[i] += gained;
    if (!(points_.mass[i] > 0.0)) {
      throw NumericalError("fluid_mass", describe_point(i, points_.at(i)), t,
                           "more flows into the pores in a step than there is");
    }
  }
  const WallCloud<D>& cloud = wall_motion_.cloud();
  for (Index k = 0; k < walls_.count; ++k) {
    const Index w = walls_.wall[k];
    if (cloud.is_rigid(w)) continue;
    exchange_.mass[cloud.owner[w]] += length * walls_.mass_rate[k];
    add_at(impulse_, exchange_.mass.size(), cloud.owner[w],
           length * vector_at(walls_.momentum_rate, k));
  }
  if (exchange_.law->keeps_mass()) return;
  double made = 0.0;
  for (const double rate : exchange_.mass_rate) made += rate;
  for (const double rate : walls_.mass_rate) made += rate;
  exchange_.made += length * made;
}

/// What passes into pores and cracks comes from few points, which the others make up for.
template <int D>
void FluidDynamics<D>::change_masses(double t, double length) {
  if (!exchange_.law && !openings_.mouths && !openings_.inlets) return;
  energy_.remember_masses(points_);
  if (exchange_.law) exchange_mass(t, length);
  if (openings_.mouths) openings_.mouths->give(points_, length, impulse_);
  if (openings_.inlets) {
    openings_.inlets->feed(points_, t, length, [&](Index i) { return is_beside_wall(i); });
  }
  energy_.gain_with_mass(points_);
  const bool evens = exchange_.law ? exchange_.law->keeps_mass() : openings_.mouths != nullptr;
  if (evens) even_masses_.step(step_view(), length, points_);
}

template <int D>
bool FluidDynamics<D>::is_beside_wall(Index i) const {
  const Neighbours& near = neighbours_.walls_of_fluid();
  const auto begin = near.other.begin();
  return std::any_of(begin + near.offset[i], begin + near.offset[i + 1], [&](Index w) {
    return squared_norm(vector_at(walls_.position, w) - points_.at(i)) <
           scheme_.horizon * scheme_.horizon;
  });
}

/// Continuity, diffusion of density, and what passes into the pores; then pressures.
template <int D>
void FluidDynamics<D>::find_densities(double t, double length) {
  const PeriodicImages<D>& images = neighbours_.images();
  images.copy(moments_.trace, points_.count);
  const double diffusivity = scheme_.density_diffusion * fluid_.sound_speed() * scheme_.spacing;
  change_masses(t, length);
  const double unpacking = unpacking_rate * fluid_.sound_speed() / scheme_.spacing;
  for (auto& values : stress_) values.resize(points_.count);
  for_each_point(points_.count, [&](Index i) {
    double& rho = points_.density[i];
    const double packing = moments_.trace[i] / moments_.bulk_trace;
    rho += length * (diffusivity * moments_.diffusion[i] - rho * moments_.divergence[i]);
    rho += length * unpacking * rho * std::max(0.0, packing - 1.0);
    if (packing < surface_shape) rho = std::max(rho, fluid_.density);
    points_.volume[i] = points_.mass[i] / rho;
    points_.pressure[i] = fluid_.pressure(rho);
    for (int k = 0; k < symmetric_size<D>; ++k) {
      stress_[k][i] = -points_.pressure[i] * moments_.inverse_shape[k][i];
    }
  });
  double power = 0.0;
  for (Index i = 0; i < points_.count; ++i) {
    power += points_.pressure[i] * points_.volume[i] * moments_.divergence[i];
  }
  energy_.set_lag(power, length);
  images.copy(points_.density, points_.count);
  images.copy(points_.volume, points_.count);
  images.copy(points_.pressure, points_.count);
  for (auto& values : stress_) images.copy(values, points_.count);
}

template <int D>
void FluidDynamics<D>::kick(double t, double length) {
  const FluidStep<D> view = step_view();
  forces_.finds_heat = energy_.begins_friction();
  method_->find_forces(view, forces_);
  {
    const ProfileScope profiled("walls");
    wall_force_->add(view, walls_, forces_);
  }
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < points_.count; ++i) {
      points_.velocity[a][i] += length * (forces_.force[a][i] / points_.mass[i] + gravity_[a]);
    }
  }
  if (forces_.finds_heat) {
    double friction = 0.0;
    for (const double of_point : forces_.heat) friction += of_point;
    energy_.set_friction(friction);
  }
  energy_.heat_up(length, stop_at_walls<D>(view, length, points_, walls_));
  energy_.gain(wall_motion_.kick(t, length, gravity_, walls_, impulse_));
  // Squares are beyond what numbers hold before velocities are, which say where.
  if (points_.count > 0 && !energy_.is_finite()) stop_at(fastest_point(), t);
}

template <int D>
void FluidDynamics<D>::insert_points(double t) {
  const double heaviest = 1.5 * fluid_.density * std::pow(scheme_.spacing, D);
  Index added = split_points<D>(points_, walls_, neighbours_, heaviest);
  if (openings_.inlets) {
    const Index first = points_.count;
    added += openings_.inlets->make_points(points_, [&](const Vector<D>& x) {
      return wall_motion_.leaves_room(x, t, scheme_.spacing);
    });
    energy_.gain_points(points_, first);
  }
  if (added == 0) return;
  neighbours_.forget();
  ++version_;
}

template <int D>
void FluidDynamics<D>::visit_state(StateVisitor& visitor) {
  constexpr std::array axes = {"x", "y", "z"};
  points_.trim();
  for (int a = 0; a < D; ++a) {
    visitor.visit(std::string("position_") + axes[a], points_.position[a]);
  }
  for (int a = 0; a < D; ++a) {
    visitor.visit(std::string("velocity_") + axes[a], points_.velocity[a]);
  }
  visitor.visit("density", points_.density);
  visitor.visit("mass", points_.mass);
  visitor.visit("id", points_.id);
  visitor.visit("next_id", points_.next_id);
  points_.count = static_cast<Index>(points_.mass.size());
  if (!exchange_keeps_mass()) visitor.visit("made_mass", exchange_.made);
  visitor.enter("energy");
  energy_.visit_state(visitor);
  visitor.leave();
  openings_.visit_state(visitor);
  wall_motion_.visit_state(visitor);
}

template class FluidDynamics<2>;
template class FluidDynamics<3>;

}  // namespace perifrac
