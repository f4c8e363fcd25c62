#include "modules/solid/boundary/solid_boundary.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/operators/face_load.hpp"

namespace perifrac {

template <int D>
SolidBoundary<D>::SolidBoundary(const Body<D>& body) : body_(&body), faces_(body.faces().size()) {}

template <int D>
void SolidBoundary<D>::roller(int face, double normal_displacement, double normal_velocity,
                              Schedule schedule) {
  const Face& plane = body_->faces()[face];
  faces_[face] = {.kind = Kind::roller, .schedule = std::move(schedule)};
  faces_[face].value[plane.axis] = plane.direction * normal_displacement;
  faces_[face].velocity[plane.axis] = plane.direction * normal_velocity;
}

template <int D>
void SolidBoundary<D>::fixed(int face, const Vector<D>& displacement, const Vector<D>& velocity,
                             Schedule schedule) {
  faces_[face] = {.kind = Kind::fixed,
                  .value = displacement,
                  .velocity = velocity,
                  .schedule = std::move(schedule)};
}

template <int D>
void SolidBoundary<D>::hold_only_in(int face, Region<D> region) {
  faces_[face].region = std::move(region);
}

template <int D>
void SolidBoundary<D>::rigid_plate(int face, double force, Schedule schedule) {
  const Face& plane = body_->faces()[face];
  faces_[face] = {.kind = Kind::rigid_plate, .schedule = std::move(schedule)};
  faces_[face].value[plane.axis] = -plane.direction * force;
}

template <int D>
void SolidBoundary<D>::traction(int face, const Vector<D>& traction, Schedule schedule) {
  faces_[face] = {.kind = Kind::traction, .value = traction, .schedule = std::move(schedule)};
}

template <int D>
void SolidBoundary<D>::pressure(int face, double pressure, Schedule schedule) {
  const Face& plane = body_->faces()[face];
  if (plane.curved()) {
    faces_[face] = {.kind = Kind::pressure, .pressure = pressure, .schedule = std::move(schedule)};
  } else {
    Vector<D> normal{};
    normal[plane.axis] = -plane.direction * pressure;
    traction(face, normal, std::move(schedule));
  }
}

template <int D>
void SolidBoundary<D>::body_force(const Vector<D>& force, Schedule schedule) {
  body_forces_.push_back({force, std::move(schedule)});
}

template <int D>
void SolidBoundary<D>::gravity(double density, const Vector<D>& gravity) {
  body_force(density * gravity);
}

template <int D>
FaceSet SolidBoundary<D>::mirrored() const {
  FaceSet set = 0;
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (faces_[f].holds() && !has_layer(f)) set |= face_bit(f);
  }
  return set;
}

/// The face's condition prescribes a component of the displacement, or makes it a plate's.
template <int D>
bool SolidBoundary<D>::holds(int face, int component) const {
  const Kind kind = faces_[face].kind;
  return kind == Kind::fixed || (faces_[face].holds() && component == body_->faces()[face].axis);
}

template <int D>
MirrorCondition<D, D> SolidBoundary<D>::mirror_condition(const Family<D>& family) const {
  MirrorCondition<D, D> mirror(family);
  for (int f = 0; f < std::ssize(faces_); ++f) {
    for (int a = 0; a < D && !has_layer(f); ++a) {
      if (holds(f, a)) mirror.set_odd(f, a);
    }
  }
  return mirror;
}

/// For every point displacement the face through whose layer it is held, -1 where it is free.
template <int D>
std::vector<int> SolidBoundary<D>::layer_holders() const {
  const Index points = body_->points().size();
  std::vector<int> holders(D * points, -1);
  const auto hold = [&](int f, int a) {
    const auto& region = faces_[f].region;
    for (const Index i : body_->layer(f)) {
      if (region && !region->contains(body_->points().at(i))) continue;
      int& holder = holders[a * points + i];
      if (holder < 0) holder = f;
    }
  };
  for (const bool plates : {false, true}) {
    for (int f = 0; f < std::ssize(faces_); ++f) {
      if (plates != (faces_[f].kind == Kind::rigid_plate)) continue;
      for (int a = 0; a < D; ++a) {
        if (holds(f, a)) hold(f, a);
      }
    }
  }
  return holders;
}

/// The unknowns that are component `component` of a face that holds it: points of its layer, or its
/// face value.
template <int D>
std::vector<Index> SolidBoundary<D>::held(int face, int component,
                                          const MirrorCondition<D, D>& mirror,
                                          const std::vector<int>& holders) const {
  const Index points = body_->points().size();
  if (!has_layer(face)) return {D * points + mirror.face_value(face, component)};
  std::vector<Index> unknowns;
  for (const Index i : body_->layer(face)) {
    const Index u = component * points + i;
    if (holders[u] == face) unknowns.push_back(u);
  }
  return unknowns;
}

template <int D>
auto SolidBoundary<D>::plates(const MirrorCondition<D, D>& mirror) const -> std::vector<Plate> {
  std::vector<Plate> plates;
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (faces_[f].kind == Kind::rigid_plate) plates.push_back({body_->faces()[f].name, 0});
  }
  Index column = static_cast<Index>(free_unknowns(mirror).cols() - std::ssize(plates));
  for (Plate& plate : plates) plate.column = column++;
  return plates;
}

