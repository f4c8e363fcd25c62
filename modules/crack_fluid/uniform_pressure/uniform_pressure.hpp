#pragma once

#include <vector>

#include <Eigen/Dense>

#include "modules/crack_fluid/crack_flow.hpp"
#include "modules/crack_fluid/uniform_pressure/crack_inflow.hpp"

namespace perifrac {

/// Fluid without viscosity: one unknown v of crack_liquid.hpp, and one mass balance, for all facets
/// that hang together,
///   R_c = sum over f in c of (m_f(v_c) - m_f^n + leak_f) - inflow_c,
/// with the rock's answer to all pressures in it. What a crack holds is spread over its facets as
/// their volume is, at once: every facet is full to the tip, or all are so by the same part. Cracks
/// that come together share what both hold.
class UniformPressure final : public CrackFlow {
 public:
  explicit UniformPressure(const CrackLiquid& liquid) : CrackFlow(liquid) {}

  void follow(CrackGraph graph, Eigen::VectorXd height) override;
  /// Begins with the highest unknown of each crack; ends with the same one for all its facets.
  /// Throws FinalError where a crack is held at two pressures.
  FlowReport solve(const CrackStep& step, Eigen::VectorXd& v) override;

  Index crack_count() const { return static_cast<Index>(first_.size()); }
  Index crack(Index facet) const { return crack_[facet]; }

 private:
  void begin(const CrackStep& step);
  void evaluate(const CrackStep& step, const Eigen::VectorXd& unknown);
  Eigen::VectorXd change(const CrackStep& step, const Eigen::VectorXd& unknown);
  Eigen::MatrixXd jacobian(const CrackStep& step, const Eigen::VectorXd& unknown);
  bool is_balanced(FlowReport& report) const;
  void spread();
  Eigen::VectorXd by_crack(const Eigen::VectorXd& of_facets) const;
  Eigen::VectorXd by_facet(const Eigen::VectorXd& of_cracks) const;

  std::vector<Index> crack_;  ///< by facet: which
  std::vector<Index> first_;  ///< by crack: a facet of it
  /// Of the step at hand: how openings answer to the pressure in each crack, if no faces touched
  /// [m/Pa]; what comes into each.
  Eigen::MatrixXd answer_;
  std::vector<CrackInflow> inflows_;
  Eigen::VectorXd balance_, allowed_;  ///< of cracks [kg], in 2D per metre
};

}  // namespace perifrac
