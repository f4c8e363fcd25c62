#include "modules/pore_flow/mass_exchange.hpp"

#include <algorithm>

namespace perifrac {

void MassExchange::begin(const TimeWindow& window, Way way, const std::vector<double>& volume,
                         double density) {
  way_ = way;
  begin_ = window.begin;
  length_ = window.length();
  energy_.resize(1);
  added_.resize(mass_.size());
  if (way == Way::beside) content_.resize(mass_.size());
  for (std::size_t i = 0; i < mass_.size(); ++i) added_[i] = mass_[i] / (density * volume[i]);
}

void MassExchange::end(double energy) {
  for (std::size_t i = 0; i < content_.size(); ++i) content_[i] += added_[i];
  std::ranges::fill(added_, 0.0);
  energy_[0] += energy;
}

std::span<const double> MassExchange::content(double t, std::span<const double> y) {
  const double part = (t - begin_) / length_;
  sum_.resize(content_.size());
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    sum_[i] = y[i] + (content_[i] + part * added_[i]);
  }
  return sum_;
}

void MassExchange::merge_into(std::span<double> y) {
  for (std::size_t i = 0; i < content_.size(); ++i) y[i] += content_[i];
  std::ranges::fill(content_, 0.0);
}

void MassExchange::visit_state(StateVisitor& visitor) {
  visitor.visit("exchanged_content", content_);
  visitor.visit("exchanged_energy", energy_);
}

}  // namespace perifrac
