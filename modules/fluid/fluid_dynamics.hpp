#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/fluid/as_published/damaged_walls.hpp"
#include "modules/fluid/even_masses.hpp"
#include "modules/fluid/exchange/exchange.hpp"
#include "modules/fluid/fluid_energy.hpp"
#include "modules/fluid/method/fluid_method.hpp"
#include "modules/fluid/openings/fluid_openings.hpp"
#include "modules/fluid/points/fluid_neighbours.hpp"
#include "modules/fluid/walls/wall_force.hpp"
#include "modules/fluid/walls/wall_motion.hpp"

namespace perifrac {

/// Newton's law and continuity for the points of a weakly compressible fluid between walls:
/// drift by half a step, find density from the velocities there, then pressure, forces and
/// velocities, drift on. One evaluation a step; nothing but position, velocity, density and mass is
/// carried over, and what the fluid gives to walls and pores it has lost to the last digit.
template <int D>
class FluidDynamics {
 public:
  FluidDynamics(FluidProperties fluid, FluidScheme scheme, std::unique_ptr<FluidMethod<D>> method,
                Vector<D> gravity, Period<D> period, FluidPoints<D> points, WallCloud<D> cloud,
                std::vector<RigidWall<D>> rigid, std::size_t body_points, FluidOpenings<D> openings,
                std::unique_ptr<WallForce<D>> wall_force, std::unique_ptr<Exchange<D>> exchange,
                std::unique_ptr<DamagedWalls<D>> damaged_walls = nullptr);

  /// Where cracks open into the fluid; null: nowhere.
  FluidMouths<D>* mouths() { return openings_.mouths.get(); }
  void set_body(const BodyInput& body) { wall_motion_.set_body(body); }
  /// Fluid may enter the body where it is damaged.
  bool enters_damaged_walls() const { return damaged_walls_ != nullptr; }
  /// That of all points of the body; only where fluid may enter it.
  void set_damage(std::span<const double> damage) {
    if (damaged_walls_->apply(damage, wall_motion_.cloud())) wall_motion_.copy_volumes(walls_);
  }
  /// Totals given to the body's points are counted from here: impulse, D blocks [N s], and mass
  /// [kg]. They are empty where the body is not there, or nothing passes into it.
  void start_totals();
  /// All but `mass`, once the totals were started.
  void set_pores(const PoreInput& pores);
  const std::vector<double>& impulse() const { return impulse_; }
  const std::vector<double>& exchanged_mass() const { return exchange_.mass; }
  bool exchange_keeps_mass() const { return !exchange_.law || exchange_.law->keeps_mass(); }
  /// What the exchange made since the start [kg].
  double made_mass() const { return exchange_.made; }
  const FluidEnergy<D>& energy() const { return energy_; }

  /// The longest stable step now [s]. Throws NumericalError where a velocity is not finite.
  double longest_step(double t) const;
  /// One step from t [s].
  void step(double t, double length);

  void visit_state(StateVisitor& visitor);
  /// The state was replaced.
  void forget() { neighbours_.forget(); }

  FluidPoints<D>& points() { return points_; }
  const FluidPoints<D>& points() const { return points_; }
  const std::vector<RigidWall<D>>& rigid_walls() const { return wall_motion_.rigid(); }
  const FluidOpenings<D>& openings() const { return openings_; }
  const FluidProperties& fluid() const { return fluid_; }
  const FluidScheme& scheme() const { return scheme_; }
  const Vector<D>& gravity() const { return gravity_; }
  std::int64_t searches() const { return neighbours_.searches(); }
  std::int64_t merged() const { return merged_; }  ///< points, in this process
  /// Raised where points were reordered, or their number changed.
  std::uint64_t version() const { return version_; }

 private:
  void drift(double length);
  void remove_small_points(double t);
  void find_neighbours(double t);
  void copy_to_images();
  void exchange_mass(double t, double length);
  void change_masses(double t, double length);
  Index fastest_point() const;
  [[noreturn]] void stop_at(Index i, double t) const;
  bool is_beside_wall(Index i) const;
  void find_densities(double t, double length);
  void kick(double t, double length);
  void insert_points(double t);
  FluidStep<D> step_view() const;

  FluidProperties fluid_;
  FluidScheme scheme_;
  std::unique_ptr<FluidMethod<D>> method_;
  Vector<D> gravity_;
  FluidPoints<D> points_;
  WallMotion<D> wall_motion_;
  FluidOpenings<D> openings_;
  std::unique_ptr<WallForce<D>> wall_force_;
  struct PoreExchange {
    std::unique_ptr<Exchange<D>> law;  ///< null: nothing passes
    PoreInput pores{};
    std::vector<double> mass_rate{};  ///< of the fluid's points, with images [kg/s]
    std::vector<double> mass{};       ///< that passed, by point of the body [kg]
    double made = 0.0;                ///< what the law made since the start [kg]
    double longest_step = std::numeric_limits<double>::infinity();  ///< [s]
  };
  PoreExchange exchange_;
  std::unique_ptr<DamagedWalls<D>> damaged_walls_;  ///< null: they are as intact ones

  FluidNeighbours<D> neighbours_;
  NearWalls<D> walls_;
  FluidMoments<D> moments_;
  std::array<std::vector<double>, symmetric_size<D>> stress_;
  FluidForces<D> forces_;
  EvenMasses<D> even_masses_;
  FluidEnergy<D> energy_{fluid_, gravity_, points_};
  std::vector<double> impulse_;
  std::int64_t merged_ = 0;
  std::uint64_t version_ = 1;
};

}  // namespace perifrac
