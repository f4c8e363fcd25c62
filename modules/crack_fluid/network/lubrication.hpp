#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "modules/crack_fluid/crack_flow.hpp"
#include "modules/crack_fluid/network/joint_conductances.hpp"

namespace perifrac {

/// The mass balance of every facet at the unknowns v of crack_liquid.hpp:
///   R_f = m_f(v) - m_f^n + dt sum_g J_fg + leak_f - inflow_f,
///   m = rho(p) area max(w, residual) fill,
///   J_fg = rho(upstream) fill(upstream) G_fg (p_f - p_g + rho_0 g.(x_g - x_f)).
/// Flow follows the cubic law w^3 / (12 mu) from middle to joint to middle, w the aperture at the
/// joint: the mean of a facet and the widest other one that it meets there. Where k facets meet,
/// the vertex between them is eliminated, G_fg = c_f c_g / sum c. A facet that is not full is
/// under the least pressure there is, so that without gravity fluid leaves full facets alone, as it
/// must; under gravity it falls out of others as it fills them.
class Lubrication final : public CrackFlow {
 public:
  explicit Lubrication(const CrackLiquid& liquid) : CrackFlow(liquid) {}
  /// `height` as in follow(); empty: no gravity.
  Lubrication(const CrackLiquid& liquid, CrackGraph graph, Eigen::VectorXd height = {});

  /// By Newton's method (lubrication_newton.hpp); where it fails, once more from neighbours' fluid.
  FlowReport solve(const CrackStep& step, Eigen::VectorXd& v) override;
  bool knows_rates() const override { return true; }
  std::vector<double> rates(std::span<const double> pressure, std::span<const double> fill,
                            std::span<const double> aperture) override;

  /// Finds residual, outflow and inflow, and what the Jacobian is made of.
  void evaluate(const CrackStep& step, const Eigen::VectorXd& v);

  /// d(opening) / d(pressure), with the faces closed that are closed; 0 by pressures of facets that
  /// are not full [m/Pa].
  const Eigen::MatrixXd& opening_slope() const { return opening_slope_; }
  /// Of the residual by v. With conductances held, what is left is what a monotone operator has,
  /// the more mass and flow the higher the pressures.
  enum class Conductances { follow, held };
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& v,
                           Conductances conductances = Conductances::follow) const;

  /// Calls use(a, b, flux) for every pair of branches that meet, flux [kg/(m s)] from a to b.
  template <class Use>
  void for_each_flux(std::span<const double> pressure, std::span<const double> fill,
                     std::span<const double> aperture, Use&& use) {
    for (std::size_t k = 0; k < graph_.joint_count(); ++k) {
      const auto joint = graph_.joint(k);
      at_joint_.find(joint, aperture, graph_, liquid_.viscosity);
      for (std::size_t a = 0; a < joint.size(); ++a) {
        for (std::size_t b = a + 1; b < joint.size(); ++b) {
          const double fall = fall_between(pressure, joint[a].facet, joint[b].facet);
          const Index upstream = joint[fall >= 0.0 ? a : b].facet;
          use(joint[a], joint[b],
              liquid_.density_at(pressure[upstream]) * at_joint_.conductance[a] *
                  at_joint_.conductance[b] / at_joint_.sum * fall * fill[upstream]);
        }
      }
    }
  }

 private:
  /// What drives fluid from one facet to another [Pa].
  double fall_between(std::span<const double> pressure, Index from, Index to) const {
    return pressure[from] - pressure[to] + (height_[from] - height_[to]);
  }
  std::span<const double> pressures() const {
    return {pressure_.data(), static_cast<std::size_t>(pressure_.size())};
  }
  void find_opening_slope(const Eigen::MatrixXd& slope);
  void flow(double dt);
  double rounding_of_fall(Index from, Index to) const;
  void differentiate_joint(std::span<const CrackGraph::Branch> joint, double dt);
  void let_in(const CrackStep& step, const Eigen::VectorXd& v);

  Eigen::MatrixXd opening_slope_;
  std::vector<Eigen::Triplet<double>> flow_by_aperture_;
  std::vector<Eigen::Triplet<double>> flow_by_fill_;  ///< of facets that are not full
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
