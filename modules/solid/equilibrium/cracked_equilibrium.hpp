#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/state/state_visitor.hpp"
#include "modules/solid/equilibrium/cracked_load.hpp"
#include "modules/solid/fracture/crack_friction.hpp"
#include "modules/solid/fracture/crack_state.hpp"
#include "modules/solid/fracture/cracked_body.hpp"
#include "modules/solid/fracture/fluid_in_cracks.hpp"

namespace perifrac {

/// A cracked body in equilibrium under its load, the fluid in its cracks, contact and friction:
/// first what the faces do, and of displacements what somebody asks for.
template <int D>
class CrackedEquilibrium {
 public:
  using Faces = typename CrackedBody<D>::Faces;

  /// All must stay; `friction` null: there is none.
  CrackedEquilibrium(CrackedBody<D>& cracked, CrackedLoad<D>& load, FluidInCracks& fluid,
                     CrackFriction* friction, std::optional<InitialStress<D>> initial_stress);

  void start(double t);
  /// What the faces do at time t [s], the window's end. Throws NumericalError.
  void solve(double t);

  double time() const { return t_; }  ///< that it was solved for [s]
  CrackedBody<D>& body() { return cracked_; }
  CrackedLoad<D>& load() { return load_; }
  CrackFriction* friction() { return friction_; }
  const Faces& faces() const { return faces_; }
  Faces& faces() { return faces_; }
  /// Some module says what fluid does in the cracks.
  bool is_wet() const { return fluid_.is_there(); }
  /// Of what is in the cracks, by facet [Pa].
  Eigen::VectorXd pressure_in_cracks();
  /// What the opening would be if faces could pass through one another [m].
  Eigen::VectorXd free_opening();

  /// D blocks of displacement, then face values [m].
  std::span<double> unknowns();
  std::span<double> dilatation();
  /// Without pore stress, where the load is not steady [J, per metre in 2D].
  double elastic_energy();
  /// Of the points, D * D blocks, the initial stress included [Pa].
  std::span<double> effective_stress();

  /// Of facets that tips are within: how far they are open.
  void set_partial(std::span<const PartialCut> cuts) {
    cracked_.set_partial(cuts);
    unknowns_are_current_ = false;
  }

  /// What the tips need to know of it.
  CrackState<D> state();

  /// What the faces do; the cuts are the body's bond state.
  void visit_state(StateVisitor& visitor);
  /// `displacement`: all unknowns that were restored; empty where the load is steady.
  void on_restored(double t, std::span<const double> displacement);

 private:
  std::span<const double> unknowns(const UnknownNames& names);
  void take_load();
  void derive();

  CrackedBody<D>& cracked_;
  CrackedLoad<D>& load_;
  FluidInCracks& fluid_;
  CrackFriction* friction_;
  std::optional<InitialStress<D>> initial_stress_;

  double t_ = 0.0;
  Faces faces_;
  bool load_is_current_ = false;  ///< the body has that of t_
  std::vector<double> unknowns_;
  bool unknowns_are_current_ = false;
  std::vector<double> some_unknowns_;  ///< where a tip was last looked at
  bool derived_ = false;               ///< dilatation and energy are those of the unknowns
  std::vector<double> dilatation_;
  double strain_energy_ = 0.0;
  std::vector<double> effective_stress_;
};

}  // namespace perifrac