template <int D>
Eigen::SparseMatrix<double> SolidBoundary<D>::free_unknowns(
    const MirrorCondition<D, D>& mirror) const {
  const Index displacements = D * body_->points().size();
  const std::vector<int> holders = layer_holders();
  std::vector<Eigen::Triplet<double>> entries;
  Index column = 0;
  for (Index u = 0; u < displacements; ++u) {
    const bool pinned = std::ranges::find(pinned_, u) != pinned_.end();
    if (holders[u] < 0 && !pinned) entries.emplace_back(u, column++, 1.0);
  }
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (faces_[f].kind != Kind::rigid_plate) continue;
    for (const Index u : held(f, body_->faces()[f].axis, mirror, holders)) {
      entries.emplace_back(u, column, 1.0);
    }
    ++column;
  }
  Eigen::SparseMatrix<double> matrix(displacements + mirror.face_value_count(), column);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <int D>
ScheduledVector SolidBoundary<D>::prescribed(const MirrorCondition<D, D>& mirror) const {
  const Index unknowns = D * body_->points().size() + mirror.face_value_count();
  const std::vector<int> holders = layer_holders();
  ScheduledVector sum(unknowns);
  for (int f = 0; f < std::ssize(faces_); ++f) {
    const Condition& condition = faces_[f];
    if (!condition.prescribes()) continue;
    Eigen::VectorXd displacement = Eigen::VectorXd::Zero(unknowns);
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(unknowns);
    for (int a = 0; a < D; ++a) {
      if (!holds(f, a)) continue;
      for (const Index u : held(f, a, mirror, holders)) {
        displacement[u] = condition.value[a];
        velocity[u] = condition.velocity[a];
      }
    }
    sum.add(condition.schedule, displacement);
    if (condition.velocity != Vector<D>{}) sum.add(Schedule::growth(1.0), velocity);
  }
  return sum;
}

/// A force [N] as a body force, in proportion to volume, on the layer behind a face.
template <int D>
void SolidBoundary<D>::spread_over_layer(int face, const Vector<D>& force,
                                         Eigen::VectorXd& load) const {
  const auto& volume = body_->points().volume;
  double total = 0.0;
  for (const Index i : body_->layer(face)) total += volume[i];
  for (int a = 0; a < D; ++a) {
    for (const Index i : body_->layer(face)) {
      load[a * body_->points().size() + i] += force[a] * volume[i] / total;
    }
  }
}

/// What a face's condition does to every unknown at factor 1 of its schedule [N].
template <int D>
Eigen::VectorXd SolidBoundary<D>::face_force(int face, const MirrorCondition<D, D>& mirror,
                                             const ForceOfStress& force_of) const {
  const Index points = body_->points().size();
  const Condition& condition = faces_[face];
  Eigen::VectorXd load = Eigen::VectorXd::Zero(D * points + mirror.face_value_count());
  if (condition.kind == Kind::pressure) {
    Vector<D> stress;
    stress.fill(-condition.pressure);
    load.head(D * points) =
        curved_load<D>(*body_, force_of, mirrored(), body_->faces()[face], stress);
  } else if (has_layer(face)) {
    Vector<D> force = condition.value;
    const bool plate = condition.kind == Kind::rigid_plate;
    for (double& f : force) f *= plate ? 1.0 : body_->area(face);
    spread_over_layer(face, force, load);
  } else if (condition.kind == Kind::rigid_plate) {
    const int axis = body_->faces()[face].axis;
    load[D * points + mirror.face_value(face, axis)] = condition.value[axis];
  } else {
    for (int a = 0; a < D; ++a) {
      if (condition.value[a] == 0.0) continue;
      load.segment(a * points, points) +=
          condition.value[a] * face_load<D, D>(*body_, force_of, mirrored(), face, a);
    }
  }
  return load;
}

template <int D>
ScheduledVector SolidBoundary<D>::loads(const MirrorCondition<D, D>& mirror,
                                        const ForceOfStress& force_of) const {
  const Index points = body_->points().size();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(D * points + mirror.face_value_count());
  ScheduledVector sum(load.size());
  for (const auto& [force, schedule] : body_forces_) {
    for (int a = 0; a < D; ++a) {
      for (Index i = 0; i < points; ++i) {
        load[a * points + i] = force[a] * body_->points().volume[i];
      }
    }
    sum.add(schedule, load);
  }
  load.setZero();
  for (int a = 0; a < D; ++a) {
    if (relief_[a] == 0.0) continue;
    load.segment(a * points, points) = relief_[a] * cutout_load<D>(*body_, force_of, a);
  }
  if (relief_ != Vector<D>{}) {
    for (const Face& hole : body_->holes()) {
      load.head(D * points) += curved_load<D>(*body_, force_of, mirrored(), hole, relief_);
    }
    sum.add({}, load);
  }
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (faces_[f].loads()) sum.add(faces_[f].schedule, face_force(f, mirror, force_of));
  }
  return sum;
}

template <int D>
bool SolidBoundary<D>::is_constant() const {
  return std::ranges::all_of(faces_,
                             [](const Condition& c) {
                               return c.schedule.is_constant() && c.velocity == Vector<D>{};
                             }) &&
         std::ranges::all_of(body_forces_,
                             [](const BodyForce& b) { return b.schedule.is_constant(); });
}

template class SolidBoundary<2>;
template class SolidBoundary<3>;

}  // namespace perifrac
