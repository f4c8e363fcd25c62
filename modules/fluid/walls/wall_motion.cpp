#include "modules/fluid/walls/wall_motion.hpp"

#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

template <int D>
void WallMotion<D>::follow(double t) {
  for (RigidWall<D>& wall : rigid_) wall.follow(t);
}

template <int D>
void WallMotion<D>::drift(double length) {
  for (RigidWall<D>& wall : rigid_) wall.drift(length);
}

template <int D>
double WallMotion<D>::kick(double t, double length, const Vector<D>& gravity,
                           const NearWalls<D>& near, std::vector<double>& impulse) {
  double work = 0.0;
  on_rigid_.assign(rigid_.size(), Vector<D>{});
  for (Index k = 0; k < near.count; ++k) {
    const Index w = near.wall[k];
    const Vector<D> force = vector_at(near.force, k);
    if (cloud_.is_rigid(w)) {
      on_rigid_[cloud_.owner[w]] += force;
    } else {
      add_at(impulse, body_points_, cloud_.owner[w], length * force);
      work -= length * dot(force, velocity(w));
    }
  }
  for (std::size_t r = 0; r < rigid_.size(); ++r) {
    const Vector<D> before = rigid_[r].velocity;
    rigid_[r].kick(t, length, on_rigid_[r], gravity);
    work -= 0.5 * length * dot(on_rigid_[r], before + rigid_[r].velocity);
  }
  return work;
}

template <int D>
Vector<D> WallMotion<D>::displacement(Index w, double t) const {
  if (cloud_.is_rigid(w)) return rigid_[cloud_.owner[w]].displacement;
  if (body_.displacement.empty()) return {};
  const Index owner = cloud_.owner[w];
  return vector_at<D>(body_.displacement, body_points_, owner) +
         vector_at<D>(body_.rate, body_points_, owner) * (t - body_.end);
}

template <int D>
Vector<D> WallMotion<D>::velocity(Index w) const {
  if (cloud_.is_rigid(w)) return rigid_[cloud_.owner[w]].velocity;
  if (body_.displacement.empty()) return {};
  return vector_at<D>(body_.rate, body_points_, cloud_.owner[w]);
}

template <int D>
const std::array<std::vector<double>, D>& WallMotion<D>::positions(double t) {
  for (int a = 0; a < D; ++a) position_[a].resize(cloud_.size());
  for (Index w = 0; w < cloud_.size(); ++w) {
    set_at(position_, w, cloud_.at(w) + displacement(w, t));
  }
  for (int a = 0; a < D; ++a) {
    if (!period_.ends[a]) continue;
    shift_[a].resize(cloud_.size());
    for (Index w = 0; w < cloud_.size(); ++w) {
      double& x = position_[a][w];
      shift_[a][w] = period_.shift(a, x);
      x += shift_[a][w];
    }
  }
  return position_;
}

template <int D>
Vector<D> WallMotion<D>::brought_back(Index w) const {
  Vector<D> shift{};
  for (int a = 0; a < D; ++a) {
    if (period_.ends[a]) shift[a] = shift_[a][w];
  }
  return shift;
}

template <int D>
void WallMotion<D>::place(double t, const PeriodicImages<D>& images, NearWalls<D>& near) const {
  for (int a = 0; a < D; ++a) {
    near.position[a].resize(near.wall.size());
    near.velocity[a].resize(near.wall.size());
  }
  for (Index k = 0; k < near.count; ++k) {
    const Index w = near.wall[k];
    set_at(near.position, k, cloud_.at(w) + displacement(w, t) + brought_back(w));
    set_at(near.velocity, k, velocity(w));
  }
  images.copy_positions(near.position, near.count);
  for (int a = 0; a < D; ++a) images.copy(near.velocity[a], near.count);
}

template <int D>
void WallMotion<D>::copy_volumes(NearWalls<D>& near) const {
  near.volume.resize(near.wall.size());
  for (std::size_t k = 0; k < near.wall.size(); ++k) near.volume[k] = cloud_.volume[near.wall[k]];
}

template <int D>
bool WallMotion<D>::leaves_room(const Vector<D>& x, double t, double spacing) const {
  for (Index w = 0; w < cloud_.size(); ++w) {
    const double square = squared_norm(period_.shortest(cloud_.at(w) + displacement(w, t) - x));
    const double reach = 0.45 * (spacing + std::pow(cloud_.volume[w], 1.0 / D));
    if (square < reach * reach) return false;
  }
  return true;
}

template <int D>
void WallMotion<D>::visit_state(StateVisitor& visitor) {
  constexpr std::array axes = {"x", "y", "z"};
  for (RigidWall<D>& wall : rigid_) {
    if (wall.motion == RigidWall<D>::Motion::fixed) continue;
    visitor.enter(wall.name);
    for (int a = 0; a < D; ++a) {
      visitor.visit(std::string("displacement_") + axes[a], wall.displacement[a]);
      visitor.visit(std::string("velocity_") + axes[a], wall.velocity[a]);
    }
    visitor.leave();
  }
}

template class WallMotion<2>;
template class WallMotion<3>;

}  // namespace perifrac
