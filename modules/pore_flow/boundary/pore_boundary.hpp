#pragma once

#include <functional>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/body/body.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/operators/nonlocal_gradient.hpp"
#include "core/time/scheduled_vector.hpp"
#include "modules/pore_flow/boundary/held_point.hpp"

namespace perifrac {

/// The area of a face, by point, that inflow through it enters at.
using FaceArea = std::function<Eigen::VectorXd(int face)>;

/// Where fluid comes from and goes to: conditions of a body's faces and sources inside it.
/// A face without a condition is sealed. Where a face has a bonded layer, the condition acts on the
/// layer's points: they hold the pressure, share the inflow, or take no part in the flow.
template <int D>
class PoreBoundary {
 public:
  explicit PoreBoundary(const Body<D>& body);

  /// Prescribes the pressure of a face [Pa].
  void pressure(int face, double pressure, Schedule schedule = {});
  /// Prescribes the volume that enters through a face per area and time [m/s].
  void flux(int face, double inflow, Schedule schedule = {});
  /// Adds fluid at a point [m^3/s, per metre in 2D].
  void source(Index point, double rate, Schedule schedule = {});

  /// A sealed face mirrors evenly, one of prescribed pressure oddly. A face with inflow is none: an
  /// even image has no slope there, a linear field would not be exact. Nor is one with a layer.
  FaceSet mirrored() const;
  /// Sealed faces without a layer.
  FaceSet sealed() const;
  /// Sealed faces with a layer.
  FaceSet sealed_layers() const;
  /// Faces with a layer that holds their pressure.
  FaceSet pressure_layers() const;
  MirrorCondition<D, 1> mirror_condition(const Family<D>& family) const;
  /// In order of points; a sealed layer has its points before another that shares them.
  std::vector<HeldPoint> held_points(const MirrorCondition<D, 1>& mirror) const;
  /// Prescribed pressures, by face value, then of pressure_layers() [Pa].
  ScheduledVector face_pressures(const MirrorCondition<D, 1>& mirror) const;
  /// Volume per time that inflow and sources bring to every point [m^3/s, per metre in 2D];
  /// `force_of`: the operator's force_of_stress().
  ScheduledVector sources(const ForceOfStress& force_of) const;
  /// The same where the operator spreads a face over the points by `area_by_point` [m^2, m in 2D].
  ScheduledVector sources_by(const FaceArea& area_by_point) const;
  bool has_sources() const;

 private:
  enum class Condition { sealed, pressure, flux };
  FaceSet faces_with(Condition condition, bool layered) const;
  /// The face's area, shared by the points of its layer by volume [m^2, m in 2D].
  Eigen::VectorXd area_in_layer(int face) const;

  struct FaceState {
    Condition condition = Condition::sealed;
    double value = 0.0;
    Schedule schedule{};
  };
  struct Source {
    Index point;
    double rate;
    Schedule schedule;
  };

  const Body<D>* body_;
  std::vector<FaceState> faces_;
  std::vector<Source> sources_;
};

/// The keys of `boundary` and `sources` in the section of pore flow.
KeyTable pore_boundary_keys();

/// Reads them; throws InputError.
template <int D>
PoreBoundary<D> read_pore_boundary(const Section& section, const Body<D>& body);

}  // namespace perifrac
