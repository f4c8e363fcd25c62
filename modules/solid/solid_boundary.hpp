#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/body.hpp"
#include "core/operators/mirror_condition.hpp"

namespace perifrac {

/// What holds and what loads a solid: conditions of its faces and the body force.
template <int D>
class SolidBoundary {
 public:
  /// All faces free, no load.
  explicit SolidBoundary(const Body<D>& body);

  /// The normal displacement of a face is prescribed, tangentially it slides [m, outward].
  void roller(int face, double normal_displacement);
  /// The displacement of a face is prescribed [m].
  void fixed(int face, const Vector<D>& displacement);
  /// A rigid, frictionless plate with one unknown, its normal displacement. The force presses on
  /// the body [N, per metre in 2D].
  void rigid_plate(int face, double force);
  /// A uniform force per area on a face that is free otherwise [Pa].
  void traction(int face, const Vector<D>& traction);
  /// A uniform force per volume [N/m^3].
  void body_force(const Vector<D>& force) { body_force_ = force; }

  FaceSet mirrored() const;
  MirrorCondition<D, D> mirror_condition(const Family<D>& family) const;

  /// A rigid plate: the name of its face, and its place among all unknowns.
  struct Plate {
    std::string face;
    Index unknown;
  };
  std::vector<Plate> plates(const MirrorCondition<D, D>& mirror) const;
  /// Prescribed face values in their places among all unknowns, 0 elsewhere [m].
  Eigen::VectorXd prescribed_values(const MirrorCondition<D, D>& mirror) const;
  /// External force on every unknown [N]; `gradient` is the operator's gradient matrix.
  Eigen::VectorXd load(const MirrorCondition<D, D>& mirror,
                       const Eigen::SparseMatrix<double>& gradient) const;

 private:
  enum class Hold { free, roller, fixed, rigid_plate };
  struct Condition {
    Hold hold = Hold::free;
    Vector<D> displacement{};
    double plate_force = 0.0;
    Vector<D> traction{};
    bool loaded = false;
  };

  const Body<D>* body_;
  std::vector<Condition> faces_;
  Vector<D> body_force_{};
};

/// The keys of `boundary` and `body_force` in the solid's section.
KeyTable solid_boundary_keys();

/// Reads them; throws InputError.
template <int D>
SolidBoundary<D> read_solid_boundary(const Section& section, const Body<D>& body);

}  // namespace perifrac
