#include "modules/crack_fluid/crack_mouths.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

CrackMouths::CrackMouths(const CrackInlets& inlets) {
  for (std::size_t k = 0; k < inlets.all().size(); ++k) {
    if (!inlets.all()[k].from_fluid) continue;
    inlet_.push_back(k);
    for (int a = 0; a < 2; ++a) place_[a].push_back(inlets.all()[k].at[a]);
  }
  point_set_ = {.name = "mouths", .dimension = 2, .count = inlet_.size()};
  for (int a = 0; a < 2; ++a) point_set_.position[a] = place_[a];
  for (auto* values :
       {&pressure_, &stiffness_, &volume_stiffness_, &relaxation_, &given_, &base_, &answer_, &phi_,
        &decay_, &intake_, &excess_, &given_before_, &taken_by_mouth_}) {
    values->assign(inlet_.size(), 0.0);
  }
}

void CrackMouths::begin_window(double length, CrackInlets& inlets) {
  std::ranges::fill(intake_, 0.0);
  for (std::size_t k = 0; k < inlet_.size(); ++k) {
    const double x = relaxation_[k] > 0.0 ? length / relaxation_[k] : 0.0;
    decay_[k] = std::exp(-x);
    phi_[k] = x > 0.0 ? -std::expm1(-x) / x : 1.0;
    const double passing = std::max(0.0, stiffness_[k] - volume_stiffness_[k]);
    const double lasting = stiffness_[k] - passing;
    answer_[k] = lasting + passing * phi_[k];
    base_[k] = pressure_[k] - lasting * (taken_by_mouth_[k] - given_[k]) +
               passing * (decay_[k] * excess_[k] + phi_[k] * (given_[k] - given_before_[k]));
    supply(k, inlets);
  }
}

void CrackMouths::end_window() {
  for (std::size_t k = 0; k < inlet_.size(); ++k) {
    const double given = given_[k] - given_before_[k];
    excess_[k] = decay_[k] * excess_[k] + phi_[k] * (given - intake_[k]);
    given_before_[k] = given_[k];
    taken_by_mouth_[k] += intake_[k];
  }
}

/// What a window's earlier steps took is felt in its later ones.
void CrackMouths::supply(std::size_t mouth, CrackInlets& inlets) const {
  inlets.supply(inlet_[mouth], {.pressure = base_[mouth] - answer_[mouth] * intake_[mouth],
                                .stiffness = answer_[mouth]});
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
  for (auto* values : {&intake_, &excess_, &given_before_, &taken_by_mouth_}) {
    std::ranges::fill(*values, 0.0);
  }
  taken_ = {};
}

void CrackMouths::visit_state(StateVisitor& visitor) {
  if (!any()) return;
  visitor.visit("mouth_excess", excess_);
  visitor.visit("mouth_given_before", given_before_);
  visitor.visit("mouth_taken", taken_by_mouth_);
  taken_.visit_state(visitor, "taken_from_fluid");
}

}  // namespace perifrac
