#include "modules/crack_fluid/crack_flow.hpp"

#include <algorithm>

#include "core/profile/profile.hpp"

namespace perifrac {

void CrackFlow::follow(CrackGraph graph, Eigen::VectorXd height) {
  graph_ = std::move(graph);
  height_ = std::move(height);
  const Index count = graph_.facet_count();
  for (Eigen::VectorXd* field :
       {&pressure_, &fill_, &opening_, &terms_, &aperture_, &capacity_, &residual_, &rounding_,
        &outflow_, &leaked_.mass, &leaked_.by_fill, &inflow_, &by_fill_}) {
    field->setZero(count);
  }
}

void CrackFlow::find_pressures(const Eigen::VectorXd& v) {
  for (Index f = 0; f < graph_.facet_count(); ++f) {
    pressure_[f] = liquid_.pressure(v[f]);
    fill_[f] = liquid_.fill(v[f]);
  }
}

/// By the step alone: where a run goes on from, nothing else is known.
void CrackFlow::begin_contact(const CrackStep& step) {
  std::vector<bool> touch;
  for (const double aperture : step.aperture) {
    touch.push_back(aperture <= liquid_.residual_aperture);
  }
  contact_.begin_from(std::move(touch));
}

void CrackFlow::rest(const CrackStep& step, const Eigen::VectorXd& v) {
  begin_contact(step);
  find_pressures(v);
  rest(step, v, step.opening.slope * pressure_);
}

void CrackFlow::rest(const CrackStep& step, const Eigen::VectorXd& v,
                     const Eigen::VectorXd& response) {
  by_pressure_.clear();
  by_aperture_.clear();
  find_pressures(v);
  open(step, response);
  store(step);
  if (step.leak_off != nullptr) leak(*step.leak_off);
  outflow_.setZero();
  inflow_.setZero();
  for (WellFlow& well : step.wells) take_from(well, step.time.length());
}

bool CrackFlow::is_beside_full(Index f) const {
  for (std::size_t k = 0; k < graph_.joint_count(); ++k) {
    const auto joint = graph_.joint(k);
    const auto is = [&](Index facet) {
      return std::ranges::any_of(joint, [&](const auto& at) { return at.facet == facet; });
    };
    if (!is(f)) continue;
    for (const auto& at : joint) {
      if (at.facet != f && is_full(at.facet)) return true;
    }
  }
  return false;
}

void CrackFlow::open(const CrackStep& step, const Eigen::VectorXd& response) {
  const CrackOpening& given = step.opening;
  opening_ = response;
  const double largest = opening_.cwiseAbs().maxCoeff();
  for (Index f = 0; f < graph_.facet_count(); ++f) {
    const double free = given.value[f] + given.rate[f] * (step.time.end - given.end);
    terms_[f] = std::abs(free) + std::abs(opening_[f]);
    opening_[f] += free;
  }
  face_pressure_ = pressure_;
  closed_.clear();
  if (opening_.minCoeff() >= 0.0) return;
  Complementarity contact = contact_.solve(given.slope, opening_, 1e-14 * largest);
  opening_ = contact.y;
  face_pressure_ += contact.x;
  closed_ = std::move(contact.held);
}

void CrackFlow::store(const CrackStep& step) {
  for (Index f = 0; f < graph_.facet_count(); ++f) {
    aperture_[f] = std::max(opening_[f], liquid_.residual_aperture);
    capacity_[f] = liquid_.density * graph_.area(f) * aperture_[f];
    const double compression = 1.0 + pressure_[f] / liquid_.bulk_modulus;
    const double mass = capacity_[f] * compression * fill_[f];
    residual_[f] = mass - step.mass[f];
    // An aperture far below what it is the difference of is known no better than that.
    rounding_[f] = mass * (is_open(f) ? terms_[f] / aperture_[f] : 1.0) + std::abs(step.mass[f]);
    by_fill_[f] = capacity_[f] * compression;
    by_pressure_.emplace_back(f, f, capacity_[f] * fill_[f] / liquid_.bulk_modulus);
    by_aperture_.emplace_back(f, f, mass / aperture_[f]);
  }
}

void CrackFlow::leak(LeakOff& leak_off) {
  const ProfileScope profiled("leak-off");
  leaked_.by_pressure.clear();
  leak_off.evaluate(pressure_, fill_, leaked_);
  residual_ += leaked_.mass;
  rounding_ += leaked_.mass.cwiseAbs();
  by_fill_ += leaked_.by_fill;
  by_pressure_.insert(by_pressure_.end(), leaked_.by_pressure.begin(), leaked_.by_pressure.end());
}

/// What comes in at every facet follows the pressures at all that the well feeds, whose own
/// pressure is that at the height of the first.
void CrackFlow::take_from(WellFlow& well, double dt) {
  const auto& openings = well.openings();
  well.follow(pressure_ + (height_.array() - height_[openings.front().facet]).matrix());
  const double mass = liquid_.density * dt;
  for (std::size_t a = 0; a < openings.size(); ++a) {
    const Index f = openings[a].facet;
    const double brought = mass * openings[a].rate;
    inflow_[f] += brought;
    residual_[f] -= brought;
    rounding_[f] += std::abs(brought) +
                    mass * openings[a].slope * (std::abs(well.pressure()) + std::abs(pressure_[f]));
    for (std::size_t b = 0; b < openings.size(); ++b) {
      by_pressure_.emplace_back(f, openings[b].facet, -mass * well.slope(a, b));
    }
  }
}

}  // namespace perifrac
