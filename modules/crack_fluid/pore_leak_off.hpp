#pragma once

#include <vector>

#include "core/body/fluid_weight.hpp"
#include "core/module/port.hpp"
#include "modules/crack_fluid/leak_off.hpp"
#include "modules/crack_fluid/sealed_walls.hpp"

namespace perifrac {

/// Fluid that passes between a crack and the pores on both of its sides, by each bond (i, j) that a
/// facet f cuts,
///   J_i = rho_0 kappa_i omega 4d / (m_i + m_j) V_i V_j (p_f - p_i),
/// and likewise J_j, m of the intact families: that of pore flow itself, which has these bonds no
/// more. It acts as if the crack's pressure were held 0.14 spacings outside the rock (horizons of
/// 2.5 spacings; 0.10 of 4). Twice that, for half the way, would be exact if pressure fell linearly
/// on one side to the image of the other; beside families that are cut, the pressure then acts 0.4
/// (0.7) spacings within the rock. A facet that is not full gives none.
/// Under gravity p_f is that of the facet's fluid at rest at the height of the point.
/// The pores' pressure answers what they get at once, p_i = b_i + s_i sum J_i, as the port
/// `pore_pressure` says: a lagged one would be an explicit step of diffusion.
template <int D>
class PoreLeakOff final : public LeakOff {
 public:
  PoreLeakOff(std::shared_ptr<const Body<D>> body, double density, double vapour_pressure,
              SealedWalls<D> sealed = SealedWalls<D>(), const Vector<D>& gravity = {});

  bool is_sink() const override { return false; }
  void match(const PointSet& facets, const CrackGraph& graph) override;
  void begin_window(const TimeWindow& window) override;
  void begin(const TimeWindow& step, std::span<const double> fill) override;
  void evaluate(const Eigen::VectorXd& pressure, const Eigen::VectorXd& fill,
                LeakedFluid& leaked) override;
  double accept(std::span<const double> fill) override;
  void visit_state(StateVisitor&) override {}

  PortView pore_pressure();                               ///< in, takes rate and slope
  PortView pore_mobility();                               ///< in
  std::vector<double>& exchanged() { return received_; }  ///< by point, over the window [kg/m]

 private:
  /// Of all bonds between a facet and one point.
  struct Contact {
    Index facet;
    Index touched;  ///< the point's place in touched_
    double factor;  ///< omega 4d / (m_i + m_j) V_i V_j, summed
    double lower;   ///< what fluid at rest has more at the point than at the facet [Pa]
  };

  void find_contacts(const BondState<D>& bonds, const PointSet& facets);
  void differentiate(LeakedFluid& leaked) const;

  std::shared_ptr<const Body<D>> body_;
  std::shared_ptr<const Family<D>> family_;
  double density_;
  double vapour_pressure_;
  SealedWalls<D> sealed_;
  FluidWeight<D> weight_;
  std::uint64_t version_ = 0;      ///< of the bonds that the contacts are made of
  std::vector<Contact> contacts_;  ///< sorted by point
  std::vector<Index> touched_;     ///< points with contacts

  TimeWindow window_{};
  TimeWindow step_{};
  // By touched point, of the step at hand.
  std::vector<double> base_;         ///< b [Pa]
  std::vector<double> base_before_;  ///< the pressure when the step begins [Pa]
  std::vector<double> sum_;          ///< sum C
  std::vector<double> mean_;         ///< sum C p_f, then p_i [Pa]
  // By contact.
  std::vector<double> conductance_;  ///< C, over the step [kg/(m Pa)]
  std::vector<double> flux_;         ///< [kg/m]

  std::vector<double> received_;
  struct {
    std::vector<double> value, rate, slope;
  } pressure_;  ///< of every point: the input and its companions
  std::vector<double> mobility_;
};

}  // namespace perifrac
