#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/state/state_visitor.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/motion/elastic_dynamics.hpp"

namespace perifrac {

/// The cracks of a solid with inertia: what their faces do to it.
///
/// The pressure of a step acts as one impulse at its beginning: with it the opening at the step's
/// end is known ahead but for its part slope * pressure, slope = h^2 D M^-1 D^T (D takes
/// displacements to openings), and a pressure that keeps an opening as it is has no memory of the
/// last one, as it would if it were split between the step's ends. Velocities are given half an
/// impulse before it is known, and the rest then, so that they are those of their time.
///
/// Faces that would overlap at the step's end carry the pressure beside it that leaves them closed,
/// without friction.
///
/// The bonds that a facet cuts let go gradually: the force that they had acts on over `release`
/// and fades. The work that faces do against it is what growth takes, to tiny vibrations.
class CrackDynamics final : public CutBody<2>, public BodyFracture {
 public:
  /// As CutBody. `release`: how long bonds take to let go [s].
  CrackDynamics(std::shared_ptr<Family<2>> family, double spacing,
                std::shared_ptr<BreakableElasticity<2>> elastic, BondState<2>& bonds,
                std::optional<InitialStress<2>> initial_stress, std::vector<CrackFacet<2>> seeds,
                double release);

  /// Of the motion that the cracks are part of, which must stay.
  void start(ElasticDynamics<2>& system, double t);

  bool cut(const CrackFacet<2>& facet) override;
  double intensity_at_fixed_volume(Index facet) override;
  std::optional<double> find_even_answers(std::span<const Index>, std::span<const Index>,
                                          std::span<double>, std::span<double>) override {
    return {};
  }
  /// After the last cut of a step: how openings answer to pressure.
  void find_answers();

  void add(double t, std::span<const double> u, std::span<double> inner) override;
  double stiffness_growth() const override { return growth_; }
  void follow_state() override;

  /// Where every facet opens to in a step from these velocities and accelerations, and how that
  /// answers to a pressure, a matrix; velocities fall by `decay` first.
  void foretell(double step, double decay, std::span<const double> velocity,
                std::span<const double> acceleration);
  /// Takes the pressure in the facets for the step that was foretold, and finds that of contact.
  void press(std::span<const double> pressure);
  void begin_step(double step, std::span<double> velocity) override;
  void end_step(double step, std::span<double> velocity) override;

  std::span<double> forecast() { return forecast_.opening; }     ///< without contact [m]
  std::span<double> slope() { return forecast_.slope; }          ///< [m/Pa]
  Eigen::VectorXd& opening() { return opening_; }                ///< [m]
  const Eigen::VectorXd& pressure() const { return pressure_; }  ///< with contact [Pa]
  std::vector<Vector<2>> jumps_at(std::span<const double> unknowns) const;
  /// What the pressure on the faces does to every unknown [N].
  std::span<const double> face_force() const { return face_force_; }

  double release() const { return release_; }            ///< [s]
  double relief_work() const { return relief_work_; }    ///< [J/m]
  double contact_loss() const { return contact_loss_; }  ///< where faces met [J/m]
  double spent_energy() const { return spent_energy_; }  ///< on new faces [J/m]

  void visit_state(StateVisitor& visitor);
  /// After follow_state(): of the present displacements.
  void read_jumps();

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
    Index facet = 0;
    double since = 0.0;             ///< [s]
    double share = 1.0;             ///< that acts on
    std::vector<Index> unknowns{};  ///< that it moves
    std::vector<double> force{};    ///< on them [N]
    std::vector<double> last{};     ///< their displacements [m]
  };

  void add_facet(const CrackFacet<2>& facet);
  void note_stiffness(Index i);
  void strike(const Eigen::VectorXd& impulse, const Eigen::VectorXd& contact,
              std::span<double> velocity);
  double opening_rate(std::size_t f, std::span<const double> velocity) const;
  void read_jump(Index f, std::span<const double> u);
  void hold(double t, std::span<const double> u, std::span<double> inner);
  void add_faces(std::span<const double> u, std::span<double> inner);

  double release_;
  ElasticDynamics<2>* system_ = nullptr;
  double t_ = 0.0;                  ///< of the last force
  double stiffest_at_start_ = 0.0;  ///< stiffness_bound(), the largest of all points
  double growth_ = 1.0;

  std::vector<std::vector<Term>> terms_;  ///< by facet
  /// D M^-1 D^T by facet: opening per impulse of pressure [m^2/(N s) m].
  std::vector<std::vector<std::pair<Index, double>>> answers_;
  Eigen::VectorXd opening_, sliding_;  ///< [m]
  Eigen::VectorXd pressure_;           ///< [Pa]
  Eigen::VectorXd contact_;            ///< its part [Pa]
  /// Impulse of the next step that was given before, and that of contact in it [Pa s].
  Eigen::VectorXd given_, given_by_contact_;
  std::vector<double> face_force_;
  struct Forecast {
    std::vector<double> opening;  ///< without contact [m]
    std::vector<double> slope;    ///< against pressure, a matrix [m/Pa]
    double step = -1.0;           ///< that the slope is of [s]
  };
  Forecast forecast_;
  std::vector<Held> held_;
  double relief_work_ = 0.0, spent_energy_ = 0.0, contact_loss_ = 0.0;
};

}  // namespace perifrac
