#pragma once

#include <span>
#include <utility>
#include <vector>

#include "modules/crack_fluid/crack_step.hpp"

namespace perifrac {

/// What inlets and outlets bring into one crack whose fluid has one unknown v: the lower v, the
/// more. Each takes its least above its target, its most below it, and anything between at it;
/// those with a stiffness follow the pressure throughout.
class CrackInflow {
 public:
  /// Takes an inflow of a facet of this crack.
  void add(const FacetInflow& inflow);
  /// All are there. False where two of them would hold different pressures: between them fluid
  /// without viscosity would flow without end.
  bool order();

  /// Follows v, for a balance that lacks `without` [kg] of being closed if nothing came in;
  /// `weight` [kg/Pa] makes a mass of a difference of pressure. Returns what is left of the
  /// balance, as that is held.
  double balance(double v, double without, double weight);
  bool holds() const { return held_ >= 0; }
  double held_at() const { return levels_[held_].target; }  ///< where it holds [Pa]
  double slope() const;                              ///< of the smooth ones, -d(inflow)/dv [kg/Pa]
  double total() const { return total_ + smooth_; }  ///< what comes in [kg]
  /// What comes in at each facet; one facet may be there more than once.
  std::vector<std::pair<Index, double>> by_facet() const;

 private:
  /// Those of one target.
  struct Level {
    double target, least, most;
    std::vector<FacetInflow> inflows;
  };
  double total_below(std::size_t level) const;

  std::vector<FacetInflow> smooth_ones_;
  std::vector<Level> levels_;  ///< the highest target first
  int held_ = -1;              ///< the level whose target the balance holds
  std::size_t reached_ = 0;    ///< levels before this one give their most
  double v_ = 0.0, smooth_ = 0.0, total_ = 0.0;
};

}  // namespace perifrac
