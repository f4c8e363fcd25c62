#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/state/state_visitor.hpp"
#include "modules/solid/cut_body.hpp"
#include "modules/solid/elastic_dynamics.hpp"

namespace perifrac {

/// The cracks of a solid with inertia: what their faces do to it.
///
/// Fluid pressure is an impulse at the beginning of every step: with it the opening at the step's
/// end is known ahead but for its part slope * pressure, slope = h^2 D M^-1 D^T (D takes
/// displacements to openings), and a pressure that keeps an opening as it is has no memory of the
/// last one, as it would if it were split between the step's ends.
///
/// Faces carry at least the pressure -relief - k w of contact, w their normal jump: a crack that is
/// closed at rest stays as it is under its initial stress. k takes up what the time step leaves.
///
/// The bonds that a facet cuts let go gradually: the force that they had acts on over `release`
/// and fades. The work that faces do against it is what growth takes, to tiny vibrations.
class CrackDynamics final : public CutBody, public AddedForce {
 public:
  /// As CutBody. `release`: how long bonds take to let go [s].
  CrackDynamics(std::shared_ptr<Family<2>> family, double spacing,
                std::shared_ptr<BreakableElasticity<2>> elastic, BondState<2>& bonds,
                std::optional<Vector<2>> initial_stress, std::vector<CrackFacet<2>> seeds,
                double release);

  /// The motion that the cracks are part of, and its longest step [s] with the factor that it is
  /// shorter than the stable one. It must stay. Again where one of them changed.
  void set_motion(ElasticDynamics<2>& system, double longest_step, double safety);
  void start(double t);

  bool cut(const CrackFacet<2>& facet) override;
  double intensity_at_fixed_volume(Index facet) const override;
  void add(double t, std::span<const double> u, std::span<double> inner) override;

  /// Gives velocities the impulse of a pressure in the facets over `step` [s].
  void press(std::span<const double> pressure, double step, std::span<double> velocity);
  /// Opening of every facet after a step with these velocities and accelerations, and its answer to
  /// the pressure within it, a matrix; velocities fall by `decay` first.
  void foretell(double step, double decay, std::span<const double> velocity,
                std::span<const double> acceleration);

  std::span<double> forecast() { return forecast_; }
  std::span<double> slope() { return slope_; }
  Eigen::VectorXd& opening() { return opening_; }                          ///< [m]
  const Eigen::VectorXd& face_pressure() const { return face_pressure_; }  ///< with contact [Pa]
  std::vector<Vector<2>> jumps_at(std::span<const double> unknowns) const;
  /// What the fluid's pressure does to every unknown [N].
  std::span<const double> fluid_force() const { return fluid_force_; }

  double release() const { return release_; }  ///< [s]
  double contact_energy() const;               ///< [J/m]
  double relief_work() const { return relief_work_; }
  double spent_energy() const { return spent_energy_; }  ///< on new faces [J/m]

  void visit_state(StateVisitor& visitor);
  /// The state was replaced: builds the body that its bonds belong to; true where it is another.
  bool follow_bonds();
  /// Then reads the jumps.
  void follow(double t, std::span<const double> u);

 private:
  /// A displacement that a facet's jump depends on.
  struct Term {
    Index unknown;
    Index moved;  ///< by what has a mass; negative: nothing
    double normal;
    double tangent;
  };
  /// The force that bonds had when a facet cut them, initial stress included.
  struct Held {
    Index facet;
    double since;                 ///< [s]
    double share = 1.0;           ///< that acts on
    std::vector<Index> unknowns;  ///< that it moves
    std::vector<double> force;    ///< on them [N]
    std::vector<double> last;     ///< their displacements [m]
  };

  void add_facet(const CrackFacet<2>& facet);
  void find_answers();
  void read_jump(Index f, std::span<const double> u);
  void find_face_pressure(Index f, double relief);
  void hold(double t, std::span<const double> u, std::span<double> inner);
  void add_faces(std::span<const double> u, std::span<double> inner);

  double release_;
  ElasticDynamics<2>* system_ = nullptr;
  double longest_step_ = 0.0, safety_ = 0.0;
  double t_ = 0.0;  ///< of the last force

  std::vector<std::vector<Term>> terms_;  ///< by facet
  /// D M^-1 D^T by facet: opening per impulse of pressure [m^2/(N s) m].
  std::vector<std::vector<std::pair<Index, double>>> answers_;
  double contact_stiffness_ = 0.0;                  ///< k [Pa/m]
  Eigen::VectorXd opening_, sliding_;               ///< [m]
  Eigen::VectorXd fluid_pressure_, face_pressure_;  ///< [Pa]
  std::vector<double> gripped_;  ///< by facet: share of its bonds' force that acts on
  std::vector<double> fluid_force_;
  std::vector<double> forecast_, slope_;
  double slope_step_ = -1.0, slope_decay_ = 0.0;  ///< that slope_ is of
  std::vector<Held> held_;
  double relief_work_ = 0.0, spent_energy_ = 0.0;
};

}  // namespace perifrac
