#pragma once

#include <bitset>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/errors.hpp"
#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"
#include "core/time/scheduled_vector.hpp"
#include "modules/solid/boundary/interface_force.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/fracture/crack_friction.hpp"
#include "modules/solid/fracture/crack_front.hpp"
#include "modules/solid/fracture/crack_nucleation.hpp"
#include "modules/solid/fracture/crack_tips.hpp"
#include "modules/solid/fracture/cracked_body.hpp"

namespace perifrac {

/// The quasi-static solid with cracks that grow (in 2D in plane strain): in equilibrium at the end
/// of every window. In 2D tips go on (crack_tips.hpp), in 3D fronts in their plane
/// (crack_front.hpp). The window is cut to the time when the first one does; with fluid in the
/// crack one does a window, so that the pressure answers before the next. In 2D cracks may begin
/// by themselves (crack_nucleation.hpp); the window is cut to the time of that too.
///
/// Ports: those of QuasiStaticSolid; and on the facets of the cracks (`crack`): in `crack_pressure`
/// [Pa], `crack_viscosity` [Pa s] and Carter's `crack_leak_off` [m/s^0.5], of the fluid at the
/// facet, 0 where it is dry; out `crack_opening` [m], and the property `free_crack_opening` [m],
/// what it would be if closed faces did not press on each other (negative: they pass through one
/// another), with its slope against crack_pressure, a matrix. `damage` of the points (paper Eq 16),
/// `crack_length` [m], of it `open_crack_length` where faces are apart, in 3D `crack_area` and
/// `open_crack_area` [m^2], and `fracture_energy` [J], what new faces took, in 2D per metre.
/// `radiated_energy` [J/m] is what unstable growth sets free beyond that, by J: a body with inertia
/// would move by it. In 2D, where no fluid is in the cracks.
/// Where a crack begins by itself or ends, at a face or another crack, that is what the balance of
/// energy says. With friction between
/// faces `friction_dissipation` [J/m], and `crack_slip_area` [m^2], the slip of all facets, counted
/// positive, times their length.
template <int D>
class FracturingSolid final : public PhysicsModule {
 public:
  /// `fracture_energy` infinite: no crack grows. `tensile_strength`, in 2D: cracks begin at it.
  /// `friction`: between faces, in 2D without fluid in the cracks; null: none.
  FracturingSolid(std::shared_ptr<const Body<D>> body, std::shared_ptr<Family<D>> family,
                  std::shared_ptr<BreakableElasticity<D>> elastic, const SolidBoundary<D>& boundary,
                  std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds,
                  FractureEnergy<D> fracture_energy,
                  const std::optional<TensileStrength<D>>& tensile_strength = {},
                  std::unique_ptr<CrackFriction> friction = nullptr);

  /// As QuasiStaticSolid's.
  std::string free_motion();

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override;
  /// As QuasiStaticSolid's.
  void set_pore_stress_at_rest(std::vector<double> stress) {
    pore_stress_at_rest_ = std::move(stress);
  }

  void initialize(double t) override;
  void connect(PortId in) override;
  double stable_time_step() const override;
  double advance(const TimeWindow& window) override;
  double conclude(const TimeWindow& window) override;
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double t) override;

 private:
  Index point_of(Eigen::Index free) const;
  std::string place_of(Eigen::Index free) const;
  BodyError loose_piece(const std::string& piece) const;
  enum Id : PortId {
    pore_stress,
    interface_impulse,
    crack_pressure,
    crack_viscosity,
    crack_leak_off,
    displacement,
    dilatation,
    effective_stress,
    damage,
    crack_opening,
    free_crack_opening,
    crack_area,
    open_crack_area,
    elastic_energy,
    external_work,
    fracture_energy,
    radiated_energy,
    first_plate
  };

