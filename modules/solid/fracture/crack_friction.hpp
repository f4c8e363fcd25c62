#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/solvers/frictional_contact.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/fracture/cracked_body.hpp"

namespace perifrac {

/// Coulomb friction between the faces of a body's cracks in 2D.
///
/// Closed faces bear a shear of up to coefficient times what they press on each other beyond the
/// pressure of a fluid between them. Below that they keep the slip that they had when the last
/// window ended, at it they slide on against it; open faces bear none. Shear is work-conjugate to
/// the mean tangential jump of a facet, as pressure is to the mean normal one. Slip is that jump
/// without what the rock that it is taken over would be strained by the same shear: faces that
/// stick leave the body as if they were not there.
class CrackFriction {
 public:
  explicit CrackFriction(double coefficient) : coefficient_(coefficient) {}

  /// No facet has slipped in the body, which is at rest, under its initial stress.
  void start(const CrackedBody<2>& body);

  /// What the faces do at a pressure in the cracks, by facet, at the end of a window. Throws
  /// NumericalError, with the time t [s], where no state of the faces is found that is in
  /// equilibrium.
  CrackedBody<2>::Faces faces(CrackedBody<2>& body, const Eigen::VectorXd& pressure, double t);
  /// How wide a shear on the faces opens all facets; those that it leaves out bear none [m].
  Eigen::VectorXd opening_by(CrackedBody<2>& body, std::span<const double> shear);
  /// Takes them for what they are at its end.
  void book(const CrackedBody<2>& body, const CrackedBody<2>::Faces& faces,
            const Eigen::VectorXd& pressure);

  double& dissipation() { return dissipation_; }  ///< by sliding, since the start [J/m]
  /// Of the rock that jumps are taken over, beyond that of the body; at rest 0 [J/m].
  double elastic_energy() const { return elastic_energy_; }
  std::span<const double> slip() const { return slip_; }  ///< when the last window ended [m]

  void visit_state(StateVisitor& visitor);

 private:
  double coefficient_;
  /// By facet, at the end of the last window; a facet that was cut since has not slipped.
  std::vector<double> slip_;   ///< [m]
  std::vector<double> limit_;  ///< what friction could bear [Pa]
  std::vector<double> borne_;  ///< what it did [Pa]
  double dissipation_ = 0.0, elastic_energy_ = 0.0;

  void follow(CrackedBody<2>& body);
  void take(CrackedBody<2>& body);
  std::vector<PairState> last_states(std::size_t count) const;

  FrictionalContactSolver contact_;  ///< openings, then slips, by pressures, then shears [m/Pa]
  std::vector<double> layer_;        ///< by facet: jump by shear of the rock that it is over [m/Pa]
  /// Of the body that it is of, and of its partial cuts.
  std::optional<std::uint64_t> version_, partial_version_;
};

}  // namespace perifrac
