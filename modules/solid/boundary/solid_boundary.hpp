#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "core/body/body.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/operators/nonlocal_gradient.hpp"
#include "core/time/scheduled_vector.hpp"

namespace perifrac {

/// What holds and what loads a solid: conditions of its faces, body force and weight, each with a
/// schedule that multiplies it.
///
/// A condition acts on the mirror ghosts of its face or, where the body has a bonded layer behind
/// the face, on the layer's points: roller and fixed prescribe their displacement, a rigid plate
/// gives them one normal displacement, traction and the plate's force are spread over them in
/// proportion to their volume. Where two layers meet, a prescribed displacement goes before a
/// plate, and the earlier face before the later.
template <int D>
class SolidBoundary {
 public:
  /// All faces free, no load. Refers to the body.
  explicit SolidBoundary(const Body<D>& body);

  /// The normal displacement of a face is prescribed, tangentially it slides: displacement [m,
  /// outward], which the schedule multiplies, plus velocity [m/s] times t.
  void roller(int face, double normal_displacement, double normal_velocity = 0.0,
              Schedule schedule = {});
  /// The displacement of a face is prescribed: displacement [m], which the schedule multiplies,
  /// plus velocity [m/s] times t.
  void fixed(int face, const Vector<D>& displacement, const Vector<D>& velocity = {},
             Schedule schedule = {});
  /// A roller or fixed face holds only those points of its layer that lie in the region; the others
  /// are free.
  void hold_only_in(int face, Region<D> region);
  /// A rigid, frictionless plate with one unknown, its normal displacement. The force presses on
  /// the body [N, per metre in 2D].
  void rigid_plate(int face, double force, Schedule schedule = {});
  /// A uniform force per area on a face that is free otherwise [Pa].
  void traction(int face, const Vector<D>& traction, Schedule schedule = {});
  /// A uniform pressure that presses on a face that is free otherwise, plane or curved [Pa]. A
  /// sphere takes it only where all plane faces of the body are mirrored, a hole where those are
  /// that are near.
  void pressure(int face, double pressure, Schedule schedule = {});
  /// One component of one point stays where it is: against a motion that nothing else resists, of a
  /// body whose loads balance.
  void pin(Index point, int axis) { pinned_.push_back(axis * body_->points().size() + point); }
  /// A uniform force per volume [N/m^3].
  void body_force(const Vector<D>& force, Schedule schedule = {});
  /// The walls of cut-outs bear nothing of a confining stress that the faces bear [Pa].
  void relieve_cutouts(const Vector<D>& confining_stress) { relief_ = confining_stress; }
  /// The weight of a rock of this density [kg/m^3] in this field [m/s^2].
  void gravity(double density, const Vector<D>& gravity);

  /// Faces with ghosts; a face with a layer has none.
  FaceSet mirrored() const;
  MirrorCondition<D, D> mirror_condition(const Family<D>& family) const;

  /// A rigid plate: the name of its face, and its place among the free unknowns.
  struct Plate {
    std::string face;
    Index column;
  };
  std::vector<Plate> plates(const MirrorCondition<D, D>& mirror) const;
  /// Takes the free unknowns to all: D blocks of point displacements, then face values. The free
  /// ones are the point displacements that nothing prescribes, in their order, then the plates'.
  Eigen::SparseMatrix<double> free_unknowns(const MirrorCondition<D, D>& mirror) const;
  /// Prescribed displacements in their places among all unknowns, 0 elsewhere [m].
  ScheduledVector prescribed(const MirrorCondition<D, D>& mirror) const;
  /// External force on every unknown, without reactions [N]; `force_of` is the operator's
  /// force_of_stress(). Throws BodyError as face_load.
  ScheduledVector loads(const MirrorCondition<D, D>& mirror, const ForceOfStress& force_of) const;
  /// Neither prescribed displacements nor loads change with time.
  bool is_constant() const;

 private:
  enum class Kind { free, traction, pressure, roller, fixed, rigid_plate };
  struct Condition {
    Kind kind = Kind::free;
    Vector<D> value{};     ///< displacement [m], traction [Pa] or force on the plate [N]
    Vector<D> velocity{};  ///< [m/s]
    double pressure = 0.0;
    Schedule schedule{};
    std::optional<Region<D>> region{};  ///< the part that it holds; none: all of it
    bool loads() const { return kind != Kind::free && !prescribes(); }
    bool prescribes() const { return kind == Kind::roller || kind == Kind::fixed; }
    bool holds() const { return kind == Kind::rigid_plate || prescribes(); }
  };
  struct BodyForce {
    Vector<D> force;  ///< [N/m^3]
    Schedule schedule;
  };

  bool has_layer(int face) const { return !body_->layer(face).empty(); }
  bool holds(int face, int component) const;
  std::vector<int> layer_holders() const;
  std::vector<Index> held(int face, int component, const MirrorCondition<D, D>& mirror,
                          const std::vector<int>& holders) const;
  void spread_over_layer(int face, const Vector<D>& force, Eigen::VectorXd& load) const;
  Eigen::VectorXd face_force(int face, const MirrorCondition<D, D>& mirror,
                             const ForceOfStress& force_of) const;

  const Body<D>* body_;
  std::vector<Condition> faces_;
  std::vector<Index> pinned_;  ///< unknowns
  std::vector<BodyForce> body_forces_;
  Vector<D> relief_{};  ///< confining stress that walls of cut-outs are relieved of [Pa]
};

}  // namespace perifrac
