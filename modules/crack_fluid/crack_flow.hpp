#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "core/solvers/complementarity.hpp"
#include "modules/crack_fluid/crack_graph.hpp"
#include "modules/crack_fluid/crack_liquid.hpp"
#include "modules/crack_fluid/crack_step.hpp"

namespace perifrac {

/// What a solve came to.
struct FlowReport {
  bool converged = false;
  int iterations = 0;
  Index worst = 0;  ///< the facet, or one of the crack, whose balance is farthest off
};

/// How fluid moves through cracks over a step, which is all that kinds of crack fluid differ in;
/// and what they have in common: what every facet holds and leaks at the unknowns v of
/// crack_liquid.hpp, and how wide the rock and its other faces let it be.
class CrackFlow {
 public:
  explicit CrackFlow(const CrackLiquid& liquid) : liquid_(liquid) {}
  virtual ~CrackFlow() = default;

  /// Other facets: they are only added. `height`: what fluid gains by its height at the middle of
  /// each, 0 without gravity [Pa].
  virtual void follow(CrackGraph graph, Eigen::VectorXd height);
  const CrackGraph& graph() const { return graph_; }

  /// As if nothing flowed in cracks: residual = m(v) - m_before + leak - inflow of wells.
  void rest(const CrackStep& step, const Eigen::VectorXd& v);
  /// Finds v, from where it is on, and the flows that belong to it. Throws NoContact.
  virtual FlowReport solve(const CrackStep& step, Eigen::VectorXd& v) = 0;
  /// Whether volumes that pass a facet are known; they are in 2D.
  virtual bool knows_rates() const { return false; }
  /// From every facet's first end to its second [m^2/s].
  virtual std::vector<double> rates(std::span<const double> /*pressure*/,
                                    std::span<const double> /*fill*/,
                                    std::span<const double> /*aperture*/) {
    return {};
  }

  const Eigen::VectorXd& residual() const { return residual_; }  ///< [kg/m]
  const Eigen::VectorXd& rounding() const { return rounding_; }  ///< of the residual, a bound
  const Eigen::VectorXd& aperture() const { return aperture_; }  ///< [m]
  const Eigen::VectorXd& opening() const { return opening_; }    ///< may be below the residual
  const Eigen::VectorXd& face_pressure() const { return face_pressure_; }  ///< with contact's [Pa]
  /// What presses closed faces together beyond the fluid; 0 where they are apart [Pa].
  double contact(Index f) const { return face_pressure_[f] - pressure_[f]; }
  const Eigen::VectorXd& capacity() const { return capacity_; }   ///< rho_0 area aperture
  const Eigen::VectorXd& leaked() const { return leaked_.mass; }  ///< over the step [kg/m]
  const Eigen::VectorXd& inflow() const { return inflow_; }       ///< by inlets and wells [kg/m]
  /// What flows to other facets over the step [kg/m].
  const Eigen::VectorXd& outflow() const { return outflow_; }
  bool is_full(Index f) const { return fill_[f] >= 1.0; }
  double height(Index f) const { return height_[f]; }  ///< as in follow() [Pa]
  bool is_beside_full(Index f) const;

 protected:
  /// Before the first rest(): faces that were no wider apart than at the least may touch.
  void begin_contact(const CrackStep& step);
  /// As rest(), where `response` is the slope of the openings times the pressures [m], and
  /// beginning from the faces that touched last.
  void rest(const CrackStep& step, const Eigen::VectorXd& v, const Eigen::VectorXd& response);
  void find_pressures(const Eigen::VectorXd& v);
  bool is_open(Index f) const { return opening_[f] > liquid_.residual_aperture; }

  CrackLiquid liquid_;
  CrackGraph graph_;
  Eigen::VectorXd height_;  ///< as in follow()

  Eigen::VectorXd terms_;  ///< of the opening, their sizes added up: what it is rounded off by [m]
  Eigen::VectorXd pressure_, fill_, opening_, face_pressure_, aperture_, capacity_;
  std::vector<bool> closed_;  ///< faces that touch; empty: none
  ComplementaritySolver contact_;
  Eigen::VectorXd residual_, rounding_, outflow_, inflow_;
  LeakedFluid leaked_;                               ///< its by_pressure is part of by_pressure_
  Eigen::VectorXd by_fill_;                          ///< of the residual, diagonal
  std::vector<Eigen::Triplet<double>> by_pressure_;  ///< at given apertures
  std::vector<Eigen::Triplet<double>> by_aperture_;  ///< of the mass that is stored

 private:
  void open(const CrackStep& step, const Eigen::VectorXd& response);
  void store(const CrackStep& step);
  void leak(LeakOff& leak_off);
  void take_from(WellFlow& well, double dt);
};

}  // namespace perifrac
