#include "modules/crack_fluid/well_flow.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

constexpr double law_tolerance = 1e-9;  ///< of the pressures

}  // namespace

WellFlow::WellFlow(std::vector<Opening> openings, double rate, const Law& law)
    : openings_(std::move(openings)), at_begin_(openings_), rate_(rate), law_(law) {}

void WellFlow::begin() {
  openings_ = at_begin_;
  has_begun_ = is_settled_ = false;
}

/// What the law asks for at an opening's rate [Pa].
double WellFlow::loss(const Opening& opening) const {
  const double of_all = opening.rate / opening.part;
  return (opening.resistance * std::abs(of_all) + law_.laminar) * of_all;
}

/// And the rate at a loss.
double WellFlow::driven_by(double fall, const Opening& opening) const {
  const double square = law_.laminar * law_.laminar + 4.0 * opening.resistance * std::abs(fall);
  return opening.part * 2.0 * fall / (law_.laminar + std::sqrt(square));
}

void WellFlow::guess(const Eigen::VectorXd& pressure) {
  share(pressure);
  for (Opening& opening : openings_) {
    const double driven = driven_by(pressure_ - pressure[opening.facet], opening);
    if (std::abs(driven) < std::abs(opening.rate)) opening.rate = driven;
  }
}

void WellFlow::take_tangents() {
  slopes_ = 0.0;
  for (Opening& opening : openings_) {
    const double of_all = std::abs(opening.rate) / opening.part;
    opening.slope = opening.part / (2.0 * opening.resistance * of_all + law_.laminar);
    opening.lost = loss(opening);
    slopes_ += opening.slope;
  }
}

/// By the tangents. Pressures are taken from the first one's: of what is left little is rounded
/// off.
void WellFlow::share(const Eigen::VectorXd& pressure) {
  const double base = pressure[openings_.front().facet];
  const auto change = [&](const Opening& opening, double level) {
    return opening.slope * (level - (pressure[opening.facet] - base) - opening.lost);
  };
  const auto move = [](Opening& opening, double by) {
    opening.rate += by;
    opening.lost += by / opening.slope;
  };
  double missing = rate_;
  for (const Opening& opening : openings_) missing -= opening.rate + change(opening, 0.0);
  const double least = law_.least_pressure - base;
  const double level = std::max(missing / slopes_, least);
  brings_all_ = missing / slopes_ >= least;
  pressure_ = base + level;
  missing = rate_;
  for (Opening& opening : openings_) {
    move(opening, change(opening, level));
    missing -= opening.rate;
  }
  if (!brings_all_) return;
  for (Opening& opening : openings_) move(opening, missing * opening.slope / slopes_);
}

void WellFlow::follow(const Eigen::VectorXd& pressure) {
  if (has_begun_) guess(pressure);
  has_begun_ = true;
  take_tangents();
  share(pressure);
  is_settled_ = std::ranges::all_of(openings_, [&](const Opening& opening) {
    const double there = pressure[opening.facet];
    const double largest = std::max({std::abs(pressure_), std::abs(there), law_.known_pressure});
    return std::abs(pressure_ - there - loss(opening)) <= law_tolerance * largest;
  });
}

double WellFlow::slope(std::size_t a, std::size_t b) const {
  const double own = openings_[a].slope;
  return (brings_all_ ? own * openings_[b].slope / slopes_ : 0.0) - (a == b ? own : 0.0);
}

}  // namespace perifrac
