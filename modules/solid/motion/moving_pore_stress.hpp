#pragma once

#include <span>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// The pore stress that a solid is told for a window: at time t and dilatation theta it is
/// value + rate (t - end) + slope theta [Pa]. Empty spans: no pore stress at all.
struct PoreStressInput {
  std::span<const double> value{};
  std::span<const double> rate{};
  std::span<const double> slope{};
  double end = 0.0;
};

/// The pore stress in a body that moves. Its slope is part of the stiffness.
class MovingPoreStress {
 public:
  /// No window was told of yet.
  void start() { reference_slope_.clear(); }
  /// Takes the input of the next window, whose spans must stay valid while it is integrated; true
  /// where the slope is another one.
  bool set(const PoreStressInput& input);
  /// As it is at time t.
  void find(double t);
  /// Takes the stiffness of reference from the state; true where it is another one.
  bool note_reference();

  bool is_there() const { return !input_.value.empty(); }
  /// What was found, with the slope of the window.
  PoreStress now() const { return {value_, slope_}; }
  /// Without pressure: what it adds to the stiffness, and to that of reference.
  PoreStress at_rest() const { return {zeros_, slope_}; }
  PoreStress reference() const { return {zeros_, reference_slope_}; }
  /// A bound, at least 1, of how much larger its slope is than that of reference.
  double growth() const { return growth_; }
  /// now() with what the rock answers [Pa]; empty: none. Valid until the next call.
  std::span<const double> acting(std::span<const double> dilatation);

  void visit_state(StateVisitor& visitor) {
    visitor.visit("pore_slope_of_reference", reference_slope_);
  }

 private:
  PoreStressInput input_;
  std::vector<double> value_;  ///< at the time that was asked for last, slope apart
  std::vector<double> slope_;  ///< of the present window; empty until one is told
  /// The first that was told, part of the stiffness of reference: a fluid whose storage follows its
  /// pressure changes the slope in every window, and the stable step is not to be sought each time.
  std::vector<double> reference_slope_;
  std::vector<double> noted_slope_;  ///< the one that was taken last
  double growth_ = 1.0;
  std::vector<double> zeros_;
  std::vector<double> acting_;
};

}  // namespace perifrac
