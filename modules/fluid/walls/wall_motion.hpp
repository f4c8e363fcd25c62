#pragma once

#include <span>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/points/wall_cloud.hpp"
#include "modules/fluid/walls/rigid_wall.hpp"

namespace perifrac {

/// Where the body's points are: at time t they are displaced by displacement + rate (t - end).
struct BodyInput {
  std::span<const double> displacement{};  ///< D blocks [m]; empty: at rest
  std::span<const double> rate{};          ///< [m/s]
  double end = 0.0;                        ///< [s]
};

/// How all walls move: rigid ones as they say, the body's points as the body does.
template <int D>
class WallMotion {
 public:
  WallMotion(WallCloud<D> cloud, std::vector<RigidWall<D>> rigid, std::size_t body_points,
             Period<D> period)
      : cloud_(std::move(cloud)),
        rigid_(std::move(rigid)),
        body_points_(body_points),
        period_(std::move(period)) {}

  void set_body(const BodyInput& body) { body_ = body; }
  const WallCloud<D>& cloud() const { return cloud_; }
  WallCloud<D>& cloud() { return cloud_; }
  const std::vector<RigidWall<D>>& rigid() const { return rigid_; }
  std::size_t body_points() const { return body_points_; }

  /// The velocities of rigid walls for a step about time t [s].
  void follow(double t);
  /// They move on for `length` [s].
  void drift(double length);
  /// The fluid's forces on near points push pistons; the body's points get their impulse, D blocks
  /// [N s]. Returns the work of all walls on the fluid [J].
  double kick(double t, double length, const Vector<D>& gravity, const NearWalls<D>& near,
              std::vector<double>& impulse);

  /// Positions of the whole cloud at time t [s], brought back between the ends of periods; valid
  /// until the next call.
  const std::array<std::vector<double>, D>& positions(double t);
  /// Positions and velocities of the near points and their images, in the same period as at the
  /// last call of positions().
  void place(double t, const PeriodicImages<D>& images, NearWalls<D>& near) const;
  /// Volumes of the near points and their images.
  void copy_volumes(NearWalls<D>& near) const;
  /// No wall point's cell holds x, nor comes near it, for a fluid of this spacing [m].
  bool leaves_room(const Vector<D>& x, double t, double spacing) const;

  void visit_state(StateVisitor& visitor);

 private:
  Vector<D> displacement(Index w, double t) const;
  Vector<D> brought_back(Index w) const;
  Vector<D> velocity(Index w) const;

  WallCloud<D> cloud_;
  std::vector<RigidWall<D>> rigid_;
  std::size_t body_points_;
  Period<D> period_;
  BodyInput body_;
  std::vector<Vector<D>> on_rigid_;  ///< the fluid's force on each rigid wall [N]
  std::array<std::vector<double>, D> position_;
  std::array<std::vector<double>, D> shift_;  ///< by whole periods; empty where there are none [m]
};

}  // namespace perifrac