  bool wet() const { return connected_[crack_pressure]; }  ///< fluid may be in the cracks
  /// Nothing of the solid's comes from others: it may take a window back by itself.
  bool is_alone() const { return !wet() && pore_stress_.empty() && !interface_.is_linked(); }
  /// Nothing but the faces' pressure changes: then displacements are found only when asked for.
  bool is_steady() const {
    return loads_are_steady_ && pore_stress_.empty() && !interface_.is_linked();
  }
  CrackState<D> crack_state();
  std::span<const double> added_pore_stress();
  Eigen::VectorXd find_load();
  Eigen::VectorXd in_cracks();
  std::span<double> of_facets(PortId in, std::vector<double>& values);
  void take_load();
  void solve_faces();
  void find_unknowns();
  std::span<const double> find_unknowns(const UnknownNames& names);
  void derive();
  void book_work();
  double elastic_energy_now();
  double released_energy();
  void find_effective_stress();
  bool grow(double most);
  double find_nucleus_readiness();
  double first_event(const TimeWindow& window);
  void begin_cracks(bool has_grown);
  bool begin_crack();

  std::shared_ptr<const Body<D>> body_;
  std::vector<CrackFacet<D>> seeds_;
  std::vector<Port> ports_;
  std::vector<Index> plate_unknowns_;
  Eigen::SparseMatrix<double> free_unknowns_;
  std::optional<InitialStress<D>> initial_stress_;
  ScheduledVector prescribed_{0};
  ScheduledVector load_{0};
  bool prescribes_ = false;  ///< some displacement other than 0
  bool loads_are_steady_ = false;

  BondState<D>& bonds_;
  CrackedBody<D> cracked_;
  std::conditional_t<D == 2, CrackTips, CrackFront> tips_;
  std::unique_ptr<CrackFriction> friction_;      ///< null: there is none
  std::unique_ptr<CrackNucleation> nucleation_;  ///< null where no crack begins by itself

  std::vector<double> unknowns_;  ///< D blocks of displacement, then face values [m]
  bool unknowns_are_current_ = false;
  std::vector<double> some_unknowns_;    ///< where a tip was last looked at
  bool load_is_current_ = false;         ///< the body has that of the window's end
  bool derived_ = false;                 ///< dilatation and energy are those of the unknowns
  std::vector<double> unknowns_before_;  ///< at the beginning of the window
  std::vector<double> force_;  ///< external, on every unknown, the fluid's in cracks apart [N/m]
  double load_work_ = 0.0,
         relief_work_ = 0.0;    ///< of the last window (CrackedBody::Energies) [J/m]
  std::int64_t has_begun_ = 0;  ///< work has been booked
  double external_work_ = 0.0;
  double spent_energy_ = 0.0;       ///< on new faces [J/m]
  double radiated_energy_ = 0.0;    ///< [J/m]
  double crack_area_ = 0.0;         ///< made when it is asked for
  double open_area_ = 0.0;          ///< likewise
  double slip_area_ = 0.0;          ///< likewise
  double readiness_ = 0.0;          ///< the largest of the tips, at the end of the window
  double nucleus_readiness_ = 0.0;  ///< that for a new crack likewise
  double readiness_before_ = 0.0;   ///< at the beginning of the window
  double nucleus_before_ = 0.0;     ///< likewise
  double last_growth_ = 0.0;        ///< [s]
  int cuts_ = 0;                    ///< of the window at hand

  std::bitset<displacement> connected_;  ///< in-ports
  std::vector<double> pore_stress_;
  std::vector<double> pore_stress_at_rest_;  ///< empty: none
  std::vector<double> added_pore_stress_;    ///< beyond that at rest, where there is any
  std::vector<double> crack_pressure_;
  std::vector<double> crack_viscosity_;
  std::vector<double> crack_leak_off_;
  InterfaceForce interface_;
  typename CrackedBody<D>::Faces faces_;
  Eigen::VectorXd free_opening_;
  std::vector<double> opening_slope_;
  std::vector<double> dilatation_;
  std::vector<double> slope_;
  std::vector<double> effective_stress_;
  std::vector<double> damage_;
  double elastic_energy_ = 0.0;
  double window_end_ = 0.0;
};

}  // namespace perifrac
