#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "core/module/time_window.hpp"
#include "modules/crack_fluid/crack_graph.hpp"
#include "modules/crack_fluid/crack_liquid.hpp"
#include "modules/crack_fluid/joint_conductances.hpp"
#include "modules/crack_fluid/leak_off.hpp"

namespace perifrac {

/// How wide the facets would be if closed faces did not press on each other:
/// value + rate (t - end) + slope p at time t under the fluid's pressures p, of all facets. Where
/// that is negative, faces close: contact adds to p there what keeps them from overlapping.
struct CrackOpening {
  using Slope = Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>;

  /// `compliance`: count * count values, row by row.
  CrackOpening(std::span<const double> opening, std::span<const double> opening_rate,
               std::span<const double> compliance, double window_end)
      : value(opening),
        rate(opening_rate),
        slope(compliance.data(), static_cast<Index>(value.size()),
              static_cast<Index>(value.size())),
        end(window_end) {}

  std::span<const double> value;  ///< [m]
  std::span<const double> rate;   ///< [m/s]
  Slope slope;                    ///< [m/Pa]
  double end;                     ///< [s]
};

/// Fluid that comes in at a facet over a step: `least` to `most` [kg], in 2D per metre, within
/// which it holds the pressure `target` [Pa], less `stiffness` [Pa m/kg] times what comes in; above
/// that it takes the least, below it the most.
struct FacetInflow {
  Index facet;
  double least;
  double most;
  double target;
  double stiffness = 0.0;
};

/// One step of the flow in a crack, backward Euler.
struct LubricationStep {
  TimeWindow time;
  CrackOpening opening;
  std::span<const double> mass;  ///< of the facets when it begins [kg/m]
  std::span<const FacetInflow> inflows{};
  LeakOff* leak_off = nullptr;  ///< may be null
};

/// The mass balance of every facet at the unknowns v of crack_liquid.hpp:
///   R_f = m_f(v) - m_f^n + dt sum_g J_fg + leak_f - inflow_f,
///   m = rho(p) area max(w, residual) fill,   J_fg = rho(upstream) G_fg (p_f - p_g).
/// Flow follows the cubic law w^3 / (12 mu) from middle to joint to middle, w the aperture at the
/// joint: the mean of a facet and the widest other one that it meets there. Where k facets meet,
/// the vertex between them is eliminated, G_fg = c_f c_g / sum c. A facet that is not full is
/// under the least pressure there is, so that fluid leaves full facets alone, as it must.
class Lubrication {
 public:
  Lubrication() = default;
  Lubrication(const CrackLiquid& liquid, CrackGraph graph);

  const CrackGraph& graph() const { return graph_; }

  /// Evaluates all of the below.
  void evaluate(const LubricationStep& step, const Eigen::VectorXd& v);

  const Eigen::VectorXd& residual() const { return residual_; }  ///< [kg/m]
  const Eigen::VectorXd& rounding() const { return rounding_; }  ///< of the residual, a bound
  const Eigen::VectorXd& aperture() const { return aperture_; }  ///< [m]
  const Eigen::VectorXd& opening() const { return opening_; }    ///< may be below the residual
  const Eigen::VectorXd& face_pressure() const { return face_pressure_; }  ///< with contact's [Pa]
  /// What presses closed faces together beyond the fluid; 0 where they are apart [Pa].
  double contact(Index f) const { return face_pressure_[f] - pressure_[f]; }
  /// d(opening) / d(pressure), with the faces closed that are closed [m/Pa].
  const Eigen::MatrixXd& opening_slope() const { return opening_slope_; }
  const Eigen::VectorXd& capacity() const { return capacity_; }   ///< rho_0 area aperture
  const Eigen::VectorXd& leaked() const { return leaked_.mass; }  ///< over the step [kg/m]
  const Eigen::VectorXd& inflow() const { return inflow_; }       ///< by inlets [kg/m]
  /// What flows and leaks out over the step, inlets apart [kg/m].
  const Eigen::VectorXd& outflow() const { return outflow_; }
  bool is_full(Index f) const { return fill_[f] >= 1.0; }
  bool is_beside_full(Index f) const;
  /// Of the residual by v. With conductances held, what is left is what a monotone operator has,
  /// the more mass and flow the higher the pressures.
  enum class Conductances { follow, held };
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& v,
                           Conductances conductances = Conductances::follow) const;

  /// Calls use(a, b, flux) for every pair of branches that meet, flux [kg/(m s)] from a to b.
  template <class Use>
  void for_each_flux(std::span<const double> pressure, std::span<const double> aperture,
                     Use&& use) {
    for (std::size_t k = 0; k < graph_.joint_count(); ++k) {
      const auto joint = graph_.joint(k);
      at_joint_.find(joint, aperture, graph_, liquid_.viscosity);
      for (std::size_t a = 0; a < joint.size(); ++a) {
        for (std::size_t b = a + 1; b < joint.size(); ++b) {
          const double fall = pressure[joint[a].facet] - pressure[joint[b].facet];
          const double upstream = pressure[joint[fall >= 0.0 ? a : b].facet];
          use(joint[a], joint[b],
              liquid_.density_at(upstream) * at_joint_.conductance[a] * at_joint_.conductance[b] /
                  at_joint_.sum * fall);
        }
      }
    }
  }

 private:
  void store(const LubricationStep& step);
  void open(const LubricationStep& step);
  void leak(LeakOff& leak_off);
  void flow(double dt);
  double rounding_of_fall(Index from, Index to) const;
  void differentiate_joint(std::span<const CrackGraph::Branch> joint, double dt);
  void let_in(const LubricationStep& step, const Eigen::VectorXd& v);

  CrackLiquid liquid_{};
  CrackGraph graph_;

  Eigen::VectorXd terms_;  ///< of the opening, their sizes added up: what it is rounded off by [m]
  Eigen::VectorXd pressure_, fill_, opening_, face_pressure_, aperture_, capacity_;
  Eigen::MatrixXd opening_slope_;
  Eigen::VectorXd residual_, rounding_, outflow_, inflow_;
  LeakedFluid leaked_;                               ///< its by_pressure is part of by_pressure_
  Eigen::VectorXd by_fill_;                          ///< of the residual, diagonal
  std::vector<Eigen::Triplet<double>> by_pressure_;  ///< at given apertures
  std::vector<Eigen::Triplet<double>> by_aperture_;  ///< of the mass that is stored
  std::vector<Eigen::Triplet<double>> flow_by_aperture_;
  /// Facets with row weight (v - target + stiffness inflow).
  struct Held {
    Index facet;
    double weight;
    double stiffness;
  };
  std::vector<Held> held_;

  JointConductances at_joint_;  ///< at hand
};

}  // namespace perifrac
