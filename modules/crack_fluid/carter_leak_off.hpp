#pragma once

#include <vector>

#include "modules/crack_fluid/leak_off.hpp"
#include "modules/crack_fluid/sealed_walls.hpp"

namespace perifrac {

/// Carter's law, a sink where no pore flow is simulated: both sides of a facet take C_L / sqrt(t -
/// t_0) each, t_0 when fluid came first, integrated exactly over a step; in proportion to the fill.
template <int D>
class CarterLeakOff final : public LeakOff {
 public:
  /// `coefficient` C_L [m/s^0.5], `density` at zero pressure [kg/m^3].
  CarterLeakOff(double coefficient, double density, SealedWalls<D> sealed = SealedWalls<D>())
      : coefficient_(coefficient), density_(density), sealed_(std::move(sealed)) {}

  bool is_sink() const override { return true; }
  double coefficient(Index facet) const override {
    return sealed_.contain(facet) ? 0.0 : coefficient_;
  }
  void match(const PointSet& facets, const CrackGraph& graph) override;
  void begin(const TimeWindow& step) override { step_ = step; }
  void evaluate(const Eigen::VectorXd& pressure, const Eigen::VectorXd& fill,
                LeakedFluid& leaked) override;
  double accept(std::span<const double> mass) override;
  void visit_state(StateVisitor& visitor) override { visitor.visit("crack_wet_since", wet_since_); }

 private:
  double coefficient_;
  double density_;
  SealedWalls<D> sealed_;
  const CrackGraph* graph_ = nullptr;
  TimeWindow step_{};
  std::vector<double> wet_since_;  ///< [s]; negative: never
};

}  // namespace perifrac
