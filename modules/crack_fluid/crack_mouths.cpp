#include "modules/crack_fluid/crack_mouths.hpp"

#include <algorithm>

namespace perifrac {

CrackMouths::CrackMouths(const CrackInlets& inlets) {
  for (std::size_t k = 0; k < inlets.all().size(); ++k) {
    if (!inlets.all()[k].from_fluid) continue;
    inlet_.push_back(k);
    for (int a = 0; a < 2; ++a) place_[a].push_back(inlets.all()[k].at[a]);
  }
  point_set_ = {.name = "mouths", .dimension = 2, .count = inlet_.size()};
  for (int a = 0; a < 2; ++a) point_set_.position[a] = place_[a];
  for (auto* values : {&pressure_, &stiffness_, &intake_}) values->assign(inlet_.size(), 0.0);
}

void CrackMouths::begin_window(CrackInlets& inlets) {
  std::ranges::fill(intake_, 0.0);
  for (std::size_t k = 0; k < inlet_.size(); ++k) supply(k, inlets);
}

/// What a window's earlier steps took is felt in its later ones.
void CrackMouths::supply(std::size_t mouth, CrackInlets& inlets) const {
  inlets.supply(inlet_[mouth], {.pressure = pressure_[mouth] - stiffness_[mouth] * intake_[mouth],
                                .stiffness = stiffness_[mouth]});
}

bool CrackMouths::book(Index facet, double inflow, CrackInlets& inlets) {
  for (std::size_t k = 0; k < inlet_.size(); ++k) {
    if (std::ranges::count(inlets.facets(inlet_[k]), facet) == 0) continue;
    intake_[k] += inflow;
    taken_.add(inflow);
    supply(k, inlets);
    return true;
  }
  return false;
}

void CrackMouths::clear() {
  std::ranges::fill(intake_, 0.0);
  taken_ = {};
}

void CrackMouths::visit_state(StateVisitor& visitor) {
  if (!any()) return;
  visitor.visit("mouth_intake", intake_);
  taken_.visit_state(visitor, "taken_from_fluid");
}

}  // namespace perifrac
