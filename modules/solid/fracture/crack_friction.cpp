#include "modules/solid/fracture/crack_friction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"

namespace perifrac {

void CrackFriction::start(const CrackedBody<2>& body) {
  slip_.clear();
  limit_.clear();
  borne_.clear();
  for (Index f = 0; f < static_cast<Index>(body.facets().size()); ++f) {
    limit_.push_back(coefficient_ * std::max(0.0, -body.relief(f)[0]));
    borne_.push_back(std::clamp(body.relief(f)[1], -limit_.back(), limit_.back()));
  }
  dissipation_ = elastic_energy_ = 0.0;
  version_.reset();
  partial_version_.reset();
}

/// Facets that came change how all answer.
void CrackFriction::follow(CrackedBody<2>& body) {
  if (version_ == body.version() && partial_version_ == body.partial_version()) return;
  if (version_ != body.version()) take(body);
  version_ = body.version();
  partial_version_ = body.partial_version();
  contact_.change(body.compliance_change());
}

void CrackFriction::take(CrackedBody<2>& body) {
  const auto count = static_cast<Eigen::Index>(body.jumps().size());
  layer_.clear();
  for (const FaceJump<2>& jump : body.jumps()) {
    double softness = 0.0;
    for (const auto& [point, coefficient] : jump.terms) {
      softness += 0.5 * std::abs(coefficient) / body.elastic().law(point).shear_modulus;
    }
    layer_.push_back(jump.reach * softness);
  }
  Eigen::MatrixXd compliance = body.whole_compliance();
  for (Eigen::Index f = 0; f < count; ++f) compliance(count + f, count + f) += layer_[f];
  contact_.take(std::move(compliance));
}

/// What the faces did when the last window ended; new ones are apart.
std::vector<PairState> CrackFriction::last_states(std::size_t count) const {
  constexpr double slides = 1.0 - 1e-8;
  std::vector<PairState> states(count, PairState::open);
  for (std::size_t f = 0; f < std::min(count, limit_.size()); ++f) {
    if (!(limit_[f] > 0.0)) continue;
    const bool is_sliding = std::abs(borne_[f]) >= slides * limit_[f];
    states[f] = !is_sliding       ? PairState::stick
                : borne_[f] < 0.0 ? PairState::forward
                                  : PairState::backward;
  }
  return states;
}

CrackedBody<2>::Faces CrackFriction::faces(CrackedBody<2>& body, const Eigen::VectorXd& pressure,
                                           double t) {
  const Eigen::Index count = pressure.size();
  slip_.resize(count, 0.0);
  follow(body);
  const std::vector<Vector<2>> apart = body.jumps_under(pressure);
  Eigen::VectorXd jump(2 * count);
  for (Index f = 0; f < count; ++f) {
    jump[f] = apart[f][0];
    jump[count + f] = apart[f][1] + layer_[f] * body.relief(f)[1] - slip_[f];
  }
  FrictionalContact contact;
  try {
    contact = contact_.solve(jump, coefficient_, 1e-14 * body.spacing(),
                             last_states(static_cast<std::size_t>(count)));
  } catch (const std::runtime_error& error) {
    throw NumericalError("face_shear", "the faces of the cracks", t, error.what());
  }
  CrackedBody<2>::Faces faces{contact.jump.head(count).cwiseMax(0.0),
                              pressure + contact.traction.head(count), std::vector<bool>(count),
                              std::vector<double>(count), std::vector<double>(count)};
  for (Eigen::Index f = 0; f < count; ++f) {
    faces.closed[f] = contact.traction[f] > 0.0;
    faces.shear[f] = contact.traction[count + f];
    faces.slip[f] = slip_[f] + contact.jump[count + f];
  }
  return faces;
}

Eigen::VectorXd CrackFriction::opening_by(CrackedBody<2>& body, std::span<const double> shear) {
  follow(body);
  const auto count = static_cast<Eigen::Index>(body.jumps().size());
  Eigen::VectorXd traction = Eigen::VectorXd::Zero(2 * count);
  traction.segment(count, std::ssize(shear)) = view(shear);
  return contact_.times(traction).head(count);
}

/// While faces slide the shear is at its limit, which goes evenly from what it was to what it is;
/// where it falls, as fluid takes over what presses them together, not before it is down to what
/// they bear.
void CrackFriction::book(const CrackedBody<2>& body, const CrackedBody<2>::Faces& faces,
                         const Eigen::VectorXd& pressure) {
  limit_.resize(faces.slip.size(), 0.0);  // a new facet has borne nothing yet
  borne_.resize(faces.slip.size(), 0.0);
  elastic_energy_ = 0.0;
  for (Index f = 0; f < std::ssize(faces.slip); ++f) {
    const double limit = coefficient_ * (faces.pressure[f] - pressure[f]);
    const double first_limit = std::min(limit_[f], std::max(limit, std::abs(borne_[f])));
    dissipation_ +=
        body.jumps()[f].area * 0.5 * (first_limit + limit) * std::abs(faces.slip[f] - slip_[f]);
    const double shear = faces.shear[f], at_rest = body.relief(f)[1];
    elastic_energy_ += body.jumps()[f].area * 0.5 * layer_[f] * (shear * shear - at_rest * at_rest);
    slip_[f] = faces.slip[f];
    limit_[f] = limit;
    borne_[f] = shear;
  }
}

void CrackFriction::visit_state(StateVisitor& visitor) {
  visitor.visit("friction_limit", limit_);
  visitor.visit("friction_borne", borne_);
  visitor.visit("crack_slip", slip_);
  visitor.visit("friction_dissipation", dissipation_);
  visitor.visit("friction_elastic_energy", elastic_energy_);
}

}  // namespace perifrac
