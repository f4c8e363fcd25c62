#pragma once

#include <vector>

#include "core/geometry/by_region.hpp"
#include "modules/crack_fluid/leak_off.hpp"
#include "modules/crack_fluid/sealed_walls.hpp"

namespace perifrac {

/// Carter's law, a sink where no pore flow is simulated: both sides of a facet take C_L / sqrt(t -
/// t_0) each, t_0 when fluid came to that part of it, integrated exactly over a step. The front
/// goes through a facet evenly, from when fluid came first to when it last came further. Where a
/// facet drains, so much of it leaks as is wet.
template <int D>
class CarterLeakOff final : public LeakOff {
 public:
  /// `coefficient` C_L where a facet has its middle [m/s^0.5], `density` at zero pressure [kg/m^3].
  CarterLeakOff(ByRegion<D, double> coefficient, double density,
                SealedWalls<D> sealed = SealedWalls<D>())
      : coefficient_(std::move(coefficient)), density_(density), sealed_(std::move(sealed)) {}

  bool is_sink() const override { return true; }
  double coefficient(Index facet) const override {
    if (sealed_.contain(facet)) return 0.0;
    return by_facet_.empty() ? coefficient_.elsewhere : by_facet_[facet];
  }
  void match(const PointSet& facets, const CrackGraph& graph) override;
  void begin(const TimeWindow& step, std::span<const double> fill) override;
  void evaluate(const Eigen::VectorXd& pressure, const Eigen::VectorXd& fill,
                LeakedFluid& leaked) override;
  double accept(std::span<const double> fill) override;
  void visit_state(StateVisitor& visitor) override;

 private:
  void note_arrivals(std::span<const double> fill, double from, double to);

  ByRegion<D, double> coefficient_;
  double density_;
  SealedWalls<D> sealed_;
  std::vector<double> by_facet_;  ///< C_L; empty where it is the same everywhere
  const CrackGraph* graph_ = nullptr;
  TimeWindow step_{};
  std::vector<double> wet_share_;              ///< the most of a facet that was ever wet
  std::vector<double> wet_since_, wet_until_;  ///< when it became so: began, ended [s]
};

}  // namespace perifrac
